//! Shadows on a disc that may be grasped at every yaw.

use core::f64::consts::{PI, TAU};

use nalgebra::Vector2;
use proptest::prelude::*;
use singulate_planner::geometry::{ArcSet, Shadow, shadow};
use singulate_planner::scene::{GripperDraft, ObjectIndex, Scene, ShapeDraft};

use super::brute::room_round_disc;
use super::random::{gripper, object, scene, shape};

fn yaws(scene: &Scene) -> ArcSet {
    let placed = |at| scene.placed(ObjectIndex::new(at));
    match shadow(scene.gripper(), placed(0), placed(1), 0.0) {
        Shadow::Yaws(yaws) => yaws,
        Shadow::Grasps(_) => unreachable!("a disc without a list"),
    }
}

fn covers(shadow: &ArcSet, yaw: f64) -> bool {
    let folded = yaw.rem_euclid(shadow.period());
    shadow.arcs().iter().any(|arc| arc.lo < folded && folded < arc.hi)
}

/// A disc at the origin and an obstacle, which stands as far from touching as `away` of the way to out of reach.
fn pair(hand: GripperDraft, radius: f64, obstacle: ShapeDraft, (away, bearing, yaw): (f64, f64, f64)) -> Option<Scene> {
    let reach = 0.3 + radius + hand.clearance.unwrap_or_default();
    let [x, y] = [away * reach * libm::cos(bearing), away * reach * libm::sin(bearing)];
    scene(hand, vec![object("t", [0.0; 3], ShapeDraft::disc(radius), None), object("o", [x, y, yaw], obstacle, None)])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10_000))]

    #[test]
    fn a_yaw_is_in_the_shadow_exactly_when_some_finger_meets_the_obstacle(
        hand in gripper(), radius in 0.005..0.15_f64, obstacle in shape(),
        place in (0.05..1.0_f64, 0.0..TAU, 0.0..TAU), first in 0.0..0.2_f64,
    ) {
        let Some(scene) = pair(hand, radius, obstacle, place) else { return Ok(()) };
        let footprint = |at: usize| scene.objects()[at].footprint();
        let shadow = yaws(&scene);
        for step in 0..32 {
            let yaw = first + shadow.period() * f64::from(step) / 32.0;
            let room = room_round_disc(scene.gripper(), footprint(0), footprint(1), yaw);
            // Within rounding of an end both are right.
            let near_an_end = shadow.arcs().iter().any(|arc| {
                let folded = yaw.rem_euclid(shadow.period());
                (arc.lo - folded).abs() < 1e-7 || (arc.hi - folded).abs() < 1e-7
            });
            prop_assert!(
                near_an_end || room.abs() < 1e-9 || covers(&shadow, yaw) == (room < 0.0),
                "yaw {yaw} room {room} {shadow:?} {:?}", footprint(1)
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn a_disc_as_a_polygon_of_32_points_agrees_within_its_sagitta(
        hand in gripper(), radius in 0.005..0.15_f64, others in 0.01..0.15_f64,
        place in (0.05..1.0_f64, 0.0..TAU, 0.0..TAU),
    ) {
        let corner = |n: u32| {
            let angle = TAU * f64::from(n) / 32.0;
            [Some(others * libm::cos(angle)), Some(others * libm::sin(angle))]
        };
        let polygon = ShapeDraft::Polygon { points: (0..32).map(corner).collect(), corner_radius: None };
        let of = |shape| pair(hand, radius, shape, place).map(|scene| yaws(&scene));
        let inner = others * libm::cos(PI / 32.0);
        let all = (of(ShapeDraft::disc(inner)), of(polygon), of(ShapeDraft::disc(others)));
        let (Some(inside), Some(polygon), Some(outside)) = all else { return Ok(()) };
        for step in 0..360 {
            let yaw = outside.period() * f64::from(step) / 360.0;
            prop_assert!(!covers(&inside, yaw) || covers(&polygon, yaw) || near(&inside, yaw));
            prop_assert!(!covers(&polygon, yaw) || covers(&outside, yaw) || near(&polygon, yaw));
        }
    }

    #[test]
    fn a_larger_footprint_blocks_no_less(
        hand in gripper(), radius in 0.005..0.15_f64, points in proptest::collection::vec((-0.1..0.1_f64, -0.1..0.1_f64), 3..8),
        place in (0.05..1.0_f64, 0.0..TAU, 0.0..TAU),
    ) {
        // Exact, its hull with one point more, the circumscribed disc.
        let polygon = |points: &[(f64, f64)]| ShapeDraft::Polygon {
            points: points.iter().map(|&(x, y)| [Some(x), Some(y)]).collect(),
            corner_radius: None,
        };
        let farthest = points.iter().map(|(x, y)| (x * x + y * y).sqrt()).fold(0.0, f64::max);
        let mut more = points.clone();
        more.push((farthest, 0.0));
        let of = |shape| pair(hand, radius, shape, place).map(|scene| yaws(&scene));
        let all = (of(polygon(&points)), of(polygon(&more)), of(ShapeDraft::disc(farthest)));
        let (Some(exact), Some(hull), Some(circumscribed)) = all else { return Ok(()) };
        for step in 0..360 {
            let yaw = exact.period() * f64::from(step) / 360.0;
            prop_assert!(!covers(&exact, yaw) || covers(&hull, yaw) || near(&exact, yaw));
            prop_assert!(!covers(&hull, yaw) || covers(&circumscribed, yaw) || near(&hull, yaw));
        }
    }
}

/// True if the yaw is at an end of the shadow but for rounding.
fn near(shadow: &ArcSet, yaw: f64) -> bool {
    shadow.arcs().iter().any(|arc| (arc.lo - yaw).abs() < 1e-7 || (arc.hi - yaw).abs() < 1e-7)
}

#[test]
fn touching_does_not_block() {
    // A finger's tip ends where a sharp box begins.
    let hand =
        GripperDraft { fingers: Some(2.0), finger_width: Some(0.02), clearance: Some(0.05), ..GripperDraft::default() };
    let hand = GripperDraft { margin: Some(0.0), yaw_tolerance: Some(0.0), ..hand };
    let square = ShapeDraft::Rectangle { length: Some(0.1), width: Some(0.1), corner_radius: None };
    let at = |x: f64| {
        let objects =
            vec![object("t", [0.0; 3], ShapeDraft::disc(0.05), None), object("o", [x, 0.0, 0.0], square.clone(), None)];
        yaws(&scene(hand, objects).unwrap())
    };
    let corner = Vector2::new(0.1, 0.01).norm();
    // The last digit decides whether a corner that only touches leaves a sliver.
    let width = |x: f64| at(x).arcs().iter().map(|arc| arc.hi - arc.lo).sum::<f64>();
    assert!(width(corner + 0.05) < 1e-6);
    assert!(width(corner + 0.05 - 1e-6) > 1e-4);
    assert!(!covers(&at(0.15 + 1e-12), 0.0), "the tip touches");
}
