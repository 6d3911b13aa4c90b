//! What a caller may choose.

use crate::geometry::{Shadow, shadow};
use crate::knowledge::{OptionsOf, swept_finger_options};
use crate::paper::{Raster, sector_options, sector_shadow};
use crate::placement::Objective;

/// How to plan.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Settings {
    /// Which yaws an obstacle blocks.
    pub grasp_model: GraspModel,
    /// What has to be moved.
    pub search: SearchMethod,
    /// Where it goes.
    pub placement: PlacementMethod,
    /// Which places are best.
    pub objective: Objective,
}

/// Which yaws an obstacle blocks.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum GraspModel {
    /// Exactly those at which a finger meets it.
    #[default]
    SweptFinger,
    /// The paper's: Eq. 1-4 and 8-10.
    Sector,
}

/// How the objects to relocate are found.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum SearchMethod {
    /// The least set, with proof.
    #[default]
    Landmarks,
    /// The paper's Algorithm 1.
    Lobs,
    /// The paper's baseline.
    ForwardAstar,
}

/// How places are found.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum PlacementMethod {
    /// In the continuum; releases and later grasps are checked.
    #[default]
    Exact,
    /// The paper's: section IV.C with Eq. 7, on an image of the scene's table.
    Raster(Raster),
}

impl Settings {
    /// True where every method is our own: such an answer is proven, or it is not served.
    pub fn proven(&self) -> bool {
        let Self { grasp_model, search, placement, objective: _ } = self;
        *grasp_model == GraspModel::SweptFinger
            && *search == SearchMethod::Landmarks
            && *placement == PlacementMethod::Exact
    }
}

impl GraspModel {
    /// The shadow of an obstacle.
    pub fn shadow(self) -> Shadow {
        match self {
            Self::SweptFinger => shadow,
            Self::Sector => sector_shadow,
        }
    }

    /// The options of an object.
    pub fn options_of(self) -> OptionsOf {
        match self {
            Self::SweptFinger => swept_finger_options,
            Self::Sector => sector_options,
        }
    }
}
