//! Plans the fewest relocations that free an object on a crowded table, and proves it.
//!
//! The arithmetic is the library `singulate_planner`; this is the service round it. [`wire`] knows JSON, [`keys`] who may
//! call, [`workers`] threads, [`computation`] what a planning call is, [`jobs`] what outlives it, [`api`] HTTP, [`tls`] how
//! nobody else reads it, [`render`] drawings, [`experiments`] made-up scenes and the paper's tables, [`metrics`] what is
//! counted and timed, [`traces`] which call led to what, [`cli`] the command line, [`config`] its settings,
//! [`watched_files`] what may be replaced meanwhile, and [`telemetry`] where log lines and traces go.

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
