//! Exact geometry of fingers and footprints: which grasps an obstacle blocks, which remain free.
//!
//! No angle is sampled: blocked intervals change only at the ends of shadows, and these come from closed forms.

mod arcs;
mod finger;
mod grasp;
mod shadow;
mod turns;

pub use arcs::{Arc, ArcSet, FreeInterval};
pub use grasp::{Grasp, Hold, listed};
pub use shadow::{Shadow, shadow};
