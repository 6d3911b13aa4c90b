//! Plans the fewest relocations that free an object on a crowded table, and proves it.

pub mod api;
pub mod budget;
pub mod cli;
pub mod config;
pub mod experiments;
pub mod jobs;
pub mod plan;
pub mod render;
pub mod scene;
pub mod telemetry;
pub mod wire;
