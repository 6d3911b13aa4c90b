//! Checks of objects against each other, the table's edge and the fingers.

use std::collections::HashMap;

use nalgebra::Point2;

use super::fault::{Findings, Place};
use super::flaw::Flaw;
use super::likely::Likely;
use super::slips;
use super::{Footprint, FootprintIndex, Gripper, Object, ObjectIndex, Rectangle, SceneLimits};

/// Depths that differ by no more count as equal, m: half a micrometre, since overlaps are reported to the micrometre.
/// So objects that touch, or overlap by exactly the tolerance in decimals, are judged as written. Rounding to doubles
/// changes a depth by at most 3e-11 m (four coordinates at 100 km).
const TOUCHING: f64 = 5e-7;

/// An object may hang over the table's edge by this share of its radius without a warning: perception errs, and plates do
/// stand like that. Past it, a wrong position or size is likelier.
const OVERHANG: f64 = 1.0 / 3.0;

/// Warns of objects that hang over the table's edge; their centres are on it.
pub(super) fn overhangs(top: Rectangle, objects: &[Object], warnings: &mut Findings) {
    for (at, Object { footprint, .. }) in objects.iter().enumerate() {
        let (overhang, radius) = (-footprint.gap_inside(&top), footprint.circumradius());
        if overhang > OVERHANG * radius + TOUCHING {
            warnings.add(Place::WholeObject(at), Flaw::HangsOverTable { overhang, radius });
        }
    }
}

/// Reports every overlapping pair once, at the later object: as a fault past the tolerance, as a warning up to it.
/// Fixed objects may overlap each other, since several discs may make up one thing. A movable object that overlaps more
/// objects than a grasp may have neighbours is refused for that, which bounds the work.
pub(super) fn overlaps(
    objects: &[Object],
    index: &FootprintIndex,
    limits: &SceneLimits,
    faults: &mut Findings,
    warnings: &mut Findings,
) {
    let max = limits.max_neighbours;
    // Per fixed object the earlier movable objects that it overlaps.
    let mut earlier: HashMap<ObjectIndex, Vec<ObjectIndex>> = HashMap::new();
    for (at, object) in objects.iter().enumerate() {
        let this = ObjectIndex::new(at);
        let touched = if object.fixed {
            Some(earlier.remove(&this).unwrap_or_default())
        } else {
            touching(index, &object.footprint, max)
        };
        // The index finds the object itself too.
        let too_many = touched.as_ref().is_none_or(|touched| touched.len() > max + 1);
        let mut touched = touched.unwrap_or_default();
        if too_many && !object.fixed {
            faults.add(Place::WholeObject(at), Flaw::TooManyNeighbours { id: object.id.clone(), max });
        }
        for &later in touched.iter().filter(|other| **other > this && objects[other.get()].fixed) {
            earlier.entry(later).or_default().push(this);
        }
        touched.retain(|other| *other < this);
        touched.sort_unstable();
        for other in touched {
            overlap(at, &objects[other.get()], object, limits.overlap_tolerance, faults, warnings);
        }
        if faults.full() {
            return;
        }
    }
}

/// The first objects that may overlap with a footprint, itself among them, one more than may be. `None` if more come near than are
/// worth looking at: a long object has many near that it does not touch.
fn touching(index: &FootprintIndex, footprint: &Footprint, max: usize) -> Option<Vec<ObjectIndex>> {
    let looks = max.saturating_add(2).saturating_mul(4);
    let (mut looked, mut touched) = (0, Vec::new());
    for (object, other) in index.within(footprint.at(), footprint.circumradius()) {
        // A disc that comes so near to a disc overlaps with it.
        let discs = footprint.core().is_none() && other.core().is_none();
        if discs || !footprint.keeps_from(other, 0.0) {
            touched.push(object);
        }
        looked += 1;
        if touched.len() > max.saturating_add(1) {
            break;
        }
        if looked > looks {
            return None;
        }
    }
    Some(touched)
}

/// Reports the overlap of the object at `at` with an earlier one.
fn overlap(
    at: usize,
    earlier: &Object,
    object: &Object,
    tolerance: f64,
    faults: &mut Findings,
    warnings: &mut Findings,
) {
    let depth = -object.footprint.gap(&earlier.footprint);
    if depth <= TOUCHING {
        return;
    }
    let (list, likely) = match depth > tolerance + TOUCHING {
        true => (faults, slips::overlap(&object.footprint, &earlier.footprint, depth)),
        false => (warnings, Likely::Open),
    };
    list.add(Place::WholeObject(at), Flaw::Overlap { other: earlier.id.clone(), depth, tolerance, likely });
}

/// Reports grasps with too many obstacles in reach, and warns of fingers that overlap each other.
pub(super) fn reach(
    gripper: &Gripper,
    objects: &[Object],
    index: &FootprintIndex,
    limits: &SceneLimits,
    faults: &mut Findings,
    warnings: &mut Findings,
) {
    let half_angle_tangent = libm::tan(gripper.period() / 2.0);
    for (at, object) in objects.iter().enumerate().filter(|(_, object)| object.can_be_grasped()) {
        let id = || object.id.clone();
        let reach = object.reach(gripper);
        // The index finds the object itself too.
        let crowd = |centre: Point2<f64>, reach: f64| {
            index.within(centre, reach).take(limits.max_neighbours + 2).count() > limits.max_neighbours + 1
        };
        if crowd(object.footprint.at(), reach) && object.hands(gripper).any(|(axis, reach)| crowd(axis, reach)) {
            faults.add(Place::WholeObject(at), Flaw::TooManyNeighbours { id: id(), max: limits.max_neighbours });
        }
        // Two jaws face each other: they have no sides to overlap with.
        let radius = if gripper.fingers > 2 { object.closest_finger() } else { f64::INFINITY };
        if gripper.finger_width / 2.0 > radius * half_angle_tangent {
            let flaw = Flaw::FingersOverlap { id: id(), finger_width: gripper.finger_width, radius };
            warnings.add(Place::WholeObject(at), flaw);
        }
        if faults.full() {
            return;
        }
    }
}
