//! Where log lines and traces go.

mod log;
mod otlp;

pub use log::{LogFormat, filter};
pub use otlp::{Endpoint, Export};

/// Begin to log, and to send traces where there is an endpoint.
///
/// # Errors
/// A filter that is none, logging that has begun already, or an exporter that can't be made.
pub fn init(log: &str, format: LogFormat, endpoint: Option<&Endpoint>) -> Result<Option<Export>, String> {
    log::init(log, format)?;
    endpoint.map(Export::begin).transpose()
}
