//! Listed grasps against brute force over the band.

use core::f64::consts::TAU;

use proptest::prelude::*;
use singulate_planner::geometry::shadow;
use singulate_planner::scene::{GraspDraft, Gripper, ObjectIndex, Scene};

use super::brute::{core, edge, finger, room, stop};
use super::random::{gripper, object, scene, shape};

/// Yaws of a band that are tried.
const SAMPLES: u32 = 20;

/// The least and the greatest stop of each finger over the band, in the object's own frame.
fn stops(gripper: &Gripper, points: &[[f64; 2]], [x, y, yaw]: [f64; 3], band: f64) -> Vec<[f64; 2]> {
    let of_finger = |m: u32| {
        let all = (0..=SAMPLES).map(|sample| {
            let off = band * (2.0 * f64::from(sample) / f64::from(SAMPLES) - 1.0);
            let turn = yaw + off + TAU * f64::from(m) / f64::from(gripper.fingers());
            let (cos, sin) = (libm::cos(turn), libm::sin(turn));
            let seen = |&[px, py]: &[f64; 2]| {
                let (px, py) = (px - x, py - y);
                [px * cos + py * sin, py * cos - px * sin]
            };
            stop(&points.iter().map(seen).collect::<Vec<_>>(), gripper.finger_width() / 2.0)
        });
        all.fold([f64::INFINITY, 0.0], |[least, most]: [f64; 2], stop| [least.min(stop), most.max(stop)])
    };
    (0..gripper.fingers()).map(of_finger).collect()
}

/// The least room of all fingers over the band, m.
fn least_room(scene: &Scene, [x, y, yaw]: [f64; 3], band: f64, extra: f64) -> f64 {
    let (gripper, grasped, obstacle) =
        (scene.gripper(), scene.objects()[0].footprint(), scene.objects()[1].footprint());
    let stops = stops(gripper, &edge(grasped), [x, y, yaw], band);
    let outer = stops.iter().map(|stop| stop[1]).fold(0.0, f64::max) + gripper.clearance();
    let (pose, core) = (grasped.pose(), core(obstacle));
    let (cos, sin) = (libm::cos(pose.yaw), libm::sin(pose.yaw));
    let axis = [pose.at.x + x * cos - y * sin, pose.at.y + x * sin + y * cos];
    let keep = obstacle.radius() + gripper.margin();
    let mut least = f64::INFINITY;
    for (m, [inner, _]) in (0_u32..).zip(stops) {
        for sample in 0..=SAMPLES {
            let off = band * (2.0 * f64::from(sample) / f64::from(SAMPLES) - 1.0);
            let turn = pose.yaw + yaw + off + TAU * f64::from(m) / f64::from(gripper.fingers());
            let rectangle = finger(axis, turn, inner - extra, outer + extra, gripper.finger_width() / 2.0);
            least = least.min(room(&rectangle, &core, keep));
        }
    }
    least
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn a_listed_grasp_is_blocked_exactly_when_some_yaw_of_its_band_is(
        hand in gripper(), (own, obstacle) in (shape(), shape()), pose in [-0.2..0.2_f64, -0.2..0.2_f64, 0.0..TAU],
        grasp in [-0.05..0.05_f64, -0.05..0.05_f64, 0.0..TAU], share in prop_oneof![Just(0.0), 0.0..0.9_f64],
        (away, bearing, yaw) in (0.0..0.5_f64, 0.0..TAU, 0.0..TAU),
    ) {
        let band = share * core::f64::consts::PI / hand.fingers.unwrap();
        let [x, y, turn] = grasp.map(Some);
        let listed = GraspDraft { x, y, yaw: turn, tolerance: Some(band) };
        let at = [pose[0] + away * libm::cos(bearing), pose[1] + away * libm::sin(bearing), yaw];
        let objects = vec![object("t", pose, own, Some(vec![listed])), object("o", at, obstacle, None)];
        let Some(scene) = scene(hand, objects) else { return Ok(()) };
        let placed = |at| scene.placed(ObjectIndex::new(at));
        let says = shadow(scene.gripper(), placed(0), placed(1), 0.0).grasps() == 1;
        // Samples miss at most this much; the stops are extremes over the band, of which samples see less.
        let reach = 0.6;
        let coarse = 1e-4 + 4.0 * band / f64::from(SAMPLES) * reach;
        let room = least_room(&scene, grasp, band, 0.0);
        if says {
            let wide = least_room(&scene, grasp, band, coarse);
            prop_assert!(wide < coarse || sudden(&scene, grasp, band), "{room} {wide} {scene:?}");
        } else {
            prop_assert!(room >= -1e-6, "{room} {scene:?}");
        }
    }
}

/// True if a finger meets the object at some yaw of the band and misses it at another: then its stop jumps, and samples see no
/// bound of that.
fn sudden(scene: &Scene, grasp: [f64; 3], band: f64) -> bool {
    let stops = stops(scene.gripper(), &edge(scene.objects()[0].footprint()), grasp, band * 1.01 + 1e-3);
    stops.iter().any(|[least, most]| most - least > 0.02)
}
