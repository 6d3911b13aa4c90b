//! Whole answers: golden scenes and bases, generated scenes, the checker.

mod bases;
mod generated;
mod scenes;
