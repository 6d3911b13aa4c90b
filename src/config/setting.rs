//! The list of settings: each one once, whatever it is set by.

use core::time::Duration;

use super::Config;
use crate::telemetry;
use crate::telemetry::LogFormat;

/// Who needs a setting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// The service alone.
    Service,
    /// Whoever reads a scene.
    Planning,
}

/// One setting: `max_objects` is the flag `--max-objects`, the variable `SINGULATE_MAX_OBJECTS` and the key `max_objects`.
#[derive(Debug)]
pub struct Setting {
    /// Its key in the file.
    pub name: &'static str,
    /// Who needs it.
    pub scope: Scope,
    /// What stands for the value in the help.
    pub placeholder: &'static str,
    /// One sentence.
    pub help: &'static str,
    /// Writes a value into the configuration, or says what is wrong with it.
    pub set: fn(&mut Config, &str) -> Result<(), String>,
    /// The value as `set` would take it; of a secret only whether there is one.
    pub get: fn(&Config) -> String,
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
}

/// The most threads, queue places and connections: far above any machine, far below what a typing error makes of them.
const MAX_COUNT: u64 = 1_000_000;
/// A day. A longer time limit is a typing error.
const MAX_MS: u64 = 86_400_000;
/// 1 GB.
const MAX_BYTES: u64 = 1_000_000_000;

/// Every setting.
pub static SETTINGS: &[Setting] = &[
    Setting {
        name: "listen",
        scope: Scope::Service,
        placeholder: "ADDR:PORT",
        help: "Where to listen; port 0 takes any free one",
        set: |config, text| {
            config.listen =
                text.parse().map_err(|_| format!("'{text}' is not an address and port like 0.0.0.0:8080"))?;
            Ok(())
        },
        get: |config| config.listen.to_string(),
    },
    Setting {
        name: "threads",
        scope: Scope::Service,
        placeholder: "N",
        help: "Planning threads; one per core where nothing is said",
        set: |config, text| count(text, 1, &mut config.server.threads),
        get: |config| config.server.threads.to_string(),
    },
    Setting {
        name: "queue",
        scope: Scope::Service,
        placeholder: "N",
        help: "Requests that may wait for a planning thread; more are refused with 503",
        set: |config, text| count(text, 0, &mut config.server.queue),
        get: |config| config.server.queue.to_string(),
    },
    Setting {
        name: "max_connections",
        scope: Scope::Service,
        placeholder: "N",
        help: "Connections at a time; more wait to be accepted",
        set: |config, text| count(text, 1, &mut config.server.connections),
        get: |config| config.server.connections.to_string(),
    },
    Setting {
        name: "max_body_bytes",
        scope: Scope::Service,
        placeholder: "BYTES",
        help: "The largest request body",
        set: |config, text| {
            config.server.max_body_bytes = size(whole(text, 1, MAX_BYTES)?);
            Ok(())
        },
        get: |config| config.server.max_body_bytes.to_string(),
    },
    Setting {
        name: "header_timeout_ms",
        scope: Scope::Service,
        placeholder: "MS",
        help: "How long a request's head may take",
        set: |config, text| milliseconds(text, &mut config.server.header_timeout),
        get: |config| config.server.header_timeout.as_millis().to_string(),
    },
    Setting {
        name: "body_timeout_ms",
        scope: Scope::Service,
        placeholder: "MS",
        help: "How long a request's body may take",
        set: |config, text| milliseconds(text, &mut config.server.body_timeout),
        get: |config| config.server.body_timeout.as_millis().to_string(),
    },
    Setting {
        name: "write_timeout_ms",
        scope: Scope::Service,
        placeholder: "MS",
        help: "How long a client may take nothing of an answer that waits for it",
        set: |config, text| milliseconds(text, &mut config.server.write_timeout),
        get: |config| config.server.write_timeout.as_millis().to_string(),
    },
    Setting {
        name: "jobs_url",
        scope: Scope::Service,
        placeholder: "URL",
        help: "Where jobs are kept: sqlite:PATH, sqlite::memory: or postgres://…",
        set: |config, text| {
            if !["sqlite:", "postgres:", "postgresql:"].iter().any(|scheme| text.starts_with(scheme)) {
                // The rest may hold a password.
                let scheme = text.split_once(':').map_or("", |(scheme, _)| scheme);
                return Err(format!("an address that begins with '{scheme}:' is neither sqlite: nor postgres:"));
            }
            text.clone_into(&mut config.server.jobs.url);
            Ok(())
        },
        get: |config| config.server.jobs.url.clone(),
    },
    Setting {
        name: "job_threads",
        scope: Scope::Service,
        placeholder: "N",
        help: "Planning threads for jobs; one per core where nothing is said",
        set: |config, text| count(text, 1, &mut config.server.jobs.threads),
        get: |config| config.server.jobs.threads.to_string(),
    },
    Setting {
        name: "max_queued_jobs",
        scope: Scope::Service,
        placeholder: "N",
        help: "Jobs that may wait in the store; more are refused with 503",
        set: |config, text| count(text, 0, &mut config.server.jobs.max_queued),
        get: |config| config.server.jobs.max_queued.to_string(),
    },
    Setting {
        name: "job_lease_ms",
        scope: Scope::Service,
        placeholder: "MS",
        help: "For how long a worker that says nothing keeps its job",
        set: |config, text| {
            // Below a second a busy machine would take jobs from workers that live.
            config.server.jobs.lease = Duration::from_millis(whole(text, 1000, MAX_MS)?);
            Ok(())
        },
        get: |config| config.server.jobs.lease.as_millis().to_string(),
    },
    Setting {
        name: "job_ttl_ms",
        scope: Scope::Service,
        placeholder: "MS",
        help: "How long a job may wait, and for how long an ended one is kept",
        set: |config, text| milliseconds(text, &mut config.server.jobs.ttl),
        get: |config| config.server.jobs.ttl.as_millis().to_string(),
    },
    Setting {
        name: "max_waiting",
        scope: Scope::Service,
        placeholder: "N",
        help: "Clients that may wait for the ends of jobs at a time",
        set: |config, text| count(text, 0, &mut config.server.max_waiting),
        get: |config| config.server.max_waiting.to_string(),
    },
    Setting {
        name: "max_streams",
        scope: Scope::Service,
        placeholder: "N",
        help: "Clients that may listen to the events of jobs at a time",
        set: |config, text| count(text, 0, &mut config.server.max_streams),
        get: |config| config.server.max_streams.to_string(),
    },
    Setting {
        name: "drain_ms",
        scope: Scope::Service,
        placeholder: "MS",
        help: "How long what runs has to end once the service is asked to",
        set: |config, text| milliseconds(text, &mut config.server.drain),
        get: |config| config.server.drain.as_millis().to_string(),
    },
    Setting {
        name: "callback_allow",
        scope: Scope::Service,
        placeholder: "HOSTS",
        help: "Who may be told of a job's end: names, *.name, addresses, ranges; separated by commas",
        set: |config, text| {
            config.server.jobs.callback_allow = text.parse()?;
            Ok(())
        },
        get: |config| config.server.jobs.callback_allow.to_string(),
    },
    Setting {
        name: "callback_secret",
        scope: Scope::Service,
        placeholder: "SECRET",
        help: "What callbacks are signed with; better set by the variable, which other users can't list",
        set: |config, text| {
            config.server.jobs.callback_secret = if text == "none" { None } else { Some(text.parse()?) };
            Ok(())
        },
        get: |config| if config.server.jobs.callback_secret.is_some() { "hidden" } else { "none" }.to_owned(),
    },
    Setting {
        name: "otlp_endpoint",
        scope: Scope::Service,
        placeholder: "URL|off",
        help: "Where traces go: a collector of OTLP over HTTP, such as http://localhost:4318",
        set: |config, text| {
            config.otlp_endpoint = if text == "off" { None } else { Some(text.parse()?) };
            Ok(())
        },
        get: |config| config.otlp_endpoint.as_ref().map_or("off".to_owned(), ToString::to_string),
    },
    Setting {
        name: "max_objects",
        scope: Scope::Planning,
        placeholder: "N",
        help: "The most objects of a scene",
        set: |config, text| count(text, 1, &mut config.server.limits.scene.max_objects),
        get: |config| config.server.limits.scene.max_objects.to_string(),
    },
    Setting {
        name: "max_neighbours",
        scope: Scope::Planning,
        placeholder: "N",
        help: "The most obstacles in reach of one grasp",
        set: |config, text| count(text, 1, &mut config.server.limits.scene.max_neighbours),
        get: |config| config.server.limits.scene.max_neighbours.to_string(),
    },
    Setting {
        name: "overlap_tolerance",
        scope: Scope::Planning,
        placeholder: "METRES",
        help: "How deep two discs may overlap and still pass as perception noise",
        set: |config, text| {
            let value = text.parse().ok().filter(|value| (0.0..=1e3).contains(value));
            let value = value.ok_or_else(|| format!("'{text}' is not a number from 0 to 1000"))?;
            config.server.limits.scene.overlap_tolerance = value;
            Ok(())
        },
        get: |config| config.server.limits.scene.overlap_tolerance.to_string(),
    },
    Setting {
        name: "raster_resolution",
        scope: Scope::Planning,
        placeholder: "METRES",
        help: "The side of a pixel where a scene asks for `placement: raster`",
        set: |config, text| {
            let value = text.parse().ok().filter(|value| (1e-6..=1e3).contains(value));
            let value = value.ok_or_else(|| format!("'{text}' is not a number from 0.000001 to 1000"))?;
            config.server.limits.raster_resolution = value;
            Ok(())
        },
        get: |config| config.server.limits.raster_resolution.to_string(),
    },
    Setting {
        name: "default_time_limit_ms",
        scope: Scope::Planning,
        placeholder: "MS",
        help: "The time limit of a scene that names none",
        set: |config, text| milliseconds(text, &mut config.server.limits.default_time_limit),
        get: |config| config.server.limits.default_time_limit.as_millis().to_string(),
    },
    Setting {
        name: "max_time_limit_ms",
        scope: Scope::Planning,
        placeholder: "MS",
        help: "The longest time limit that a scene may name",
        set: |config, text| milliseconds(text, &mut config.server.limits.max_time_limit),
        get: |config| config.server.limits.max_time_limit.as_millis().to_string(),
    },
    Setting {
        name: "log",
        scope: Scope::Planning,
        placeholder: "FILTER",
        help: "Which log lines go to stderr, such as warn or info,singulate=debug",
        set: |config, text| {
            telemetry::filter(text)?;
            text.clone_into(&mut config.log);
            Ok(())
        },
        get: |config| config.log.clone(),
    },
    Setting {
        name: "log_format",
        scope: Scope::Planning,
        placeholder: "text|json",
        help: "How log lines are written",
        set: |config, text| {
            config.log_format = match text {
                "text" => LogFormat::Text,
                "json" => LogFormat::Json,
                _ => return Err(format!("'{text}' is neither text nor json")),
            };
            Ok(())
        },
        get: |config| {
            let word = match config.log_format {
                LogFormat::Text => "text",
                LogFormat::Json => "json",
            };
            word.to_owned()
        },
    },
];

fn whole(text: &str, least: u64, most: u64) -> Result<u64, String> {
    let value = text.parse().ok().filter(|value| (least..=most).contains(value));
    value.ok_or_else(|| format!("'{text}' is not a whole number from {least} to {most}"))
}

fn count(text: &str, least: u64, value: &mut usize) -> Result<(), String> {
    *value = size(whole(text, least, MAX_COUNT)?);
    Ok(())
}

/// Every bound above is below 2³².
fn size(value: u64) -> usize {
    usize::try_from(value).unwrap_or(usize::MAX)
}

fn milliseconds(text: &str, value: &mut Duration) -> Result<(), String> {
    *value = Duration::from_millis(whole(text, 1, MAX_MS)?);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_takes_back_what_it_shows() {
        for setting in SETTINGS {
            let mut config = Config::default();
            let shown = (setting.get)(&config);
            (setting.set)(&mut config, &shown).unwrap();
            assert_eq!(config, Config::default(), "{}", setting.name);
        }
    }

    #[test]
    fn a_value_that_makes_no_sense_is_refused() {
        for setting in SETTINGS {
            for text in ["", "-1", "=,=", "1e99"] {
                let outcome = (setting.set)(&mut Config::default(), text);
                // A host may be called so.
                let host = setting.name == "callback_allow" && text == "1e99";
                assert!(outcome.is_err() || setting.name == "log" || host, "{} takes '{text}'", setting.name);
            }
        }
    }
}
