//! Whole answers: golden scenes and bases, generated scenes, the checker.

#![expect(clippy::unwrap_used, reason = "what fails here fails the test")]

mod bases;
mod check;
mod generated;
mod goals;
mod moved;
mod noise;
mod paper;
mod quiet;
mod raster;
mod scene_bases;
mod scenes;
mod space;
