//! The HTTP interface: one file per resource; every route is in `operations` and [`router`], every problem response in
//! `problem`.

mod accept;
mod access;
mod app;
mod body;
mod browsers;
mod certificate;
mod connections;
mod docs;
mod document;
mod edge;
mod examples;
mod jobs;
mod operations;
mod patience;
mod planning;
mod probes;
mod problem;
mod refusal;
mod router;
mod running;
pub mod server;
mod settings;
mod transport;
mod unread;

pub use app::App;
pub use browsers::CorsOrigins;
pub use document::openapi_json;
pub use router::router;
pub use server::{Server, run};
pub use settings::ServerSettings;

pub use crate::computation::Engine;
