//! The yaws at which one obstacle blocks the whole gripper.

use super::arcs::ArcSet;
use super::finger::{BlockedOffsets, SweptRectangle};
use crate::scene::{Footprint, Gripper, Shape, distance};

/// The shadow of `obstacle` on a grasp of `grasped` by the swept finger model, when the fingers must stay the gripper's
/// margin plus `extra` (m) away from it. The k fingers are 2π/k apart, so modulo that period one finger's shadow is the
/// gripper's.
pub fn shadow(gripper: &Gripper, grasped: &Footprint, obstacle: &Footprint, extra: f64) -> ArcSet {
    let period = gripper.period();
    let (Shape::Disc { radius }, Shape::Disc { radius: others }) = (grasped.shape, obstacle.shape);
    let finger = SweptRectangle {
        inner: radius,
        outer: gripper.outer_distance(grasped),
        half_width: gripper.finger_width() / 2.0,
    };
    let apart = distance(grasped.at(), obstacle.at());
    match finger.blocked_offsets(apart, others + gripper.margin() + extra) {
        BlockedOffsets::Clear => ArcSet::empty(period),
        BlockedOffsets::Every => ArcSet::full(period),
        BlockedOffsets::Between { first, last } => {
            let towards = obstacle.at() - grasped.at();
            let bearing = libm::atan2(towards.y, towards.x);
            if first > 0.0 {
                ArcSet::fold(period, &[(bearing - last, bearing - first), (bearing + first, bearing + last)])
            } else {
                ArcSet::fold(period, &[(bearing - last, bearing + last)])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use nalgebra::{Point2, Rotation2};
    use proptest::prelude::*;

    use super::*;
    use crate::scene::{
        GoalDraft, GripperDraft, ObjectDraft, RectangleDraft, Scene, SceneDraft, SceneLimits, ShapeDraft, TableDraft,
    };

    fn gripper(fingers: u32, finger_width: f64, clearance: f64, margin: f64) -> Gripper {
        let side = |at: f64| Some(at);
        let top = RectangleDraft { x_min: side(-9.0), y_min: side(-9.0), x_max: side(9.0), y_max: side(9.0) };
        let only = ObjectDraft {
            id: Some("a".into()),
            x: side(0.0),
            y: side(0.0),
            shape: ShapeDraft::disc(1.0),
            fixed: false,
        };
        let gripper = GripperDraft {
            fingers: Some(fingers.into()),
            finger_width: Some(finger_width),
            clearance: Some(clearance),
            margin: Some(margin),
            yaw_tolerance: Some(0.0),
            ..GripperDraft::default()
        };
        let table = TableDraft { top, keep_out: vec![] };
        let goal = Some(GoalDraft::Target("a".into()));
        let draft = SceneDraft { table, gripper, objects: vec![only], goal, ..SceneDraft::default() };
        *Scene::new(draft, &SceneLimits::default()).expect("a sound scene").0.gripper()
    }

    /// How far the obstacle's edge is from the nearest finger, beyond the margin, m: the definition, finger by finger.
    fn room(gripper: &Gripper, grasped: &Footprint, obstacle: &Footprint, yaw: f64) -> f64 {
        let (inner, outer) = (grasped.circumradius(), grasped.circumradius() + gripper.clearance());
        (0..gripper.fingers())
            .map(|finger| {
                let turn = Rotation2::new(-(yaw + TAU * f64::from(finger) / f64::from(gripper.fingers())));
                let at = turn * (obstacle.at() - grasped.at());
                let dx = (inner - at.x).max(at.x - outer).max(0.0);
                let dy = (at.y.abs() - gripper.finger_width() / 2.0).max(0.0);
                (dx * dx + dy * dy).sqrt() - obstacle.circumradius() - gripper.margin()
            })
            .fold(f64::INFINITY, f64::min)
    }

    /// From 1 mm to 1 m, evenly in every order of magnitude.
    fn length() -> impl Strategy<Value = f64> {
        (-3.0..0.0_f64).prop_map(|exponent| libm::pow(10.0, exponent))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1500))]

        #[test]
        fn a_yaw_is_in_the_shadow_exactly_when_some_finger_meets_the_obstacle(
            fingers in 2_u32..=12,
            (radius, obstacle_radius, finger_width, clearance) in (length(), length(), length(), length()),
            margin in prop_oneof![Just(0.0), length()],
            (away, bearing) in (0.0..1.1_f64, 0.0..TAU),
            (x, y) in (-5.0..5.0_f64, -5.0..5.0_f64),
        ) {
            let gripper = gripper(fingers, finger_width, clearance, margin);
            let grasped = Footprint::disc(Point2::new(x, y), radius);
            // From touching to just out of reach.
            let (near, far) = (radius, gripper.corner_distance(&grasped) + margin);
            let apart = obstacle_radius + near + away * (far - near);
            let towards = Rotation2::new(bearing) * nalgebra::Vector2::new(apart, 0.0);
            let obstacle = Footprint::disc(grasped.at() + towards, obstacle_radius);
            let shadow = shadow(&gripper, &grasped, &obstacle, 0.0);
            for step in 0..1440 {
                let yaw = TAU * f64::from(step) / 1440.0;
                let room = room(&gripper, &grasped, &obstacle, yaw);
                let folded = super::super::arcs::wrap(yaw, gripper.period());
                let says = shadow.arcs().iter().any(|arc| arc.lo < folded && folded < arc.hi);
                // A full shadow is closed at the turn's seam.
                prop_assert!(
                    room.abs() < 1e-9 || says == (room < 0.0) || shadow.is_full() && room < 0.0
                        || (folded.min(gripper.period() - folded) < 1e-9),
                    "yaw {yaw} room {room} {shadow:?}"
                );
            }
        }
    }
}
