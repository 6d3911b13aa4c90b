//! The ranges of numbers, and how large a scene may be.

/// Coordinates, m. At 100 km a double still resolves 1.5e-11 m, well below the checker's 1e-9 m.
pub const COORDINATE_RANGE: (f64, f64) = (-1e5, 1e5);
/// Radii, finger width and clearance, m.
pub const LENGTH_RANGE: (f64, f64) = (1e-6, 1e3);
/// Margin, m.
pub const MARGIN_RANGE: (f64, f64) = (0.0, 1e3);
/// Yaw tolerance, rad.
pub const YAW_TOLERANCE_RANGE: (f64, f64) = (0.0, core::f64::consts::PI);
/// k: two fingers are the fewest that hold, and no gripper is known with more than twelve.
pub const FINGERS_RANGE: (f64, f64) = (2.0, 12.0);
/// The longest id, in characters: ids stand many times in an answer.
pub const MAX_ID_LENGTH: usize = 128;

/// What a scene may hold at the most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneLimits {
    /// Objects.
    pub max_objects: usize,
    /// Obstacles within reach of one grasp.
    pub max_neighbours: usize,
    /// How deep two discs may overlap and still pass as perception noise, m.
    pub overlap_tolerance: f64,
}

impl Default for SceneLimits {
    fn default() -> Self {
        Self {
            // Far more than a table holds; knowledge of so many still takes tens of milliseconds.
            max_objects: 10_000,
            // A dish among dishes has six; so many are crumbs, and their sets of blockers would cost memory for nothing.
            max_neighbours: 256,
            // What a camera is off by.
            overlap_tolerance: 1e-3,
        }
    }
}
