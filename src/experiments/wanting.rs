//! Random goals, drop-offs, destinations and openings for a scene, for tests.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::varied::{chance, whole};
use singulate_planner::scene::{
    Destination, DropOffDraft, GoalDraft, GripperDraft, ObjectDraft, Opening, Scene, SceneDraft, SceneLimits,
};

/// The same table with a random goal, none to three drop-offs with and without limits, a destination, and a hand that may be too
/// small for some of the objects. Of each kind of goal there is a quarter; where it can't be, the draft's own target stays.
pub fn wanting(draft: &SceneDraft, seed: u64) -> SceneDraft {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    // Another stream than those of `generate` and `varied`.
    random.set_stream(2);
    for _ in 0..20 {
        let drawn = drawn(draft.clone(), &mut random);
        if Scene::new(drawn.clone(), &SceneLimits::default()).is_ok() {
            return drawn;
        }
    }
    draft.clone()
}

fn drawn(mut draft: SceneDraft, random: &mut ChaCha8Rng) -> SceneDraft {
    let movable: Vec<String> =
        draft.objects.iter().filter(|object| !object.fixed).filter_map(|o| o.id.clone()).collect();
    if chance(random, 0.3) {
        draft.gripper = opened(draft.gripper, &draft.objects, random);
    }
    let count = whole(random, 0, 3);
    let drop_offs: Vec<DropOffDraft> = (0..count).map(|at| drop_off(at, &movable, random)).collect();
    draft.drop_offs = (!drop_offs.is_empty()).then_some(drop_offs);
    draft.destination = match whole(random, 0, 3) {
        0 => Some(Destination::Table),
        1 => Some(Destination::DropOff),
        2 => Some(Destination::TableThenDropOff),
        _ => None,
    };
    draft.goal = match whole(random, 0, 3) {
        0 => Some(GoalDraft::AnyOf(some(&movable, 4, random))),
        1 => Some(GoalDraft::AllOf(some(&movable, 3, random))),
        2 => Some(GoalDraft::Clear),
        _ => draft.goal,
    };
    draft
}

/// A hand as wide as one of the objects, or a little wider.
fn opened(gripper: GripperDraft, objects: &[ObjectDraft], random: &mut ChaCha8Rng) -> GripperDraft {
    let radius = objects[pick(objects.len(), random)].shape.disc_radius().unwrap_or(0.05);
    let max_opening = 2.0 * radius * if chance(random, 0.5) { 1.0 } else { 1.2 };
    let opening = chance(random, 0.5).then_some(if chance(random, 0.5) { Opening::Full } else { Opening::Fit });
    GripperDraft { max_opening: Some(max_opening), opening, ..gripper }
}

fn drop_off(at: u32, movable: &[String], random: &mut ChaCha8Rng) -> DropOffDraft {
    let capacity = chance(random, 0.5).then(|| f64::from(whole(random, 1, 4)));
    let accepts = chance(random, 0.5).then(|| some(movable, movable.len(), random));
    DropOffDraft { id: Some(format!("t{at}")), capacity, accepts }
}

/// One or more of the ids, at most `most`, none twice.
fn some(ids: &[String], most: usize, random: &mut ChaCha8Rng) -> Vec<Option<String>> {
    let mut left: Vec<&String> = ids.iter().collect();
    let count = 1 + pick(most.min(ids.len()).max(1), random);
    let draw = |_| (!left.is_empty()).then(|| left.swap_remove(pick(left.len(), random)).clone());
    (0..count).filter_map(draw).map(Some).collect()
}

/// A random position in a list of so many.
fn pick(count: usize, random: &mut ChaCha8Rng) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below the count")]
    let at = (random.random::<f64>() * count as f64) as usize;
    at.min(count.saturating_sub(1))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::experiments::varied;
    use singulate_planner::scene::Goal;

    /// A number for each kind of goal.
    pub(in crate::experiments) fn kind(goal: &Goal) -> usize {
        match goal {
            Goal::Target(_) => 0,
            Goal::AnyOf(_) => 1,
            Goal::AllOf(_) => 2,
            Goal::Clear => 3,
        }
    }

    #[test]
    fn scenes_are_of_every_kind() {
        let (mut goals, mut limited, mut choosy, mut wide, mut full) = ([0; 4], 0, 0, 0, 0);
        for seed in 0..500 {
            let (scene, _) = Scene::new(wanting(&varied(seed), seed), &SceneLimits::default()).unwrap();
            goals[kind(scene.goal())] += 1;
            limited += usize::from(scene.drop_offs().iter().any(|drop_off| drop_off.capacity().is_some()));
            choosy += usize::from(scene.drop_offs().iter().any(|drop_off| drop_off.accepts().is_some()));
            wide += usize::from(scene.objects().iter().any(|object| !object.fixed() && !object.can_be_grasped()));
            full += usize::from(scene.gripper().opening() == Opening::Full);
        }
        assert!(goals.iter().all(|count| *count > 70), "{goals:?}");
        assert!([limited, choosy, wide, full].iter().all(|count| *count > 20), "{limited} {choosy} {wide} {full}");
    }
}
