//! What is asked of a statement.

/// Position tolerances, m. An object a metre from its stated place is elsewhere; such a number is in another unit.
pub const POSITION_TOLERANCE_RANGE: (f64, f64) = (0.0, 1.0);

/// The terms of a check. By default the whole statement must hold on the scene as it is.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Terms {
    /// How far an object that is moved may stand from its stated place, m, within [`POSITION_TOLERANCE_RANGE`]. The steps are
    /// replayed from the scene's places. Above 0, stated slacks and gaps are not compared: they belong to the stated places.
    pub position_tolerance: f64,
    /// True for a part of a plan: the steps that are left, or the next one. Only the steps and the final grasp, if there is
    /// one, are checked. Stated slacks and gaps are not compared: other objects may have been moved since.
    pub partial: bool,
}

impl Terms {
    /// True if the stated slacks and gaps must be those of the scene.
    pub(super) fn exact(&self) -> bool {
        self.position_tolerance <= 0.0 && !self.partial
    }
}
