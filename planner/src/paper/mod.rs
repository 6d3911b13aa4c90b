//! The paper's own methods, as printed: Kim, Jo, Lim & Kim, "Efficient Target Singulation with Multi-fingered Gripper using
//! Propositional Logic" (LOBS). Their known defects are reproduced and named, not repaired.
//!
//! | paper | here | known defects |
//! | --- | --- | --- |
//! | section IV.A, Eq. 1-4, 8-11: TG-MVFH+ | [`PolarHistogram`], [`Sector`] | fingers too wide: graspable objects are called blocked; their outer corners overlooked: now and then a blocked one is called graspable; Eq. 10 undefined or short inside the ring |
//! | section IV.B, Algorithm 1: LOBS | [`lobs`] | false deadlocks; not optimal; exponential products |
//! | section V, the baseline: A* | [`forward_astar`] | exponential in the number of objects that can be moved |
//! | section IV.C, Eq. 7: repositioning | [`reposition`] | releases that the gripper has no room for; later grasps blocked at the outer corners of wide fingers; no way back from a place that leaves none for a later object |
//!
//! [`plan_by`] runs them, judges them by our own planner, and returns the answer with its warnings.

mod angles;
mod conclusion;
mod dispatch;
mod dnf;
mod forward_astar;
mod histogram;
mod judge;
mod lobs;
mod methods;
mod planner;
mod raster;
mod sector;
mod warning;

pub use angles::tangent_angles;
pub use conclusion::Conclusion;
pub use dispatch::{SearchLimits, Sought, seek};
pub use forward_astar::forward_astar;
pub use histogram::{PolarHistogram, histograms};
pub use lobs::lobs;
pub use methods::{GraspModelName, Methods, PlacementMethod, SearchMethod};
pub use planner::{Judged, plan_by};
pub use raster::{DEFAULT_RESOLUTION, Raster, TooFine, reposition};
pub use sector::Sector;
pub use warning::{Cause, Warning};
