//! The paper's own methods, as printed: Kim, Jo, Lim & Kim, "Efficient Target Singulation with Multi-fingered Gripper using
//! Propositional Logic" (LOBS). Their known defects are reproduced and named, not repaired.

mod raster;

pub use raster::{DEFAULT_RESOLUTION, MAX_PIXELS, MAX_SIDE, Raster, TooFine, reposition};
