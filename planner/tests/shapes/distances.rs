//! Distances of footprints, and sums of cores.

use core::f64::consts::TAU;

use geo::{Distance, Euclidean, Geometry, Intersects};
use nalgebra::{Point2, Vector2};
use proptest::prelude::*;
use singulate_planner::scene::{
    Footprint, GoalDraft, GripperDraft, Rectangle, RectangleDraft, Scene, SceneDraft, SceneLimits, ShapeDraft,
    TableDraft,
};

use super::brute::core;
use super::random::{object, scene, shape};

fn hand() -> GripperDraft {
    GripperDraft {
        fingers: Some(2.0),
        finger_width: Some(0.01),
        clearance: Some(0.01),
        margin: Some(0.0),
        yaw_tolerance: Some(0.0),
        ..GripperDraft::default()
    }
}

/// Two footprints of a scene.
fn pair(one: ShapeDraft, two: ShapeDraft, at: [f64; 3], turn: f64) -> Option<[Footprint; 2]> {
    let grasp = Some(vec![super::random::over_the_origin()]);
    let scene = scene(hand(), vec![object("t", [0.0, 0.0, turn], one, grasp), object("o", at, two, None)])?;
    Some([0, 1].map(|at: usize| scene.objects()[at].footprint().clone()))
}

/// How far a core reaches along a direction, from the origin of the scene, m.
fn support(footprint: &Footprint, direction: Vector2<f64>) -> f64 {
    let reach = footprint.core().map_or(0.0, |core| core.reach_along(direction));
    footprint.at().coords.dot(&direction) + reach
}

/// The greatest gap along any of many directions, m: minus the least translation that parts two cores.
fn widest_gap(one: &Footprint, two: &Footprint) -> f64 {
    let directions = (0..3600).map(|step| TAU * f64::from(step) / 3600.0);
    let gap = |angle: f64| {
        let direction = Vector2::new(libm::cos(angle), libm::sin(angle));
        -support(two, -direction) - support(one, direction)
    };
    directions.map(gap).fold(f64::NEG_INFINITY, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn a_gap_is_what_another_library_measures(
        one in shape(), two in shape(), at in [-0.4..0.4_f64, -0.4..0.4_f64, 0.0..TAU], turn in 0.0..TAU,
    ) {
        let Some([one, two]) = pair(one, two, at, turn) else { return Ok(()) };
        let (gap, back) = (one.gap(&two), two.gap(&one));
        prop_assert!((gap - back).abs() < 1e-12);
        let apart = gap + one.radius() + two.radius();
        let (a, b): (Geometry, Geometry) = (core(&one), core(&two));
        if a.intersects(&b) {
            prop_assert!(apart <= 1e-12);
            // Directions between the tried ones are off by a little.
            prop_assert!((apart - widest_gap(&one, &two)).abs() < 1e-3, "{apart} {}", widest_gap(&one, &two));
        } else {
            prop_assert!((apart - Euclidean.distance(&a, &b)).abs() < 1e-12);
        }
    }

    #[test]
    fn the_sum_of_two_cores_reaches_as_far_as_both(one in shape(), two in shape(), turn in 0.0..TAU) {
        let Some([one, two]) = pair(one, two, [1.0, 1.0, 0.0], turn) else { return Ok(()) };
        let (Some(one), Some(two)) = (one.core(), two.core()) else { return Ok(()) };
        let sum = one.sum(&two.mirrored());
        for step in 0..90 {
            let angle = TAU * f64::from(step) / 90.0;
            let direction = Vector2::new(libm::cos(angle), libm::sin(angle));
            let both = one.reach_along(direction) + two.reach_along(-direction);
            prop_assert!((sum.reach_along(direction) - both).abs() < 1e-9, "{one:?} {two:?} {sum:?}");
        }
    }

    #[test]
    fn a_rectangle_of_the_table_is_as_far_as_an_object_like_it(
        own in shape(), at in [-0.4..0.4_f64, -0.4..0.4_f64, 0.0..TAU], sides in [0.05..0.4_f64, 0.05..0.4_f64],
    ) {
        let [length, width] = sides.map(Some);
        let like_it = ShapeDraft::Rectangle { length, width, corner_radius: None };
        let Some([area, own]) = pair(like_it, own, at, 0.0) else { return Ok(()) };
        let [min, max] = area.bounding_box();
        let keep_out = rectangle(min, max);
        let gap = own.gap_outside(&keep_out);
        // A disc only says that it overlaps, not how deep.
        let expected = if own.core().is_some() { own.gap(&area) } else { own.gap(&area).max(-own.radius()) };
        prop_assert!((gap - expected).abs() < 1e-12, "{gap} {expected}");
    }
}

/// A keep-out of a scene.
fn rectangle(min: Point2<f64>, max: Point2<f64>) -> Rectangle {
    let area = |[x_min, y_min, x_max, y_max]: [f64; 4]| RectangleDraft {
        x_min: Some(x_min),
        y_min: Some(y_min),
        x_max: Some(x_max),
        y_max: Some(y_max),
    };
    let table = TableDraft { top: area([-9.0, -9.0, 9.0, 9.0]), keep_out: vec![area([min.x, min.y, max.x, max.y])] };
    let objects = vec![object("t", [0.0; 3], ShapeDraft::disc(0.1), None)];
    let goal = Some(GoalDraft::Target("t".into()));
    let draft = SceneDraft { table, gripper: hand(), objects, goal, ..SceneDraft::default() };
    let (scene, _) = Scene::new(draft, &SceneLimits::default()).expect("a sound scene");
    scene.table().keep_out()[0]
}
