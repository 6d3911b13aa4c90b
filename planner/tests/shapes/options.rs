//! Options against every subset of the obstacles.

use core::f64::consts::TAU;

use proptest::prelude::*;
use singulate_planner::budget::Budget;
use singulate_planner::geometry::{Hold, Shadow, shadow};
use singulate_planner::knowledge::{SweptFinger, complete};
use singulate_planner::scene::{ObjectIndex, Scene};

use super::random::{gripper, object, scene, shape};

/// True if the target can be grasped once some obstacles are gone, asked of the hand and not of the options.
fn free_without(scene: &Scene, gone: u32) -> bool {
    let target = scene.placed(ObjectIndex::new(0));
    let left = scene.indices().skip(1).filter(|object| gone >> object.get() & 1 == 0);
    let shadows: Vec<Shadow> = left.map(|other| shadow(scene.gripper(), target, scene.placed(other), 0.0)).collect();
    let blocked = Shadow::union(scene.gripper(), target.object.grasps(), &shadows);
    Hold::free(scene.gripper(), target, &blocked).is_some()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn a_set_frees_the_target_exactly_when_it_holds_an_option(
        hand in gripper(), own in shape(),
        others in proptest::collection::vec((shape(), 0.05..0.3_f64, 0.0..TAU, 0.0..TAU), 1..7),
    ) {
        let mut objects = vec![object("t", [0.0; 3], own, None)];
        for (at, (shape, away, bearing, yaw)) in others.into_iter().enumerate() {
            let place = [away * libm::cos(bearing), away * libm::sin(bearing), yaw];
            // Every obstacle can be moved, whatever its grasps.
            objects.push(object(&format!("o{at}"), place, shape, Some(vec![super::random::over_the_origin()])));
        }
        let count = objects.len();
        let Some(scene) = scene(hand, objects) else { return Ok(()) };
        let base = complete(&scene, &SweptFinger, &Budget::unlimited()).unwrap();
        let options: Vec<u32> = base
            .options(ObjectIndex::new(0))
            .map(|option| option.iter().map(|member| 1 << member.get()).sum())
            .collect();
        for gone in (0..1_u32 << count).step_by(2) {
            let holds = options.iter().any(|option| option & !gone == 0);
            prop_assert_eq!(holds, free_without(&scene, gone), "{:b} {:?}", gone, options);
        }
        for one in &options {
            prop_assert!(!options.iter().any(|other| other != one && other & one == *other), "{:?}", options);
        }
    }
}
