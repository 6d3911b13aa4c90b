//! Whole answers: golden scenes and bases, generated scenes, the checker.

mod bases;
mod check;
mod generated;
mod scene_bases;
mod scenes;
mod space;
