//! What a client names itself, as the operator's terminal and log collector see it.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::Stdio;

use rustix::process::{Pid, Signal, kill_process};
use serde_json::{Value, json};

use crate::scenes::ALONE;
use crate::{failed, file, run_with_input, singulate};

/// What a service logs that plans one scene of this name.
fn logged(scene_id: &str, format: &str) -> String {
    let arguments = ["serve", "--listen", "127.0.0.1:0", "--jobs-url", "sqlite::memory:", "--log-format", format];
    let mut child = singulate(&arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut greeting = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut greeting).unwrap();
    let address = greeting.split("http://").nth(1).unwrap().split_whitespace().next().unwrap();

    let mut scene: Value = serde_json::from_str(ALONE).unwrap();
    scene["scene_id"] = json!(scene_id);
    let body = scene.to_string();
    let head = "POST /v1/plans HTTP/1.1\r\nhost: x\r\nx-request-id: cell 4\r\nconnection: close\r\ncontent-type: application/json";
    let mut stream = TcpStream::connect(address).unwrap();
    write!(stream, "{head}\r\ncontent-length: {}\r\n\r\n{body}", body.len()).unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 200 "), "{answer}");

    kill_process(Pid::from_child(&child), Signal::TERM).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn a_name_that_looks_like_a_log_line_stays_within_its_own() {
    let forged = "cell-4\n2026-01-01T00:00:00Z ERROR forged\r\u{1b}[2J\u{7f}\u{9b}31m";
    let text = logged(forged, "text");
    assert!(text.chars().all(|c| c == '\n' || !c.is_control()), "{text:?}");
    let lines: Vec<&str> = text.lines().filter(|line| line.contains("forged")).collect();
    assert!(matches!(lines[..], [line] if line.contains("INFO request{")), "{text}");
    let text = logged(forged, "json");
    assert!(text.chars().all(|c| c == '\n' || !c.is_control()), "{text:?}");
    let json: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let named: Vec<&Value> = json.iter().filter(|line| line.to_string().contains("forged")).collect();
    let [line] = named[..] else { panic!("{json:?}") };
    // As it came: a collector finds it by the name that the cell gave.
    assert_eq!((&line["level"], &line["span"]["scene_id"]), (&json!("INFO"), &json!(forged)));
    assert_eq!(line["span"]["id"], json!("cell 4"));
    // And once: there is no span round a request's.
    assert_eq!(text.matches("cell 4").count(), 1, "{text}");
}

#[test]
fn an_unknown_level_is_an_error_wherever_it_is_said() {
    let levels = "is no level: off, error, warn, info, debug or trace";
    let file = file("loud.toml", "log = 'loud'\n");
    for (flags, variable, source) in [
        (&["--log", "loud"][..], None, "--log".to_owned()),
        (&[], Some("loud"), "SINGULATE_LOG".to_owned()),
        (&["--config", file.to_str().unwrap()], None, format!("log in {}", file.display())),
        (&["--log", "info,singulate=loud"], None, "--log".to_owned()),
        (&["--log", "singulate"], None, "--log".to_owned()),
        (&["--log", ""], None, "--log".to_owned()),
    ] {
        // What has no store ends whatever is logged.
        let mut command = singulate(&["serve", "--listen", "127.0.0.1:0", "--jobs-url", "sqlite:/nowhere/jobs.db"]);
        command.args(flags).envs(variable.map(|text| ("SINGULATE_LOG", text)));
        let errors = failed(&command.output().unwrap(), 2);
        assert!(errors.starts_with(&format!("{source}: '")) && errors.contains(levels), "{errors}");
    }
    let errors = failed(&run_with_input(&["plan", "-", "--log", "loud"], ALONE), 2);
    assert!(errors.contains(levels), "{errors}");
}

#[test]
fn a_part_that_is_mistyped_does_not_silence_the_warning_of_missing_keys() {
    let serve =
        ["serve", "--listen", "127.0.0.1:0", "--jobs-url", "sqlite:/nowhere/jobs.db", "--log", "singluate=debug"];
    let errors = String::from_utf8(singulate(&serve).output().unwrap().stderr).unwrap();
    assert!(errors.contains("NO KEYS: "), "{errors}");
}
