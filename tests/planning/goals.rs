//! Goals, drop-offs and openings against exhaustive search on small scenes.

mod clear;
mod destinations;
mod exhaustive;
mod named;
mod small;
