//! Where settings come from.

use crate::scenes::{ALONE, CROWD};
use crate::{failed, file, run, run_with_input, singulate};

/// The limit that refuses [`CROWD`], which has five objects; `None` where it is planned for.
fn refusing_limit(flag: Option<&str>, variable: Option<&str>, in_file: Option<&str>, name: &str) -> Option<String> {
    let scene = file(&format!("{name}-scene.json"), CROWD);
    let mut command = singulate(&["plan", scene.to_str().unwrap()]);
    if let Some(value) = in_file {
        let path = file(&format!("{name}.toml"), &format!("max_objects = {value}\nthreads = 3\n"));
        command.args(["--config", path.to_str().unwrap()]);
    }
    if let Some(value) = variable {
        command.env("SINGULATE_MAX_OBJECTS", value);
    }
    if let Some(value) = flag {
        command.args(["--max-objects", value]);
    }
    let output = command.output().unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    errors.split("the limit of ").nth(1).and_then(|rest| rest.split_whitespace().next()).map(str::to_owned)
}

#[test]
fn a_flag_goes_before_a_variable_before_a_file_before_the_default() {
    let limit = |flag, variable, in_file, name| refusing_limit(flag, variable, in_file, name);
    assert_eq!(limit(None, None, None, "default"), None);
    assert_eq!(limit(None, None, Some("3"), "file").as_deref(), Some("3"));
    assert_eq!(limit(None, Some("2"), Some("3"), "variable").as_deref(), Some("2"));
    assert_eq!(limit(Some("1"), Some("2"), Some("3"), "flag").as_deref(), Some("1"));
    assert_eq!(limit(Some("9"), Some("2"), Some("3"), "wide"), None);
}

#[test]
fn whatever_is_wrong_is_named_with_its_source() {
    let path = file("wrong.toml", "max_object = 3\nqueue = -1\n");
    let output = singulate(&["serve", "--threads", "many"])
        .env("SINGULATE_CONFIG", &path)
        .env("SINGULATE_LISTEN", "nowhere")
        .env("SINGULATE_PORT", "1")
        .output()
        .unwrap();
    let errors = failed(&output, 2);
    let path = path.display();
    for start in [
        "--threads: 'many' is not",
        "SINGULATE_LISTEN: 'nowhere' is not",
        "warning: SINGULATE_PORT: there is no such setting",
        &format!("max_object in {path}: there is no such setting"),
        &format!("queue in {path}: '-1' is not"),
    ] {
        assert!(errors.lines().any(|line| line.starts_with(start)), "no '{start}' in {errors}");
    }
    assert_eq!(errors.lines().count(), 5, "{errors}");
}

#[test]
fn a_config_file_that_is_not_there_is_named() {
    let errors = failed(&run_with_input(&["plan", "-", "--config", "/nowhere.toml"], ALONE), 2);
    assert!(errors.starts_with("/nowhere.toml: "), "{errors}");
}

#[test]
fn a_flag_that_only_a_service_needs_is_refused_elsewhere() {
    failed(&run(&["plan", "-", "--listen", "127.0.0.1:1"]), 2);
}

#[test]
fn the_help_names_every_way_to_set_a_setting() {
    let help = String::from_utf8(run(&["serve", "--help"]).stdout).unwrap();
    for name in ["listen", "threads", "queue", "max_body_bytes", "log_format"] {
        let (flag, variable) = (name.replace('_', "-"), name.to_uppercase());
        assert!(
            help.contains(&format!("--{flag}")) && help.contains(&format!("[env: SINGULATE_{variable}]")),
            "{name}"
        );
    }
}
