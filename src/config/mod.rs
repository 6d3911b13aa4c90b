//! What the operator may set, and from where: flag before variable before file before default.

mod load;
mod setting;
mod settings;

use std::net::{Ipv4Addr, SocketAddr};

use crate::api::ServerSettings;

pub use load::{ConfigError, Source, Stated, load};
pub use setting::{Scope, Setting};
pub use settings::SETTINGS;

use crate::telemetry::{Endpoint, LogFormat};
use crate::tls::Certificates;

/// Every setting with its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Config {
    /// Where the service listens.
    pub listen: SocketAddr,
    /// The service and its limits.
    pub server: ServerSettings,
    /// Which log lines are written, as `tracing` filters are written.
    pub log: String,
    /// How they are written.
    pub log_format: LogFormat,
    /// Where traces go, if anywhere.
    pub otlp_endpoint: Option<Endpoint>,
}

impl Config {
    /// What a service needs beyond settings that are sound one by one.
    ///
    /// # Errors
    /// What is missing, or does not fit together.
    pub fn check_service(&self) -> Result<(), ConfigError> {
        let jobs = &self.server.jobs;
        if !jobs.callback_allow.is_empty() && jobs.callback_secret.is_none() {
            let fault = "callback_allow needs callback_secret: a receiver could not tell our callbacks from others'";
            return Err(ConfigError(vec![fault.to_owned()]));
        }
        Certificates::read(&self.server.tls).map_err(|error| ConfigError(vec![error.to_string()]))?;
        Ok(())
    }
}

impl Default for Config {
    fn default() -> Self {
        Self {
            listen: SocketAddr::from((Ipv4Addr::LOCALHOST, 8080)),
            server: ServerSettings::default(),
            log: "info".to_owned(),
            log_format: LogFormat::default(),
            otlp_endpoint: None,
        }
    }
}
