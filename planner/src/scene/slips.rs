//! Warnings of slips of unit: degrees instead of radians, millimetres instead of metres. Such a scene is valid, but its
//! answer is mostly a deadlock that does not exist on the real table.
//!
//! Millimetres and metres differ by a factor of 1000. Each threshold lies between real scenes and slips, nearer to the
//! slips: a wrong warning is worse than a missing one.

use core::f64::consts::PI;

use nalgebra::Point2;

use super::fault::{Findings, Place};
use super::flaw::Flaw;
use super::likely::{Likely, Yardstick};
use super::{Footprint, Gripper, Object, Rectangle};

/// The threshold of a length in largest radii, if it is also at least [`LONG`].
const LONG_TO_RADIUS: f64 = 3.0;
/// See [`LONG_TO_RADIUS`], m: no gripper has fingers or errors of half a metre for things so much smaller.
const LONG: f64 = 0.5;
/// The threshold of a margin in largest radii. Margins cover errors of perception and robot, some millimetres; with
/// errors beyond the objects' size no grasp succeeds.
const MARGIN_TO_RADIUS: f64 = 10.0;
/// The threshold of a margin as a share of the table's shorter side.
const MARGIN_TO_TABLE: f64 = 0.5;
/// The threshold of a clearance or finger width in largest radii. A gripper with 60 mm of clearance may pick up pills
/// of 4 mm, which is 15 times.
const FINGER_TO_RADIUS: f64 = 50.0;
/// The threshold of a clearance or finger width in longer sides of the table: a gripper may be larger than a tray.
const FINGER_TO_TABLE: f64 = 3.0;
/// The lower threshold of a clearance or finger width in smallest radii, if that radius is at least [`HUGE_RADIUS`].
const FINGER_IN_RADIUS: f64 = 1.0 / 30.0;
/// See [`FINGER_IN_RADIUS`], m. Thin fingers for large platters are not rare, but no gripper spans discs two metres
/// wide.
const HUGE_RADIUS: f64 = 1.0;
/// The threshold of the table's shorter side in largest radii, if it is also at least [`HUGE_TABLE`].
const TABLE_TO_RADIUS: f64 = 1000.0;
/// See [`TABLE_TO_RADIUS`], m: no robot reaches over that.
const HUGE_TABLE: f64 = 100.0;
/// The distance of a centre from the table, in longer sides of the table, from which on the frame or the unit is wrong.
const FAR_OFF: f64 = 10.0;
/// The depth from which on an overlap may be a slip of unit, m: few things on a table are as wide.
const HUGE_OVERLAP: f64 = 1.0;

/// Warns of each slip.
pub(super) fn slips(top: Rectangle, gripper: &Gripper, objects: &[Object], warnings: &mut Findings) {
    let (tolerance, fingers) = (gripper.yaw_tolerance, gripper.fingers);
    if tolerance >= PI / f64::from(fingers) {
        warnings.add(Place::Gripper("yaw_tolerance"), Flaw::WideYawTolerance { tolerance, fingers });
    }
    if objects.is_empty() {
        // A cleared table has nothing to compare with.
        return;
    }
    let scale = Scale::new(top, objects);
    // A hand is as large as what it spans: half of its opening compares with a radius.
    let half_opening = gripper.max_opening.unwrap_or_default() / 2.0;
    let lengths = [
        (Place::Gripper("finger_width"), gripper.finger_width, scale.finger(gripper.finger_width)),
        (Place::Gripper("clearance"), gripper.clearance, scale.finger(gripper.clearance)),
        (Place::Gripper("max_opening"), 2.0 * half_opening, scale.opening(half_opening)),
        (Place::Gripper("margin"), gripper.margin, scale.margin(gripper.margin)),
        (Place::WholeTable, scale.shorter(), scale.table()),
    ];
    let palm = gripper.palm.map(|palm| {
        [("finger_length", palm.finger_length), ("palm_radius", palm.radius)]
            .map(|(name, length)| (Place::Gripper(name), length, scale.high(length)))
    });
    let tips = (Place::Gripper("tip_height"), gripper.tip_height, scale.high(gripper.tip_height));
    let heights = objects.iter().enumerate().filter_map(|(at, object)| Some((at, object.height?)));
    let heights = heights.map(|(at, height)| (Place::Object(at, "height"), height, scale.high(height)));
    let lengths = lengths.into_iter().chain(palm.into_iter().flatten()).chain([tips]).chain(heights);
    for (place, length, yardstick) in lengths {
        if let Some(yardstick) = yardstick {
            warnings.add(place, Flaw::OutOfProportion { length, yardstick });
        }
    }
}

/// The lengths of a scene with which others are compared.
struct Scale {
    sides: (f64, f64),
    smallest: f64,
    largest: f64,
}

impl Scale {
    fn new(top: Rectangle, objects: &[Object]) -> Self {
        let radii = || objects.iter().map(|object| object.footprint.circumradius());
        let (smallest, largest) = (radii().fold(f64::INFINITY, f64::min), radii().fold(0.0, f64::max));
        Self { sides: top.sides(), smallest, largest }
    }

    fn shorter(&self) -> f64 {
        self.sides.0.min(self.sides.1)
    }

    fn longer(&self) -> f64 {
        self.sides.0.max(self.sides.1)
    }

    /// The length for which a margin is too long, if any.
    fn margin(&self, margin: f64) -> Option<Yardstick> {
        self.too_long(margin, MARGIN_TO_RADIUS, MARGIN_TO_TABLE * self.shorter())
    }

    /// The length for which a clearance or finger width is too long or too short, if any.
    fn finger(&self, length: f64) -> Option<Yardstick> {
        let too_short = self.smallest >= HUGE_RADIUS && length < FINGER_IN_RADIUS * self.smallest;
        let too_long = self.too_long(length, FINGER_TO_RADIUS, FINGER_TO_TABLE * self.longer());
        too_long.or(too_short.then_some(Yardstick::SmallestRadius(self.smallest)))
    }

    /// The length for which half of a greatest opening is too long, if any. One that is too short makes objects too wide, which
    /// is told of each.
    fn opening(&self, half: f64) -> Option<Yardstick> {
        self.too_long(half, FINGER_TO_RADIUS, FINGER_TO_TABLE * self.longer())
    }

    /// The length for which a height, a palm or the length of fingers is too long, if any. Bottles are high for their radius.
    fn high(&self, length: f64) -> Option<Yardstick> {
        (length > FINGER_TO_RADIUS * self.largest).then_some(Yardstick::LargestRadius(self.largest))
    }

    fn too_long(&self, length: f64, to_radius: f64, to_table: f64) -> Option<Yardstick> {
        if length > to_radius * self.largest || (length >= LONG && length > LONG_TO_RADIUS * self.largest) {
            Some(Yardstick::LargestRadius(self.largest))
        } else {
            (length > to_table).then_some(Yardstick::Table(self.sides.0, self.sides.1))
        }
    }

    /// The length for which the table is too large, if any.
    fn table(&self) -> Option<Yardstick> {
        let too_large = self.shorter() >= HUGE_TABLE && self.shorter() > TABLE_TO_RADIUS * self.largest;
        too_large.then_some(Yardstick::LargestRadius(self.largest))
    }
}

/// The likely cause of a centre beside the table.
pub(super) fn off_table(top: Rectangle, centre: Point2<f64>) -> Likely {
    let (x, y) = top.sides();
    if top.distance(centre) > FAR_OFF * x.max(y) { Likely::FrameOrUnit } else { Likely::Open }
}

/// The likely cause of an overlap past the tolerance (`depth` in m).
pub(super) fn overlap(one: &Footprint, other: &Footprint, depth: f64) -> Likely {
    if depth >= HUGE_OVERLAP {
        Likely::UnitOrSeenTwice
    } else if depth >= one.circumradius().min(other.circumradius()) {
        // The centre of one lies in the other.
        Likely::SeenTwice
    } else {
        Likely::Open
    }
}
