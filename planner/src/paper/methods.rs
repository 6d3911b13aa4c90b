//! The methods that a request names.

use super::raster::Raster;
use super::sector::Sector;
use crate::knowledge::{GraspModel, SweptFinger};

/// The methods that an answer is made with; ours where nothing else is asked for.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Methods {
    /// The yaws that an obstacle blocks.
    pub grasp_model: GraspModelName,
    /// The method that finds the relocations.
    pub search: SearchMethod,
    /// The method that finds places.
    pub placement: PlacementMethod,
}

/// The yaws that an obstacle blocks.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum GraspModelName {
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

impl Methods {
    /// True if every method is our own: such answers are proven or not served.
    pub fn proven(&self) -> bool {
        let Self { grasp_model, search, placement } = self;
        *grasp_model == GraspModelName::SweptFinger
            && *search == SearchMethod::Landmarks
            && *placement == PlacementMethod::Exact
    }

    /// The setting that explains an unproven deadlock.
    pub(super) fn unproven_by(&self) -> &'static str {
        if self.grasp_model == GraspModelName::Sector { "grasp_model" } else { "search" }
    }
}

impl GraspModelName {
    /// The model of this name.
    pub fn model(self) -> &'static dyn GraspModel {
        match self {
            Self::SweptFinger => &SweptFinger,
            Self::Sector => &Sector,
        }
    }
}
