//! Exact geometry of fingers and discs: which yaws an obstacle blocks, which remain free.
//!
//! Between two ends of shadows nothing changes, so no angle is ever sampled: interval ends come from closed forms.

mod arcs;
mod finger;
mod grasp;
mod shadow;

pub use arcs::{Arc, ArcSet, FreeInterval};
pub use finger::{BlockedOffsets, SweptFinger};
pub use grasp::{Grasp, widest_grasp};
pub use shadow::{Shadow, shadow};
