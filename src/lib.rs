//! Plans the fewest relocations that free an object on a crowded table, and proves it.
//!
//! In reading order: a checked [`scene`]; exact [`geometry`] of fingers and discs; the [`knowledge`] of which obstacles
//! must go first; the [`search`] for the least set of them, with its proof; the [`placement`] of what is moved; the
//! [`paper`]'s own methods; the [`plan`] that couples these and its independent checker. Round that pure core lie the
//! edges: [`wire`] knows JSON, [`keys`] who may call, [`workers`] threads, [`jobs`] what outlives them, [`api`] HTTP,
//! [`tls`] how nobody else reads it, [`render`] drawings, [`experiments`] made-up scenes and the
//! paper's tables, [`metrics`] what is counted and timed, [`traces`] which call led to what, [`cli`] the command line,
//! [`config`] its settings, [`watched_files`] what may be replaced meanwhile, and [`telemetry`] where log lines and traces go.

pub mod api;
pub mod budget;
pub mod cli;
pub mod config;
pub mod experiments;
pub mod geometry;
pub mod jobs;
pub mod keys;
pub mod knowledge;
pub mod metrics;
pub mod paper;
pub mod placement;
pub mod plan;
pub mod render;
pub mod scene;
pub mod search;
pub mod telemetry;
pub mod tls;
pub mod traces;
pub mod watched_files;
pub mod wire;
pub mod workers;
