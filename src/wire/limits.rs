//! What a request may ask for at the most.

use core::time::Duration;

use singulate_planner::paper::DEFAULT_RESOLUTION;
use singulate_planner::scene::SceneLimits;

/// The longest scene id, characters: it stands in every log line of its request.
pub const MAX_SCENE_ID_LENGTH: usize = 256;

/// What a request may ask for at the most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RequestLimits {
    /// The limits of a scene; its overlap tolerance holds where a request names none.
    pub scene: SceneLimits,
    /// The greatest overlap tolerance that a request may name, m; see also
    /// [`greatest_overlap_tolerance`](Self::greatest_overlap_tolerance).
    pub max_overlap_tolerance: f64,
    /// The time limit of a request that names none.
    pub default_time_limit: Duration,
    /// The longest time limit that a request may name.
    pub max_time_limit: Duration,
    /// The side of a pixel of the images on which `placement: raster` finds places, m.
    pub raster_resolution: f64,
}

impl Default for RequestLimits {
    fn default() -> Self {
        Self {
            scene: SceneLimits::default(),
            // Two centres that are off by 5 mm each. Past that most dishes of a scene would be noise.
            max_overlap_tolerance: 1e-2,
            // A thousand times what most scenes take, and a robot bears to wait so long.
            default_time_limit: Duration::from_millis(1000),
            // The paper's own limit. Whoever has more time has a thread for as long.
            max_time_limit: Duration::from_millis(60_000),
            raster_resolution: DEFAULT_RESOLUTION,
        }
    }
}

impl RequestLimits {
    /// The greatest overlap tolerance that a request may name, m. What holds where it names none, it may always name.
    pub fn greatest_overlap_tolerance(&self) -> f64 {
        self.max_overlap_tolerance.max(self.scene.overlap_tolerance)
    }
}

/// The most scenes of one batch. More of them would be more than one transaction should hold others up for.
pub const MAX_BATCH: usize = 100;
/// The longest URL of a callback, characters: what all servers take.
pub const MAX_CALLBACK_URL_LENGTH: usize = 2000;
/// The least and the greatest priority.
pub const PRIORITY_RANGE: (i64, i64) = (-100, 100);
