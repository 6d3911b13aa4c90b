//! The type of a setting, independent of its source.

use core::time::Duration;
use std::path::PathBuf;

use super::Config;

/// A day. A longer time is a typing error.
const MAX_MS: u64 = 86_400_000;

/// The value for no file.
const NO_FILE: &str = "none";

/// The commands that need a setting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NeededBy {
    /// The service alone.
    Service,
    /// All commands that read a scene.
    Planning,
}

/// One setting: `max_objects` is the flag `--max-objects`, the variable `SINGULATE_MAX_OBJECTS` and the key `max_objects`.
#[derive(Debug)]
pub struct Setting {
    /// Its key in the file.
    pub name: &'static str,
    /// The commands that need it.
    pub needed_by: NeededBy,
    /// The placeholder for its value in the help.
    pub placeholder: &'static str,
    /// Its help, one sentence.
    pub help: &'static str,
    /// Its type and range.
    pub(super) value: Value,
}

/// The type and range of a value, and its field in the configuration.
#[derive(Debug)]
pub(super) enum Value {
    /// A whole number.
    Whole { least: u64, most: u64, field: fn(&mut Config) -> &mut usize },
    /// A number.
    Number { least: f64, most: f64, field: fn(&mut Config) -> &mut f64 },
    /// A boolean; the flag without a value means true.
    Switch { field: fn(&mut Config) -> &mut bool },
    /// A duration, up to a day.
    Milliseconds { least: u64, field: fn(&mut Config) -> &mut Duration },
    /// A file, or none.
    File { field: fn(&mut Config) -> &mut Option<PathBuf> },
    /// Any other type: how to parse and show it.
    Other { set: fn(&mut Config, &str) -> Result<(), String>, get: fn(&Config) -> String },
}

impl Setting {
    /// The flag, without its two dashes.
    pub fn flag(&self) -> String {
        self.name.replace('_', "-")
    }

    /// The environment variable.
    pub fn variable(&self) -> String {
        format!("SINGULATE_{}", self.name.to_uppercase())
    }

    /// True if its flag needs no value.
    pub fn is_switch(&self) -> bool {
        matches!(self.value, Value::Switch { .. })
    }

    /// Parse a value into the configuration.
    ///
    /// # Errors
    /// The fault of the value.
    pub fn set(&self, config: &mut Config, text: &str) -> Result<(), String> {
        match self.value {
            Value::Whole { least, most, field } => {
                // Every bound is below 2³².
                *field(config) = usize::try_from(whole(text, least, most)?).unwrap_or(usize::MAX);
            }
            Value::Number { least, most, field } => {
                let value = text.parse().ok().filter(|value| (least..=most).contains(value));
                *field(config) = value.ok_or_else(|| format!("'{text}' is not a number from {least} to {most}"))?;
            }
            Value::Switch { field } => {
                *field(config) = text.parse().map_err(|_| format!("'{text}' is neither true nor false"))?;
            }
            Value::Milliseconds { least, field } => *field(config) = Duration::from_millis(whole(text, least, MAX_MS)?),
            Value::File { .. } if text.is_empty() => return Err(format!("'' is no file; '{NO_FILE}' stands for none")),
            Value::File { field } => *field(config) = (text != NO_FILE).then(|| PathBuf::from(text)),
            Value::Other { set, .. } => set(config, text)?,
        }
        Ok(())
    }

    /// The value in the form that [`set`](Self::set) parses; for a secret only whether it is set.
    pub fn get(&self, config: &Config) -> String {
        let mut config = config.clone();
        match self.value {
            Value::Whole { field, .. } => field(&mut config).to_string(),
            Value::Number { field, .. } => field(&mut config).to_string(),
            Value::Switch { field } => field(&mut config).to_string(),
            Value::Milliseconds { field, .. } => field(&mut config).as_millis().to_string(),
            Value::File { field } => {
                field(&mut config).as_ref().map_or(NO_FILE.to_owned(), |path| path.display().to_string())
            }
            Value::Other { get, .. } => get(&config),
        }
    }
}

fn whole(text: &str, least: u64, most: u64) -> Result<u64, String> {
    let value = text.parse().ok().filter(|value| (least..=most).contains(value));
    value.ok_or_else(|| format!("'{text}' is not a whole number from {least} to {most}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::SETTINGS;

    #[test]
    fn every_setting_takes_back_what_it_shows() {
        for setting in SETTINGS {
            let mut config = Config::default();
            let shown = setting.get(&config);
            setting.set(&mut config, &shown).unwrap();
            assert_eq!(config, Config::default(), "{}", setting.name);
        }
    }

    #[test]
    fn a_value_that_makes_no_sense_is_refused() {
        for setting in SETTINGS {
            for text in ["", "-1", "=,=", "1e99"] {
                let outcome = setting.set(&mut Config::default(), text);
                // A host name may look like this, and a file name may be anything.
                let host = setting.name == "callback_allow" && text == "1e99";
                let file = matches!(setting.value, Value::File { .. }) && !text.is_empty();
                assert!(outcome.is_err() || host || file, "{} takes '{text}'", setting.name);
            }
        }
    }
}
