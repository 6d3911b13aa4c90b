//! `singulate generate`.

use clap::{Args, ValueEnum};

use super::{Failure, terminal};
use crate::experiments::{self, Crowding, GenerateError, Recipe, Wanted};
use crate::wire::SceneBody;
use singulate_planner::scene::{Destination, DropOffDraft, GripperDraft, Opening, Scene, SceneLimits};

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
    /// The distance between the inner faces of two open jaws, m; a wider object can't be grasped
    #[arg(long, value_name = "M")]
    max_opening: Option<f64>,
    /// How far the fingers open: to the clearance beyond the object's edge, or all the way
    #[arg(long, value_enum, default_value_t, requires_if("full", "max_opening"))]
    opening: OpeningWord,
    /// A drop-off, with the number of objects that it takes; may be given several times
    #[arg(long = "drop-off", value_name = "ID[:CAPACITY]", value_parser = drop_off)]
    drop_offs: Vec<DropOffDraft>,
    /// Where objects go that have to move
    #[arg(long, value_enum, requires = "drop_offs")]
    destination: Option<DestinationWord>,
    /// Wanted is any of the N most crowded objects, in place of the most crowded one
    #[arg(long, value_name = "N", group = "goal")]
    any_of: Option<usize>,
    /// The N most crowded objects are all to be taken away
    #[arg(long, value_name = "N", group = "goal", requires = "drop_offs")]
    all_of: Option<usize>,
    /// All objects are to be taken away
    #[arg(long, group = "goal", requires = "drop_offs")]
    clear: bool,
    /// Probability that an object that is not wanted is fixed, 0 to 1
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    fixed_share: f64,
    /// One dense cluster instead of objects anywhere
    #[arg(long)]
    pressed: bool,
    /// Rectangles, capsules and polygons among the discs
    #[arg(long)]
    shapes: bool,
}

/// `0.075` or `0.05..0.1`.
fn radius(text: &str) -> Result<(f64, f64), String> {
    let number = |text: &str| text.parse().map_err(|_| format!("'{text}' is not a number"));
    match text.split_once("..") {
        Some((least, greatest)) => Ok((number(least)?, number(greatest)?)),
        None => number(text).map(|radius| (radius, radius)),
    }
}

/// `tray` or `tray:4`.
fn drop_off(text: &str) -> Result<DropOffDraft, String> {
    let (id, capacity) = match text.rsplit_once(':') {
        Some((id, count)) => {
            let capacity: u32 = count.parse().map_err(|_| format!("'{count}' is no number of objects"))?;
            (id, Some(f64::from(capacity)))
        }
        None => (text, None),
    };
    Ok(DropOffDraft { id: Some(id.to_owned()), capacity, accepts: None })
}

/// The words of the field `opening`.
#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum OpeningWord {
    #[default]
    Fit,
    Full,
}

/// The words of the field `destination`.
#[derive(Debug, Clone, Copy, ValueEnum)]
#[value(rename_all = "snake_case")]
enum DestinationWord {
    Table,
    DropOff,
    TableThenDropOff,
}

impl From<DestinationWord> for Destination {
    fn from(word: DestinationWord) -> Self {
        match word {
            DestinationWord::Table => Self::Table,
            DestinationWord::DropOff => Self::DropOff,
            DestinationWord::TableThenDropOff => Self::TableThenDropOff,
        }
    }
}

impl Generate {
    pub(super) fn run(self) -> Result<(), Failure> {
        let refused = |error: GenerateError| Failure::Refused(format!("no scene: {error}"));
        let draft = experiments::generate(&self.recipe(), self.seed).map_err(refused)?;
        let draft = if self.shapes { experiments::shaped(&draft, self.seed) } else { draft };
        // Limits other than the scene's size are checked by the reader of the scene.
        let limits = SceneLimits { max_objects: usize::MAX, max_neighbours: usize::MAX - 2, ..SceneLimits::default() };
        let (scene, _) = Scene::new(draft, &limits).map_err(|faults| refused(GenerateError::Scene(faults)))?;
        terminal::print_json(&SceneBody::new(&scene, None))
    }

    fn recipe(&self) -> Recipe {
        let gripper = GripperDraft {
            fingers: Some(self.fingers),
            finger_width: Some(self.finger_width),
            clearance: Some(self.clearance),
            margin: Some(self.margin),
            yaw_tolerance: Some(0.0),
            max_opening: self.max_opening,
            opening: Some(match self.opening {
                OpeningWord::Fit => Opening::Fit,
                OpeningWord::Full => Opening::Full,
            }),
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
            wanted: self.wanted(),
            drop_offs: self.drop_offs.clone(),
            destination: self.destination.map(Destination::from),
            ..Recipe::default()
        }
    }

    fn wanted(&self) -> Wanted {
        match (self.any_of, self.all_of) {
            (Some(count), _) => Wanted::AnyOf(count),
            (_, Some(count)) => Wanted::AllOf(count),
            _ if self.clear => Wanted::Clear,
            _ => Wanted::Target,
        }
    }
}
