//! What `client-examples/robot-cell/run COMMAND --out` writes: lengths in metres, times in seconds.

use std::collections::BTreeMap;

use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer};
use serde_json::value::RawValue;

use crate::noise::Noise;

/// The files of all experiments with a robot.
pub(crate) struct Robot {
    pub(crate) table3: Table3,
    pub(crate) relocations: Tallied<Relocations>,
    pub(crate) tolerance: Tolerance,
    pub(crate) noise: Noise,
    pub(crate) controller: Controller,
    pub(crate) hand: Hand,
    pub(crate) palm: Palm,
}

/// What many episodes come to.
#[derive(Deserialize)]
pub(crate) struct Tally {
    pub(crate) episodes: u32,
    /// How many ended how.
    pub(crate) ends: BTreeMap<String, u32>,
    /// All but those that ended in a deadlock, without space or out of reach with nothing hit or dropped before.
    pub(crate) judged: u32,
    pub(crate) success: u32,
    pub(crate) clean: u32,
    /// Judged episodes in which something was hit or dropped.
    pub(crate) harmed: u32,
    /// Episodes in which a closing hand pressed its dish against another one.
    pub(crate) pressed: u32,
    pub(crate) relocations: u32,
    /// Those of relocations and those of targets.
    pub(crate) grasps: u32,
    /// Steps with a contact, by phase and by what met what.
    pub(crate) contacts: BTreeMap<String, BTreeMap<String, u32>>,
    pub(crate) disturbances: u32,
    pub(crate) drops: u32,
    pub(crate) place_error_mean: Option<f64>,
    pub(crate) place_error_max: Option<f64>,
    /// Pictures of the camera, those of refused scenes included.
    pub(crate) pictures: u32,
    pub(crate) plans: u32,
    pub(crate) verifications: u32,
}

/// A tally with what it is of, both in one JSON object.
pub(crate) struct Tallied<T> {
    pub(crate) of: T,
    pub(crate) tally: Tally,
}

impl<'de, T: DeserializeOwned> Deserialize<'de> for Tallied<T> {
    /// Not by serde's `flatten`, which can't read numbers where serde_json keeps them as they are written.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = <Box<RawValue>>::deserialize(deserializer)?;
        let of = serde_json::from_str(text.get()).map_err(D::Error::custom)?;
        let tally = serde_json::from_str(text.get()).map_err(D::Error::custom)?;
        Ok(Self { of, tally })
    }
}

/// Of what the figures depend on.
#[derive(Deserialize)]
pub(crate) struct Versions {
    pub(crate) mujoco: String,
    pub(crate) ompl: String,
}

/// Table III.
#[derive(Deserialize)]
pub(crate) struct Table3 {
    pub(crate) command: String,
    pub(crate) versions: Versions,
    /// What carries the hand: `arm` or `gantry`.
    pub(crate) mechanism: String,
    /// Of each column.
    pub(crate) episodes: u32,
    pub(crate) columns: Vec<Tallied<Column3>>,
}

/// A column of Table III by some methods.
#[derive(Deserialize)]
pub(crate) struct Column3 {
    pub(crate) objects: u32,
    /// `ours` or `paper`.
    pub(crate) method: String,
    pub(crate) deadlocks_passed_over: u32,
    /// Of an episode, as the client waits for it.
    pub(crate) planning_s_mean: Option<f64>,
    /// Of an episode, as the service counts it.
    pub(crate) service_s_mean: Option<f64>,
    pub(crate) execution_s_mean: Option<f64>,
    pub(crate) faulty_plans: u32,
    pub(crate) paper: Paper3,
}

/// What the paper prints.
#[derive(Deserialize)]
pub(crate) struct Paper3 {
    pub(crate) success: f64,
    pub(crate) planning_s: f64,
    pub(crate) execution_s: f64,
}

/// Relocations on exact data.
#[derive(Deserialize)]
pub(crate) struct Relocations {
    pub(crate) command: String,
    pub(crate) by_kind: BTreeMap<String, Tally>,
}

/// What the simulator reports where nothing touches.
#[derive(Deserialize)]
pub(crate) struct Tolerance {
    pub(crate) command: String,
    pub(crate) kinds: BTreeMap<String, Apart>,
    /// The depth from which a contact counts.
    pub(crate) judged_from: f64,
}

/// Pairs that touch nothing.
#[derive(Deserialize)]
pub(crate) struct Apart {
    pub(crate) pairs: u32,
    /// Those of them that are said to overlap, and the greatest depth.
    pub(crate) reported: u32,
    pub(crate) deepest: f64,
}

/// The controller with and without asking whether its plan still holds.
#[derive(Deserialize)]
pub(crate) struct Controller {
    pub(crate) command: String,
    pub(crate) objects: u32,
    pub(crate) episodes: u32,
    /// Of the camera.
    pub(crate) sigma: f64,
    pub(crate) margin: f64,
    pub(crate) plans_only: Tally,
    pub(crate) asks_first: Tally,
}

/// What a hand makes of an error.
#[derive(Deserialize)]
pub(crate) struct Hand {
    pub(crate) command: String,
    /// Of each hand and offset.
    pub(crate) grasps: u32,
    pub(crate) rows: Vec<Grasps>,
}

/// Grasps with one hand and one offset.
#[derive(Deserialize)]
pub(crate) struct Grasps {
    pub(crate) hand: String,
    /// Between where the dish stands and where it was seen.
    pub(crate) offset: f64,
    /// Between where it was to be and where it is in the end.
    pub(crate) mean: f64,
    pub(crate) worst: f64,
}

/// Palms over neighbours of different heights.
#[derive(Deserialize)]
pub(crate) struct Palm {
    pub(crate) command: String,
    /// The lowest dish and the tallest one, m.
    pub(crate) heights: [f64; 2],
    pub(crate) rows: Vec<Fingers>,
}

/// What fingers of one length came to.
#[derive(Deserialize)]
pub(crate) struct Fingers {
    pub(crate) finger_length: f64,
    pub(crate) steps: u32,
    /// Steps in which the palm meets a neighbour.
    pub(crate) palm_meets: u32,
}

impl Robot {
    /// Each file's name and the command that writes it.
    pub(crate) fn commands(&self) -> [(&str, &str); 7] {
        [
            ("table3", &self.table3.command),
            ("relocations", &self.relocations.of.command),
            ("tolerance", &self.tolerance.command),
            ("noise", &self.noise.command),
            ("controller", &self.controller.command),
            ("hand", &self.hand.command),
            ("palm", &self.palm.command),
        ]
    }
}

impl Tally {
    /// How many episodes ended so.
    pub(crate) fn end(&self, name: &str) -> u32 {
        self.ends.get(name).copied().unwrap_or_default()
    }

    /// Steps with this contact.
    pub(crate) fn contact(&self, phase: &str, what: &str) -> u32 {
        self.contacts.get(phase).and_then(|of_phase| of_phase.get(what)).copied().unwrap_or_default()
    }
}
