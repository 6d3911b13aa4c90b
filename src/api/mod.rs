//! The HTTP interface: one file a resource, every route in [`router`], every status in `problem`.

mod accept;
mod access;
mod app;
mod body;
mod certificate;
mod connections;
mod cors;
mod docs;
mod document;
mod edge;
mod examples;
mod headers;
mod jobs;
mod knowledge;
mod metrics;
mod patience;
mod plans;
mod probes;
mod problem;
mod reading;
mod refusal;
mod router;
pub mod server;
mod settings;
mod socket;
mod survey;
mod transport;
mod unread;
mod verification;

pub use app::App;
pub use cors::CorsOrigins;
pub use document::{openapi, openapi_json};
pub use router::router;
pub use server::{Server, run};
pub use settings::ServerSettings;

pub use crate::workers::Engine;
