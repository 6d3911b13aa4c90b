//! The operator's settings. Precedence: flag, variable, file, default.

mod addresses;
mod closest;
mod load;
mod setting;
mod settings;

use std::net::{Ipv4Addr, SocketAddr};

use crate::api::ServerSettings;
use crate::keys::Keys;

pub use load::{ConfigError, Source, Stated, load};
pub use setting::{NeededBy, Setting};
pub use settings::SETTINGS;

use crate::telemetry::{Endpoint, LogFormat};
use crate::tls::Certificates;

/// Every setting with its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Config {
    /// The listen address.
    pub listen: SocketAddr,
    /// The service and its limits.
    pub server: ServerSettings,
    /// Allows open access on any address.
    pub insecure: bool,
    /// The log filter: a level, and levels for parts of the program.
    pub log: String,
    /// The log format.
    pub log_format: LogFormat,
    /// The receiver of traces, if any.
    pub otlp_endpoint: Option<Endpoint>,
    /// Unknown variables with our prefix, one sentence each.
    pub unknown_variables: Vec<String>,
}

impl Config {
    /// Checks combinations of settings for the service.
    ///
    /// # Errors
    /// The missing, contradictory or invalid settings.
    pub fn check_service(&self) -> Result<(), ConfigError> {
        let jobs = &self.server.jobs;
        let mut faults = Vec::new();
        if !jobs.callback_allow.is_empty() && jobs.callback_secret.is_none() {
            let fault = "callback_allow needs callback_secret: a receiver could not tell our callbacks from others'";
            faults.push(fault.to_owned());
        }
        match &self.server.api_keys_file {
            Some(_) if self.insecure => {
                faults.push("insecure serves everybody, api_keys_file only some: choose one of them".to_owned());
            }
            Some(path) => faults.extend(Keys::open(path).err().into_iter().flat_map(|error| error.0)),
            None if self.insecure || self.listen.ip().is_loopback() => {}
            None => faults.push(self.without_keys()),
        }
        faults.extend(Certificates::read(&self.server.tls).err().map(|error| error.to_string()));
        if faults.is_empty() { Ok(()) } else { Err(ConfigError(faults).beside(&self.unknown_variables)) }
    }

    /// Says that open access to other machines must be allowed explicitly.
    fn without_keys(&self) -> String {
        let listen = self.listen;
        format!(
            "Other machines can reach {listen}, but there are no API keys. Either make keys:\n\n  \
             singulate key new NAME --api-keys-file keys.toml\n  \
             singulate serve --listen {listen} --api-keys-file keys.toml\n\n\
             or let everybody in who can reach it:\n\n  \
             singulate serve --listen {listen} --insecure\n\n\
             The variables SINGULATE_API_KEYS_FILE=FILE and SINGULATE_INSECURE=true do the same."
        )
    }

    /// A start-up warning about open access, unless it was allowed explicitly and only this machine can connect.
    pub fn warning(&self) -> Option<&'static str> {
        match (&self.server.api_keys_file, self.insecure, self.listen.ip().is_loopback()) {
            (Some(_), ..) | (None, true, true) => None,
            (None, false, _) => Some("NO KEYS: every program on this machine may call; see --api-keys-file"),
            (None, true, false) => Some("NO KEYS: anybody who can reach the service may call; see --api-keys-file"),
        }
    }
}

impl Default for Config {
    fn default() -> Self {
        Self {
            listen: SocketAddr::from((Ipv4Addr::LOCALHOST, addresses::DEFAULT_PORT)),
            server: ServerSettings::default(),
            insecure: false,
            log: "info".to_owned(),
            log_format: LogFormat::default(),
            otlp_endpoint: None,
            unknown_variables: Vec::new(),
        }
    }
}
