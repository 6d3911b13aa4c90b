//! Every setting, each once.

use core::time::Duration;
use std::path::PathBuf;

use super::Config;
use super::addresses;
use super::setting::{NeededBy, Setting, Value};
use crate::telemetry;
use crate::telemetry::LogFormat;

/// The most threads, queue places and connections: far above any machine, far below common typing errors.
const MAX_COUNT: u64 = 1_000_000;
/// 1 GB.
const MAX_BYTES: u64 = 1_000_000_000;

/// A file setting of the service.
const fn file(name: &'static str, help: &'static str, field: fn(&mut Config) -> &mut Option<PathBuf>) -> Setting {
    Setting { name, needed_by: NeededBy::Service, placeholder: "FILE", help, value: Value::File { field } }
}

/// A duration setting of the service.
const fn milliseconds(
    name: &'static str,
    least: u64,
    help: &'static str,
    field: fn(&mut Config) -> &mut Duration,
) -> Setting {
    Setting { name, needed_by: NeededBy::Service, placeholder: "MS", help, value: Value::Milliseconds { least, field } }
}

/// A count setting of the service.
const fn count(name: &'static str, least: u64, help: &'static str, field: fn(&mut Config) -> &mut usize) -> Setting {
    let value = Value::Whole { least, most: MAX_COUNT, field };
    Setting { name, needed_by: NeededBy::Service, placeholder: "N", help, value }
}

/// Every setting.
pub static SETTINGS: &[Setting] = &[
    Setting {
        name: "listen",
        needed_by: NeededBy::Service,
        placeholder: "ADDR:PORT",
        help: "The address and port to listen on; port 0 takes any free port",
        value: Value::Other {
            set: |config, text| {
                config.listen = addresses::listen(text)?;
                Ok(())
            },
            get: |config| config.listen.to_string(),
        },
    },
    file("api_keys_file", "The file of API keys, see `singulate key new`; read again when it changes", |config| {
        &mut config.server.api_keys_file
    }),
    Setting {
        name: "insecure",
        needed_by: NeededBy::Service,
        placeholder: "true|false",
        help: "Serve without API keys: anybody who can reach the service may use it",
        value: Value::Switch { field: |config| &mut config.insecure },
    },
    Setting {
        name: "cors_origins",
        needed_by: NeededBy::Service,
        placeholder: "ORIGINS",
        help: "Origins whose pages may call from a browser, such as https://cell.example.com; separated by commas",
        value: Value::Other {
            set: |config, text| {
                config.server.cors_origins = text.parse()?;
                Ok(())
            },
            get: |config| config.server.cors_origins.to_string(),
        },
    },
    file("tls_cert", "The service's certificate and its chain, PEM; the service then speaks TLS only", |config| {
        &mut config.server.tls.cert
    }),
    file("tls_key", "The certificate's private key, PEM", |config| &mut config.server.tls.key),
    file(
        "tls_client_ca",
        "The authorities that sign client certificates, PEM; every client then needs one",
        |config| &mut config.server.tls.client_ca,
    ),
    count("threads", 1, "Planning threads; by default one per core", |config| &mut config.server.threads),
    count("queue", 0, "The most requests that wait for a planning thread; more are refused with 503", |config| {
        &mut config.server.queue
    }),
    count("max_connections", 1, "The most open connections; more wait to be accepted", |config| {
        &mut config.server.connections
    }),
    Setting {
        name: "max_body_bytes",
        needed_by: NeededBy::Service,
        placeholder: "BYTES",
        help: "The largest request body",
        value: Value::Whole { least: 1, most: MAX_BYTES, field: |config| &mut config.server.max_body_bytes },
    },
    milliseconds("header_timeout_ms", 1, "How long a request's head may take", |config| {
        &mut config.server.header_timeout
    }),
    milliseconds("body_timeout_ms", 1, "How long a request's body may take", |config| &mut config.server.body_timeout),
    milliseconds("write_timeout_ms", 1, "How long a client may stop reading its answer", |config| {
        &mut config.server.write_timeout
    }),
    Setting {
        name: "jobs_url",
        needed_by: NeededBy::Service,
        placeholder: "URL",
        help: "Where jobs are kept: sqlite:PATH, sqlite::memory: or postgres://…",
        value: Value::Other {
            set: |config, text| {
                config.server.jobs.url = addresses::jobs_url(text)?;
                Ok(())
            },
            get: |config| config.server.jobs.url.clone(),
        },
    },
    count("job_threads", 1, "Planning threads for jobs; by default one per core", |config| {
        &mut config.server.jobs.threads
    }),
    count("max_queued_jobs", 0, "The most jobs that wait in the store; more are refused with 503", |config| {
        &mut config.server.jobs.max_queued
    }),
    // Below a second, jobs would be taken from live workers on a busy machine.
    milliseconds("job_lease_ms", 1000, "How long a silent worker keeps its job", |config| {
        &mut config.server.jobs.lease
    }),
    milliseconds("job_ttl_ms", 1, "How long a job may wait, and how long an ended job is kept", |config| {
        &mut config.server.jobs.ttl
    }),
    count("max_waiting", 0, "The most clients that wait for the end of a job at a time", |config| {
        &mut config.server.max_waiting
    }),
    count("max_streams", 0, "The most clients that follow the events of a job at a time", |config| {
        &mut config.server.max_streams
    }),
    milliseconds("drain_ms", 1, "How long running work may take to end during a shutdown", |config| {
        &mut config.server.drain
    }),
    Setting {
        name: "callback_allow",
        needed_by: NeededBy::Service,
        placeholder: "HOSTS",
        help: "Hosts that callbacks may go to: names, *.name, addresses, ranges; separated by commas",
        value: Value::Other {
            set: |config, text| {
                config.server.jobs.callback_allow = text.parse()?;
                Ok(())
            },
            get: |config| config.server.jobs.callback_allow.to_string(),
        },
    },
    Setting {
        name: "callback_secret",
        needed_by: NeededBy::Service,
        placeholder: "SECRET",
        help: "The secret that signs callbacks; better set by the variable, which other users can't read",
        value: Value::Other {
            set: |config, text| {
                config.server.jobs.callback_secret = if text == "none" { None } else { Some(text.parse()?) };
                Ok(())
            },
            get: |config| if config.server.jobs.callback_secret.is_some() { "hidden" } else { "none" }.to_owned(),
        },
    },
    Setting {
        name: "otlp_endpoint",
        needed_by: NeededBy::Service,
        placeholder: "URL|off",
        help: "The collector for traces, OTLP over HTTP, such as http://localhost:4318",
        value: Value::Other {
            set: |config, text| {
                config.otlp_endpoint = if text == "off" { None } else { Some(text.parse()?) };
                Ok(())
            },
            get: |config| config.otlp_endpoint.as_ref().map_or("off".to_owned(), ToString::to_string),
        },
    },
    Setting {
        name: "max_objects",
        needed_by: NeededBy::Planning,
        placeholder: "N",
        help: "The most objects of a scene",
        value: Value::Whole { least: 1, most: MAX_COUNT, field: |config| &mut config.server.limits.scene.max_objects },
    },
    Setting {
        name: "max_neighbours",
        needed_by: NeededBy::Planning,
        placeholder: "N",
        help: "The most obstacles in reach of one grasp",
        value: Value::Whole {
            least: 1,
            most: MAX_COUNT,
            field: |config| &mut config.server.limits.scene.max_neighbours,
        },
    },
    Setting {
        name: "overlap_tolerance",
        needed_by: NeededBy::Planning,
        placeholder: "METRES",
        help: "How deep two discs may overlap and still pass as perception noise, if the scene does not say",
        value: Value::Number {
            least: 0.0,
            most: 1e3,
            field: |config| &mut config.server.limits.scene.overlap_tolerance,
        },
    },
    Setting {
        name: "max_overlap_tolerance",
        needed_by: NeededBy::Planning,
        placeholder: "METRES",
        help: "The greatest `overlap_tolerance` that a scene may name, or `--overlap-tolerance` if that is greater",
        value: Value::Number { least: 0.0, most: 1e3, field: |config| &mut config.server.limits.max_overlap_tolerance },
    },
    Setting {
        name: "raster_resolution",
        needed_by: NeededBy::Planning,
        placeholder: "METRES",
        help: "The side of a pixel for scenes with `placement: raster`",
        value: Value::Number { least: 1e-6, most: 1e3, field: |config| &mut config.server.limits.raster_resolution },
    },
    Setting {
        name: "default_time_limit_ms",
        needed_by: NeededBy::Planning,
        placeholder: "MS",
        help: "The time limit of a scene that does not name one",
        value: Value::Milliseconds { least: 1, field: |config| &mut config.server.limits.default_time_limit },
    },
    Setting {
        name: "max_time_limit_ms",
        needed_by: NeededBy::Planning,
        placeholder: "MS",
        help: "The longest time limit that a scene may name",
        value: Value::Milliseconds { least: 1, field: |config| &mut config.server.limits.max_time_limit },
    },
    Setting {
        name: "log",
        needed_by: NeededBy::Planning,
        placeholder: "FILTER",
        help: "The level of log lines on stderr: off, error, warn, info, debug or trace; parts may have their own, such as info,singulate=debug",
        value: Value::Other {
            set: |config, text| {
                telemetry::filter(text)?;
                text.clone_into(&mut config.log);
                Ok(())
            },
            get: |config| config.log.clone(),
        },
    },
    Setting {
        name: "log_format",
        needed_by: NeededBy::Planning,
        placeholder: "text|json",
        help: "The format of log lines",
        value: Value::Other {
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
    },
];
