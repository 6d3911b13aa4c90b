//! Scenes made up from a seed.

mod arrange;
mod generate;
mod varied;

pub use generate::{Arrangement, GenerateError, Recipe, generate};
pub use varied::varied;
