//! What blocks the grasps of one object at the start.

use crate::scene::ObjectIndex;

/// An interval of yaws that one obstacle blocks.
pub(super) struct Shade {
    pub(super) lo: f64,
    pub(super) hi: f64,
    pub(super) by: ObjectIndex,
}

/// A listed grasp at the start.
pub(super) struct Listed {
    /// The direction of finger 0, rad.
    pub(super) yaw: f64,
    /// The obstacles that block it.
    pub(super) by: Vec<ObjectIndex>,
}

/// What blocks the grasps of one object at the start.
pub(super) enum Ring {
    /// Of one that may be grasped at every yaw: the blocked yaws, sorted by where they begin.
    EveryYaw(Vec<Shade>),
    /// Of one with listed grasps: those that are not too wide.
    Listed(Vec<Listed>),
}

impl Ring {
    fn parts(&self) -> (&[Shade], &[Listed]) {
        match self {
            Self::EveryYaw(shades) => (shades, &[]),
            Self::Listed(grasps) => (&[], grasps),
        }
    }

    /// The number of intervals, or of obstacles of all grasps.
    pub(super) fn len(&self) -> usize {
        let (shades, grasps) = self.parts();
        shades.len() + grasps.iter().map(|grasp| grasp.by.len()).sum::<usize>()
    }

    /// The obstacles that block some grasp, once for each grasp or interval.
    pub(super) fn blockers(&self) -> impl Iterator<Item = ObjectIndex> + '_ {
        let (shades, grasps) = self.parts();
        shades.iter().map(|shade| shade.by).chain(grasps.iter().flat_map(|grasp| grasp.by.iter().copied()))
    }
}
