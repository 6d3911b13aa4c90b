//! Whole answers: golden scenes and bases, generated scenes, the checker.

mod bases;
mod check;
mod generated;
mod scenes;
mod space;
