//! The ranges of numbers, and the limits on a scene's size.

/// Coordinates, m. At 100 km a double still resolves 1.5e-11 m, well below the checker's 1e-9 m.
pub const COORDINATE_RANGE: (f64, f64) = (-1e5, 1e5);
/// Radii, sides, heights, finger width and length, palm, clearance and greatest opening, m.
pub const LENGTH_RANGE: (f64, f64) = (1e-6, 1e3);
/// Margin, m.
pub const MARGIN_RANGE: (f64, f64) = (0.0, 1e3);
/// Yaw tolerance, rad.
pub const YAW_TOLERANCE_RANGE: (f64, f64) = (0.0, core::f64::consts::PI);
/// The height of fingertips over the table, m.
pub const TIP_HEIGHT_RANGE: (f64, f64) = (0.0, 1e3);
/// How far an object, or a grasp in its frame, is turned, rad. A tracker may count whole turns.
pub const YAW_RANGE: (f64, f64) = (-1e3, 1e3);
/// The points of a polygon in the object's own frame, m.
pub const POINT_RANGE: (f64, f64) = (-1e3, 1e3);
/// The gripper's axis in the object's own frame, m.
pub const GRASP_OFFSET_RANGE: (f64, f64) = (-1e3, 1e3);
/// The most points of a polygon.
pub const MAX_POINTS: usize = 32;
/// The most grasps of one object. A set of them is 64 bits.
pub const MAX_GRASPS: usize = 64;
/// What it may take at most to find out where the fingers close on all objects, in turns of a finger times corners of an object: some
/// 0.2 s.
pub const MAX_CLOSING_WORK: usize = 20_000_000;
/// k: two fingers are the fewest that hold, and no gripper is known with more than twelve.
pub const FINGERS_RANGE: (f64, f64) = (2.0, 12.0);
/// How many objects a drop-off takes.
pub const CAPACITY_RANGE: (f64, f64) = (1.0, 1e9);
/// The most drop-offs: more than a cell can reach.
pub const MAX_DROP_OFFS: usize = 1000;
/// The longest id, in characters. Ids are repeated many times in an answer.
pub const MAX_ID_LENGTH: usize = 128;

/// The limits of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneLimits {
    /// The most objects.
    pub max_objects: usize,
    /// The most obstacles within reach of one grasp.
    pub max_neighbours: usize,
    /// The deepest overlap of two footprints that counts as perception noise, m.
    pub overlap_tolerance: f64,
}

impl Default for SceneLimits {
    fn default() -> Self {
        Self {
            // Far more than a table holds; knowledge of so many still takes tens of milliseconds.
            max_objects: 10_000,
            // A dish among dishes has six. So many can only be crumbs, whose options would waste memory.
            max_neighbours: 256,
            // A usual error of a camera.
            overlap_tolerance: 1e-3,
        }
    }
}
