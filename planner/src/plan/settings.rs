//! The caller's settings.

use crate::geometry::{Shadow, shadow};
use crate::knowledge::{OptionsOf, swept_finger_options};
use crate::paper::{Raster, sector_options, sector_shadow};
use crate::placement::Objective;

/// The settings of a plan.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Settings {
    /// The yaws that an obstacle blocks.
    pub grasp_model: GraspModel,
    /// The method that finds the relocations.
    pub search: SearchMethod,
    /// The method that finds places.
    pub placement: PlacementMethod,
    /// The preferred places.
    pub objective: Objective,
}

/// The yaws that an obstacle blocks.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum GraspModel {
    /// Exactly the yaws at which a finger meets it.
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
    /// True if every method is our own: such answers are proven or not served.
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
