//! Sends log lines to stderr and spans to a collector.

mod log;
mod otlp;

pub use log::{LogFormat, filter};
pub use otlp::{Endpoint, Export};

/// Start logging, and export traces if there is an endpoint.
///
/// # Errors
/// If the filter is invalid, logging has started already, or the exporter can't be made.
pub fn init(log: &str, format: LogFormat, endpoint: Option<&Endpoint>) -> Result<Option<Export>, String> {
    log::init(log, format)?;
    endpoint.map(Export::begin).transpose()
}
