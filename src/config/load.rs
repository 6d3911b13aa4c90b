//! Loads the configuration from flags, variables and the file.

use core::fmt;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::Config;
use super::closest::closest;
use super::setting::Setting;
use super::settings::SETTINGS;

/// The prefix of all our variables.
const PREFIX: &str = "SINGULATE_";
/// Variables of clients, which may run in the same shell.
const OF_CLIENTS: [&str; 2] = ["SINGULATE_URL", "SINGULATE_KEY"];
/// The variable that names the file.
const CONFIG_VARIABLE: &str = "SINGULATE_CONFIG";

/// The source of a value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Source {
    /// A flag.
    Flag(String),
    /// An environment variable.
    Variable(String),
    /// A key of a file.
    File(PathBuf, String),
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flag(flag) => write!(f, "--{flag}"),
            Self::Variable(variable) => f.write_str(variable),
            Self::File(path, key) => write!(f, "{key} in {}", path.display()),
        }
    }
}

/// The settings of the command line.
#[derive(Debug, Default)]
pub struct Stated {
    /// The file.
    pub config: Option<PathBuf>,
    /// Settings by flag.
    pub flags: Vec<(&'static Setting, String)>,
}

/// All faults of the settings, one line each.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", .0.join("\n"))]
pub struct ConfigError(pub Vec<String>);

impl ConfigError {
    /// The same, with variables that may have been meant for missing settings.
    #[must_use]
    pub(super) fn beside(self, unknown_variables: &[String]) -> Self {
        Self(self.0.into_iter().chain(unknown_variables.iter().map(|line| format!("warning: {line}"))).collect())
    }
}

/// The configuration from flags, environment variables and the file that they name.
///
/// # Errors
/// All faults: unknown keys, invalid values, an unreadable file. An unknown variable is no error, since a container
/// manager may have set it; it goes to `unknown_variables`.
pub fn load(
    stated: &Stated,
    environment: impl IntoIterator<Item = (OsString, OsString)>,
) -> Result<Config, ConfigError> {
    let mut faults = Vec::new();
    let mut unknown = Vec::new();
    let (file, variables) = variables(environment, &mut faults, &mut unknown);
    let mut config = Config::default();
    let mut apply = |setting: &Setting, source: &Source, text: &str, faults: &mut Vec<String>| {
        if let Err(detail) = setting.set(&mut config, text) {
            faults.push(format!("{source}: {detail}"));
        }
    };
    if let Some(path) = stated.config.as_ref().or(file.as_ref()) {
        for (setting, source, text) in read(path, &mut faults) {
            apply(setting, &source, &text, &mut faults);
        }
    }
    for (setting, text) in variables {
        apply(setting, &Source::Variable(setting.variable()), &text, &mut faults);
    }
    for (setting, text) in &stated.flags {
        apply(setting, &Source::Flag(setting.flag()), text, &mut faults);
    }
    if !faults.is_empty() {
        return Err(ConfigError(faults).beside(&unknown));
    }
    Ok(Config { unknown_variables: unknown, ..config })
}

/// The file's path and the settings in the environment, in the order of [`SETTINGS`].
fn variables(
    environment: impl IntoIterator<Item = (OsString, OsString)>,
    faults: &mut Vec<String>,
    unknown: &mut Vec<String>,
) -> (Option<PathBuf>, Vec<(&'static Setting, String)>) {
    let mut file = None;
    let mut found = Vec::new();
    for (name, value) in environment {
        let Some(name) = name.to_str().filter(|name| name.starts_with(PREFIX)) else { continue };
        if name == CONFIG_VARIABLE {
            file = Some(PathBuf::from(value));
        } else if let Some(at) = SETTINGS.iter().position(|setting| setting.variable() == name) {
            match value.into_string() {
                Ok(text) => found.push((at, text)),
                Err(_) => faults.push(format!("{name}: the value is not UTF-8")),
            }
        } else if !OF_CLIENTS.contains(&name) {
            unknown.push(nothing_reads(name));
        }
    }
    // The environment is unordered.
    unknown.sort_unstable();
    found.sort_unstable();
    (file, found.into_iter().map(|(at, text)| (&SETTINGS[at], text)).collect())
}

/// Says that a variable is unknown, with a suggestion. Its value may be a secret.
fn nothing_reads(name: &str) -> String {
    let rest = name.strip_prefix(PREFIX).unwrap_or(name);
    let known = SETTINGS.iter().map(Setting::variable).chain([CONFIG_VARIABLE.to_owned()]);
    let known = known.map(|variable| variable.trim_start_matches(PREFIX).to_owned());
    let meant = match closest(rest, known) {
        _ if rest == "PORT" || rest.starts_with("PORT_") || rest.starts_with("SERVICE_") => {
            "; container managers set it beside a service of this name; where to listen is SINGULATE_LISTEN".to_owned()
        }
        Some(setting) => format!("; did you mean {PREFIX}{setting}?"),
        None => String::new(),
    };
    format!("{name}: there is no such setting, so it changes nothing{meant}")
}

/// The fault and its line number, without the line: it may hold a secret.
fn described(error: &toml::de::Error, text: &str) -> String {
    let before = error.span().and_then(|span| text.get(..span.start));
    let line = before.map(|before| format!("line {}: ", before.matches('\n').count() + 1));
    format!("{}{}", line.unwrap_or_default(), error.message())
}

/// The settings in a TOML file.
fn read(path: &Path, faults: &mut Vec<String>) -> Vec<(&'static Setting, Source, String)> {
    let table = std::fs::read_to_string(path).map_err(|error| error.to_string());
    let table = table.and_then(|text| text.parse::<toml::Table>().map_err(|error| described(&error, &text)));
    let table = match table {
        Ok(table) => table,
        Err(detail) => {
            faults.push(format!("{}: {}", path.display(), detail.trim_end()));
            return Vec::new();
        }
    };
    let mut found = Vec::new();
    for (key, value) in table {
        let source = Source::File(path.to_owned(), key.clone());
        let Some(setting) = SETTINGS.iter().find(|setting| setting.name == key) else {
            let meant = closest(&key, SETTINGS.iter().map(|setting| setting.name.to_owned()));
            let meant = meant.map(|name| format!("; did you mean {name}?")).unwrap_or_default();
            faults.push(format!("{source}: there is no such setting{meant}"));
            continue;
        };
        match value {
            toml::Value::String(text) => found.push((setting, source, text)),
            toml::Value::Integer(number) => found.push((setting, source, number.to_string())),
            toml::Value::Boolean(yes) if setting.is_switch() => found.push((setting, source, yes.to_string())),
            toml::Value::Float(number) => found.push((setting, source, number.to_string())),
            other => faults.push(format!("{source}: a {} is no value for this setting", other.type_str())),
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flag(name: &str, text: &str) -> (&'static Setting, String) {
        (SETTINGS.iter().find(|setting| setting.name == name).unwrap(), text.to_owned())
    }

    fn variables(list: &[(&str, &str)]) -> Vec<(OsString, OsString)> {
        list.iter().map(|(name, value)| (OsString::from(name), OsString::from(value))).collect()
    }

    /// A temporary file with this name and text.
    fn file(name: &str, text: &str) -> PathBuf {
        let path = std::env::temp_dir().join(format!("singulate-{}-{name}.toml", std::process::id()));
        std::fs::write(&path, text).unwrap();
        path
    }

    #[test]
    fn a_flag_goes_before_a_variable_and_a_variable_before_the_file() {
        let path = file("order", "threads = 2\nqueue = 3\nlog = 'warn'\noverlap_tolerance = 0.002\n");
        let stated = Stated { config: Some(path.clone()), flags: vec![flag("threads", "7")] };
        let others = [("PATH", "/bin"), ("SINGULATE_KEY", "sgl_"), ("SINGULATE_URL", "http://localhost")];
        let variables = variables(&[&[("SINGULATE_THREADS", "5"), ("SINGULATE_QUEUE", "6")], &others[..]].concat());
        let config = load(&stated, variables).unwrap();
        std::fs::remove_file(path).unwrap();
        assert_eq!((config.server.threads, config.server.queue, config.log.as_str()), (7, 6, "warn"));
        assert!((config.server.limits.scene.overlap_tolerance - 0.002).abs() < 1e-12);
        assert_eq!(config.listen, Config::default().listen);
    }

    #[test]
    fn every_fault_is_told_with_its_source() {
        let path = file("faults", "thread = 2\nqueue = true\nlisten = 'here'\n");
        let stated = Stated { config: None, flags: vec![flag("max_objects", "many")] };
        let at = path.to_str().unwrap();
        let list = [("SINGULATE_CONFIG", at), ("SINGULATE_THREADS", "0"), ("SINGULATE_TREADS", "2")];
        let ConfigError(mut faults) = load(&stated, variables(&list)).unwrap_err();
        std::fs::remove_file(&path).unwrap();
        faults.sort_unstable();
        let expected = [
            "--max-objects: 'many' is not a whole number from 1 to 1000000".to_owned(),
            "SINGULATE_THREADS: '0' is not a whole number from 1 to 1000000".to_owned(),
            format!("listen in {at}: 'here' is not an address and port like 0.0.0.0:8080"),
            format!("queue in {at}: a boolean is no value for this setting"),
            format!("thread in {at}: there is no such setting; did you mean threads?"),
            // May have been meant for one of these.
            "warning: SINGULATE_TREADS: there is no such setting, so it changes nothing; did you mean SINGULATE_THREADS?"
                .to_owned(),
        ];
        assert_eq!(faults, expected);
    }

    #[test]
    fn an_unknown_variable_is_named_with_the_one_that_was_meant_and_without_its_value() {
        let list = [
            ("SINGULATE_TREADS", "2"),
            ("SINGULATE_PORT", "tcp://10.0.0.1:8080"),
            ("SINGULATE_CALLBACK_SECRETS", "quiet"),
            ("SINGULATE_KEY", "sgl_"),
            ("SINGULATE_CONFIGS", "x"),
            ("SINGULATE_", "x"),
            ("SINGULATED", "x"),
        ];
        let config = load(&Stated::default(), variables(&list)).unwrap();
        let unknown = |name: &str, rest: &str| format!("{name}: there is no such setting, so it changes nothing{rest}");
        let expected = [
            unknown("SINGULATE_", ""),
            unknown("SINGULATE_CALLBACK_SECRETS", "; did you mean SINGULATE_CALLBACK_SECRET?"),
            unknown("SINGULATE_CONFIGS", "; did you mean SINGULATE_CONFIG?"),
            unknown(
                "SINGULATE_PORT",
                "; container managers set it beside a service of this name; where to listen is SINGULATE_LISTEN",
            ),
            unknown("SINGULATE_TREADS", "; did you mean SINGULATE_THREADS?"),
        ];
        assert_eq!(config.unknown_variables, expected);
    }

    #[test]
    fn no_fault_shows_a_secret() {
        let texts = [
            "callback_secret = 'quiet\n",
            "log = 'warn'\ncallback_secret = \"quiet\\x\"\n",
            "callback_secret = 'quiet'\n",
        ];
        for (at, text) in texts.into_iter().enumerate() {
            let path = file(&format!("secret-{at}"), text);
            let stated = Stated { config: Some(path.clone()), flags: vec![flag("callback_secret", "quiet")] };
            let ConfigError(faults) = load(&stated, variables(&[("SINGULATE_CALLBACK_SECRET", "quiet")])).unwrap_err();
            std::fs::remove_file(path).unwrap();
            assert!(faults.len() == 3 && !faults.concat().contains("quiet"), "{faults:?}");
            assert!(at == 2 || faults[0].contains(&format!("line {}: ", at + 1)), "{faults:?}");
        }
        let long = "quiet as a mouse in a box";
        let stated = Stated { config: None, flags: vec![flag("callback_secret", long)] };
        let config = load(&stated, []).unwrap();
        let shown = SETTINGS.iter().map(|setting| setting.get(&config)).collect::<String>();
        assert!(!format!("{config:?}{config:#?}{shown}").contains("quiet"));
    }

    #[test]
    fn a_service_that_calls_back_has_a_secret() {
        let allow = flag("callback_allow", "erp.example.com");
        let secret = flag("callback_secret", "0123456789abcdef");
        for (flags, sound) in [(vec![], true), (vec![allow.clone()], false), (vec![allow, secret], true)] {
            let config = load(&Stated { config: None, flags }, []).unwrap();
            assert_eq!(config.check_service().is_ok(), sound);
        }
    }

    #[test]
    fn a_file_that_is_not_there_or_not_toml_is_a_fault() {
        for path in [PathBuf::from("/nowhere/at/all.toml"), file("broken", "threads = ")] {
            let stated = Stated { config: Some(path.clone()), flags: Vec::new() };
            let ConfigError(faults) = load(&stated, []).unwrap_err();
            assert!(faults[0].starts_with(path.to_str().unwrap()) && faults.len() == 1, "{faults:?}");
        }
    }
}
