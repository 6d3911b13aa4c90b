//! Plans the fewest relocations that free an object on a crowded table, and proves it.
//!
//! The planner is the library `singulate_planner`; this is the service on top. [`wire`]: JSON. [`keys`]: API keys.
//! [`workers`]: the thread pool. [`computation`]: planning calls. [`jobs`]: durable jobs. [`api`]: HTTP. [`tls`]:
//! encryption. [`render`]: drawings. [`experiments`]: generated scenes and the paper's tables. [`metrics`]: counts and
//! times. [`traces`]: spans. [`cli`]: the command line. [`config`]: settings. [`watched_files`]: files that are
//! reloaded. [`telemetry`]: log lines and the export of traces.

pub mod api;
pub mod cli;
pub mod computation;
pub mod config;
pub mod experiments;
pub mod jobs;
pub mod keys;
pub mod metrics;
pub mod render;
pub mod telemetry;
pub mod tls;
pub mod traces;
pub mod watched_files;
pub mod wire;
pub mod workers;
