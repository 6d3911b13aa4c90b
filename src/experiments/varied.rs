//! Random scenes of every kind, for tests.

use nalgebra::Point2;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::generate::generate;
use super::recipe::{Crowding, GenerateError, Recipe, between, rectangle, whole_micrometres};
use singulate_planner::scene::{GripperDraft, RectangleDraft, SceneDraft};

/// A random scene: 2 to 6 fingers, 2 to 80 objects (fewer if they don't fit), equal and mixed radii, loose and pressed,
/// with and without fixed objects, margin, yaw tolerance and keep-out, the table at the origin or elsewhere.
pub fn varied(seed: u64) -> SceneDraft {
    // Another stream than the one of `generate`.
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(1);
    let mut recipe = recipe(&mut random);
    let mut draft = loop {
        match generate(&recipe, seed) {
            Ok(draft) => break draft,
            Err(GenerateError::TooFull { fitted, .. }) => recipe.objects = fitted,
            Err(error) => unreachable!("every drawn recipe is sound: {error}"),
        }
    };
    if chance(&mut random, 0.25) {
        draft.table.keep_out.push(corner(&recipe, &mut random));
    }
    draft
}

pub(super) fn chance(random: &mut ChaCha8Rng, probability: f64) -> bool {
    random.random::<f64>() < probability
}

/// A random integer from `least` to `greatest`.
pub(super) fn whole(random: &mut ChaCha8Rng, least: u32, greatest: u32) -> u32 {
    let count = greatest - least + 1;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below the count")]
    let step = (random.random::<f64>() * f64::from(count)) as u32;
    least + step
}

fn recipe(random: &mut ChaCha8Rng) -> Recipe {
    let objects = whole(random, 2, 80);
    let least = between(random, (0.015, 0.08));
    let greatest = if chance(random, 0.5) { least } else { least * between(random, (1.1, 4.0)) };
    let arrangement = if chance(random, 0.5) { Crowding::Pressed } else { Crowding::Loose };
    let gripper = gripper(random);
    let finger_width = gripper.finger_width.unwrap_or_default();
    Recipe {
        objects: objects as usize,
        table: table(random, objects, (least + greatest) / 2.0, greatest),
        origin: origin(random),
        radius: (least, greatest),
        gripper,
        fixed_share: if chance(random, 0.5) { 0.0 } else { between(random, (0.02, 0.3)) },
        arrangement,
        // In contact nearly everything locks; with gaps of a finger's width there is something to plan.
        pressed_gap: if chance(random, 0.25) { 2e-3 } else { between(random, (0.5, 3.0)) * finger_width },
        ..Recipe::default()
    }
}

/// A table of which the discs cover 15 to 50 per cent, and on which one disc always fits.
fn table(random: &mut ChaCha8Rng, objects: u32, mean_radius: f64, greatest_radius: f64) -> (f64, f64) {
    let coverage = between(random, (0.15, 0.5));
    let area = f64::from(objects) * core::f64::consts::PI * mean_radius * mean_radius / coverage;
    let ratio = between(random, (1.0, 2.5));
    let height = (area / ratio).sqrt();
    let side = |length: f64| length.max(2.5 * greatest_radius);
    (side(height * ratio), side(height))
}

fn origin(random: &mut ChaCha8Rng) -> (f64, f64) {
    match whole(random, 0, 3) {
        0 => (0.0, 0.0),
        1 => (-0.6, -0.4),
        2 => (0.35, -1.2),
        _ => (between(random, (-50.0, 50.0)), between(random, (-50.0, 50.0))),
    }
}

fn gripper(random: &mut ChaCha8Rng) -> GripperDraft {
    GripperDraft {
        fingers: Some(f64::from(whole(random, 2, 6))),
        finger_width: Some(f64::from(whole(random, 4, 20)) * 1e-3),
        clearance: Some(f64::from(whole(random, 20, 60)) * 1e-3),
        margin: Some(if chance(random, 0.75) { 0.0 } else { f64::from(whole(random, 1, 8)) * 1e-3 }),
        yaw_tolerance: Some(if chance(random, 0.75) { 0.0 } else { f64::from(whole(random, 1, 50)) * 1e-3 }),
        ..GripperDraft::default()
    }
}

/// A keep-out rectangle in the table's lower left corner.
fn corner(recipe: &Recipe, random: &mut ChaCha8Rng) -> RectangleDraft {
    let (min, max) = recipe.corners();
    let mut side = |min: f64, max: f64| whole_micrometres(min + (max - min) * between(random, (0.1, 0.4)));
    rectangle(min, Point2::new(side(min.x, max.x), side(min.y, max.y)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use singulate_planner::scene::{Scene, SceneLimits};

    #[test]
    fn varied_scenes_hold_and_are_of_every_kind() {
        let mut fingers = [0; 7];
        let (mut fixed, mut mixed, mut keep_out, mut away) = (0, 0, 0, 0);
        for seed in 0..500 {
            let (scene, _) = Scene::new(varied(seed), &SceneLimits::default()).unwrap();
            fingers[scene.gripper().fingers() as usize] += 1;
            let radius = |at: usize| scene.objects()[at].footprint().circumradius();
            fixed += usize::from(scene.objects().iter().any(singulate_planner::scene::Object::fixed));
            mixed += usize::from(scene.objects().len() > 1 && (radius(0) - radius(1)).abs() > 1e-9);
            keep_out += usize::from(!scene.table().keep_out().is_empty());
            away += usize::from(scene.table().top().min() != Point2::origin());
        }
        assert!(fingers[2..].iter().all(|&count| count > 50), "{fingers:?}");
        assert!([fixed, mixed, keep_out, away].iter().all(|count| (50..450).contains(count)));
    }
}
