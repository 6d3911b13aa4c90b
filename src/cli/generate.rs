//! `singulate generate`.

use clap::Args;

use super::{Failure, terminal};
use crate::experiments::{self, Crowding, Recipe};
use crate::wire::SceneBody;
use singulate_planner::scene::{GripperDraft, Scene, SceneLimits};

/// The arguments of `generate`. The defaults are the paper's gripper and table.
#[derive(Debug, Args)]
pub(super) struct Generate {
    /// Number of objects, the target included
    #[arg(long, default_value_t = 16)]
    objects: usize,
    /// Width and height of the table, m
    #[arg(long, num_args = 2, value_names = ["W", "H"], default_values_t = [1.2, 0.7])]
    table: Vec<f64>,
    /// The table's lower left corner, m
    #[arg(long, num_args = 2, value_names = ["X", "Y"], default_values_t = [0.0, 0.0], allow_negative_numbers = true)]
    origin: Vec<f64>,
    /// The radius of every object, or the least and the greatest one, m
    #[arg(long, value_name = "R[..R2]", default_value = "0.075", value_parser = radius)]
    radius: (f64, f64),
    /// The same seed gives the same bytes, on any machine
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Fingers of the gripper, 2 to 12
    #[arg(long, value_name = "K", default_value_t = 3.0)]
    fingers: f64,
    /// Width of a finger, m
    #[arg(long, value_name = "W", default_value_t = 0.02)]
    finger_width: f64,
    /// How far beyond the object's edge an open finger reaches, m
    #[arg(long, value_name = "C", default_value_t = 0.05)]
    clearance: f64,
    /// Extra gap round fingers and new places, m
    #[arg(long, default_value_t = 0.0)]
    margin: f64,
    /// Probability that an object other than the target is fixed, 0 to 1
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    fixed_share: f64,
    /// One dense cluster instead of objects anywhere
    #[arg(long)]
    pressed: bool,
}

/// `0.075` or `0.05..0.1`.
fn radius(text: &str) -> Result<(f64, f64), String> {
    let number = |text: &str| text.parse().map_err(|_| format!("'{text}' is not a number"));
    match text.split_once("..") {
        Some((least, greatest)) => Ok((number(least)?, number(greatest)?)),
        None => number(text).map(|radius| (radius, radius)),
    }
}

impl Generate {
    pub(super) fn run(self) -> Result<(), Failure> {
        let refused = |detail: String| Failure::Refused(detail);
        let draft =
            experiments::generate(&self.recipe(), self.seed).map_err(|error| refused(format!("no scene: {error}")))?;
        // Limits other than the scene's size are checked by the reader of the scene.
        let limits = SceneLimits { max_objects: usize::MAX, max_neighbours: usize::MAX - 2, ..SceneLimits::default() };
        let (scene, _) = Scene::new(draft, &limits).map_err(|_| refused("no scene".to_owned()))?;
        terminal::print_json(&SceneBody::new(&scene, None))
    }

    fn recipe(&self) -> Recipe {
        let gripper = GripperDraft {
            fingers: Some(self.fingers),
            finger_width: Some(self.finger_width),
            clearance: Some(self.clearance),
            margin: Some(self.margin),
            yaw_tolerance: Some(0.0),
            ..GripperDraft::default()
        };
        Recipe {
            objects: self.objects,
            table: (self.table[0], self.table[1]),
            origin: (self.origin[0], self.origin[1]),
            radius: self.radius,
            gripper,
            fixed_share: self.fixed_share,
            arrangement: if self.pressed { Crowding::Pressed } else { Crowding::Loose },
            ..Recipe::default()
        }
    }
}
