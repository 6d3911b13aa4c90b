//! Limits on requests.

use core::time::Duration;

use singulate_planner::paper::DEFAULT_RESOLUTION;
use singulate_planner::scene::SceneLimits;

/// The longest scene id, characters: it is in every log line of its request.
pub const MAX_SCENE_ID_LENGTH: usize = 256;

/// Limits on requests.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RequestLimits {
    /// The limits of a scene; its overlap tolerance is the default.
    pub scene: SceneLimits,
    /// The greatest overlap tolerance of a request, m; see also
    /// [`greatest_overlap_tolerance`](Self::greatest_overlap_tolerance).
    pub max_overlap_tolerance: f64,
    /// The default time limit.
    pub default_time_limit: Duration,
    /// The longest time limit of a request.
    pub max_time_limit: Duration,
    /// The pixel size of the images for `placement: raster`, m.
    pub raster_resolution: f64,
}

impl Default for RequestLimits {
    fn default() -> Self {
        Self {
            scene: SceneLimits::default(),
            // Two centres that are off by 5 mm each. Beyond that most dishes of a scene would be noise.
            max_overlap_tolerance: 1e-2,
            // A thousand times what most scenes take, and a wait that a robot tolerates.
            default_time_limit: Duration::from_millis(1000),
            // The paper's own limit. A longer request would hold its thread for as long.
            max_time_limit: Duration::from_millis(60_000),
            raster_resolution: DEFAULT_RESOLUTION,
        }
    }
}

impl RequestLimits {
    /// The greatest overlap tolerance of a request, m. The default is always allowed.
    pub fn greatest_overlap_tolerance(&self) -> f64 {
        self.max_overlap_tolerance.max(self.scene.overlap_tolerance)
    }
}

/// The most scenes of one batch. More would make a transaction that blocks others for too long.
pub const MAX_BATCH: usize = 100;
/// The longest callback URL, characters: all servers accept this much.
pub const MAX_CALLBACK_URL_LENGTH: usize = 2000;
/// The least and the greatest priority.
pub const PRIORITY_RANGE: (i64, i64) = (-100, 100);
