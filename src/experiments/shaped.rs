//! Shapes, grasps and heights for a generated scene of discs.

use core::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::Point2;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::recipe::{between, whole_micrometres};
use super::varied::{chance, whole};
use super::wanting::wanting;
use singulate_planner::scene::{
    Footprint, GraspDraft, GripperDraft, ObjectDraft, Pose, SceneDraft, ShapeDraft, distance,
};

/// How much larger than within its disc a shape may become, where its neighbours leave room for that.
const GROWTH: [f64; 3] = [1.6, 1.4, 1.2];
/// Two shapes stand at least so far apart, m.
const APART: f64 = 2e-6;

/// The same scene with a shape of some kind in place of each disc, some of them discs as before. Each is turned at random and
/// grows beyond its disc where there is room. Shapes that no hand grasps by default get two grasps, as from a detector.
pub fn shaped(draft: &SceneDraft, seed: u64) -> SceneDraft {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    // Another stream than those of the other generators.
    random.set_stream(3);
    let mut draft = draft.clone();
    let mut standing: Vec<Option<Footprint>> = draft.objects.iter().map(footprint).collect();
    for at in 0..draft.objects.len() {
        let object = shaped_object(&draft.objects[at], draft.gripper, &mut random);
        let grown =
            GROWTH.iter().map(|growth| scaled(&object, *growth)).find(|grown| fits(&draft, grown, at, &standing));
        let object = grown.unwrap_or(object);
        standing[at] = footprint(&object);
        draft.objects[at] = object;
    }
    draft
}

/// A random scene of shapes of every kind, for tests: 2 to 4 fingers; heights and a palm; goals, drop-offs, openings.
pub fn mixed(draft: &SceneDraft, seed: u64) -> SceneDraft {
    let mut draft = draft.clone();
    let fingers = draft.gripper.fingers.unwrap_or(2.0);
    draft.gripper.fingers = Some(2.0 + fingers % 3.0);
    let mut draft = shaped(&draft, seed);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(4);
    if chance(&mut random, 0.5) {
        draft.gripper = with_palm(draft.gripper, &mut random);
    }
    if chance(&mut random, 0.7) {
        for object in &mut draft.objects {
            let height = whole_micrometres(between(&mut random, (0.01, 0.25)));
            object.height = chance(&mut random, 0.8).then_some(height);
        }
    }
    wanting(&draft, seed)
}

fn with_palm(gripper: GripperDraft, random: &mut ChaCha8Rng) -> GripperDraft {
    let mut length = |least, greatest| Some(whole_micrometres(between(random, (least, greatest))));
    let (finger_length, palm_radius) = (length(0.03, 0.15), length(0.03, 0.08));
    let tip_height = if chance(random, 0.5) { Some(0.005) } else { None };
    GripperDraft { finger_length, palm_radius, tip_height, ..gripper }
}

fn shaped_object(disc: &ObjectDraft, gripper: GripperDraft, random: &mut ChaCha8Rng) -> ObjectDraft {
    let radius = disc.shape.disc_radius().unwrap_or_default();
    let shape = match whole(random, 0, 4) {
        // Every third disc as a detector sees it: only in the ways that it proposes.
        0 if chance(random, 0.3) => {
            return ObjectDraft { grasps: Some(detected(radius, random)), ..disc.clone() };
        }
        0 => return disc.clone(),
        1 | 2 => rectangle(radius, random),
        3 => capsule(radius, random),
        _ => polygon(radius, random),
    };
    let yaw = Some(whole_micrometres(between(random, (0.0, TAU))));
    let grasps = (!graspable_by_default(&shape, gripper)).then(|| detected(radius, random));
    ObjectDraft { shape, yaw, grasps, ..disc.clone() }
}

fn rectangle(radius: f64, random: &mut ChaCha8Rng) -> ShapeDraft {
    let ratio = between(random, (0.3, 1.0));
    let length = 2.0 * radius / (1.0 + ratio * ratio).sqrt();
    let corner_radius = chance(random, 0.3).then(|| whole_micrometres(0.2 * ratio * length));
    let side = |length: f64| Some(whole_micrometres(length - 1e-6));
    ShapeDraft::Rectangle { length: side(length), width: side(ratio * length), corner_radius }
}

fn capsule(radius: f64, random: &mut ChaCha8Rng) -> ShapeDraft {
    let thin = whole_micrometres(radius * between(random, (0.15, 0.5)));
    ShapeDraft::Capsule { length: Some(whole_micrometres(2.0 * radius - 2e-6)), radius: Some(thin) }
}

/// A hexagon with parallel sides, or some corners on the circle.
fn polygon(radius: f64, random: &mut ChaCha8Rng) -> ShapeDraft {
    let corner_radius = chance(random, 0.3).then(|| whole_micrometres(0.1 * radius));
    let radius = radius - corner_radius.unwrap_or_default() - 1e-6;
    let corners = if chance(random, 0.5) { 6 } else { whole(random, 3, 7) };
    let regular = corners == 6;
    let point = |n: u32| {
        let step = TAU / f64::from(corners);
        let off = if regular { 0.0 } else { between(random, (-0.3, 0.3)) * step };
        let angle = step * f64::from(n) + off;
        [libm::cos(angle), libm::sin(angle)].map(|share| Some(whole_micrometres(radius * share)))
    };
    let mut points: Vec<[Option<f64>; 2]> = (0..corners).map(point).collect();
    if chance(random, 0.2) {
        // A notch, which the hull covers.
        points.insert(1, [Some(0.0), Some(0.0)]);
    }
    ShapeDraft::Polygon { points, corner_radius }
}

fn graspable_by_default(shape: &ShapeDraft, gripper: GripperDraft) -> bool {
    match shape {
        ShapeDraft::Rectangle { .. } => gripper.fingers == Some(2.0) || gripper.fingers == Some(4.0),
        ShapeDraft::Capsule { .. } => gripper.fingers == Some(2.0),
        ShapeDraft::Polygon { points, .. } => gripper.fingers == Some(2.0) && points.len() == 6,
        _ => true,
    }
}

/// Two grasps beside the middle of an object of so great a radius.
fn detected(radius: f64, random: &mut ChaCha8Rng) -> Vec<GraspDraft> {
    let first = whole_micrometres(between(random, (0.0, FRAC_PI_2)));
    let mut grasp = |yaw: f64| {
        let mut aside = || Some(whole_micrometres(0.3 * radius * between(random, (-1.0, 1.0))));
        let (x, y) = (aside(), aside());
        GraspDraft { x, y, yaw: Some(yaw), tolerance: Some(whole_micrometres(between(random, (0.0, 0.1)))) }
    };
    vec![grasp(first), grasp(first + 0.5)]
}

fn scaled(object: &ObjectDraft, factor: f64) -> ObjectDraft {
    let times = |length: Option<f64>| length.map(|length| whole_micrometres(factor * length));
    let shape = match &object.shape {
        ShapeDraft::Capsule { length, radius } => {
            ShapeDraft::Capsule { length: times(*length), radius: times(*radius) }
        }
        ShapeDraft::Rectangle { length, width, corner_radius } => {
            ShapeDraft::Rectangle { length: times(*length), width: times(*width), corner_radius: *corner_radius }
        }
        ShapeDraft::Polygon { points, corner_radius } => ShapeDraft::Polygon {
            points: points.iter().map(|point| point.map(times)).collect(),
            corner_radius: *corner_radius,
        },
        disc => disc.clone(),
    };
    ObjectDraft { shape, ..object.clone() }
}

/// Where the object stands; `None` for a shape that is not sound.
fn footprint(object: &ObjectDraft) -> Option<Footprint> {
    let pose = Pose { at: Point2::new(object.x?, object.y?), yaw: object.yaw.unwrap_or_default() };
    Some(Footprint::new(object.shape.shape()?, pose))
}

/// True if the object stands on the table and clear of all others.
fn fits(draft: &SceneDraft, object: &ObjectDraft, at: usize, standing: &[Option<Footprint>]) -> bool {
    let Some(own) = footprint(object).filter(|own| on_table(draft, own)) else { return false };
    let others = standing.iter().enumerate().filter(|(other, _)| *other != at).filter_map(|(_, other)| other.as_ref());
    let near = |other: &&Footprint| distance(own.at(), other.at()) < own.circumradius() + other.circumradius() + APART;
    others.filter(near).all(|other| own.gap(other) >= APART)
}

fn on_table(draft: &SceneDraft, own: &Footprint) -> bool {
    let [min, max] = own.bounding_box();
    let top = draft.table.top;
    let within = |value: f64, least: Option<f64>, greatest: Option<f64>| {
        least.is_some_and(|least| least <= value) && greatest.is_some_and(|greatest| value <= greatest)
    };
    [min, max].iter().all(|p| within(p.x, top.x_min, top.x_max) && within(p.y, top.y_min, top.y_max))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::varied;
    use crate::experiments::wanting::tests::kind;
    use singulate_planner::scene::{Grasps, Scene, SceneLimits};

    #[test]
    fn shapes_stand_apart_and_on_the_table() {
        for seed in 0..60 {
            let draft = shaped(&varied(seed), seed);
            let footprints: Vec<Footprint> = draft.objects.iter().filter_map(footprint).collect();
            assert_eq!(footprints.len(), draft.objects.len(), "{seed}");
            for (at, one) in footprints.iter().enumerate() {
                assert!(footprints[..at].iter().all(|other| one.gap(other) >= 0.0), "{seed} {at}");
                assert!(on_table(&draft, one), "{seed} {at}");
            }
        }
    }

    #[test]
    fn mixed_scenes_hold_and_are_of_every_kind() {
        let (mut listed, mut palms, mut tall, mut goals) = (0, 0, 0, [0; 4]);
        for seed in 0..300 {
            let draft = mixed(&varied(seed), seed);
            let Ok((scene, _)) = Scene::new(draft, &SceneLimits::default()) else { continue };
            goals[kind(scene.goal())] += 1;
            listed += scene.objects().iter().filter(|o| matches!(o.grasps(), Grasps::Listed(_))).count();
            palms += usize::from(scene.gripper().palm().is_some());
            tall += scene.objects().iter().filter(|object| object.height().is_some()).count();
        }
        assert!(
            goals.iter().all(|count| *count > 40) && palms > 80 && tall > 1000 && listed > 2000,
            "{goals:?} {palms} {tall} {listed}"
        );
    }
}
