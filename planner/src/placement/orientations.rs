//! How an object may be turned when it is set down.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use nalgebra::Vector2;

use super::layout::Layout;
use crate::scene::{Core, Footprint, Gripper, ListedGrasp, ObjectIndex, distance};

/// The most orientations that are tried.
const MOST: usize = 24;
/// Two orientations nearer than this are one, rad.
const SAME: f64 = 1e-9;
/// The neighbours along whose edges an object is laid.
const NEIGHBOURS: usize = 2;

/// The yaws of the frame of an object that are tried in turn: as it stands; along the table's axes; across; along the edges of its
/// neighbours. A disc that may be grasped at every yaw has one.
pub(super) fn orientations(layout: &Layout<'_>, object: ObjectIndex) -> Vec<f64> {
    let stands = layout.footprint(object);
    let yaw = stands.pose().yaw;
    let Some(list) = layout.scene().object(object).grasps().listed() else { return vec![yaw] };
    let half_turn = is_same_after_half_a_turn(stands, list, layout.scene().gripper());
    let mut yaws = Yaws { yaws: vec![wrap(yaw)], same_after: if half_turn { PI } else { TAU } };
    match stands.core() {
        // A disc covers the same however it is turned, but its grasps turn with it.
        None => (1..8).for_each(|eighth| yaws.add(yaw + f64::from(eighth) * FRAC_PI_4)),
        Some(core) => {
            let side = longest(core);
            let nearest = (side / FRAC_PI_2).round() * FRAC_PI_2;
            let quarters = [0.0, FRAC_PI_2, PI, -FRAC_PI_2];
            quarters.iter().for_each(|quarter| yaws.add(yaw + nearest - side + quarter));
            quarters.iter().for_each(|quarter| yaws.add(yaw + quarter));
            let nearby = edges_nearby(layout, object, stands);
            for edge in &nearby {
                quarters.iter().for_each(|quarter| yaws.add(yaw + edge - side + quarter));
            }
            // A release needs room along the fingers: there is most of it along the table's axes, or between edges nearby.
            for grasp in list {
                let along = [0.0].iter().chain(&nearby);
                along.for_each(|edge| quarters.iter().for_each(|quarter| yaws.add(edge + quarter - grasp.yaw())));
            }
        }
    }
    yaws.yaws.truncate(MOST);
    yaws.yaws
}

/// True if the object covers the same after half a turn, and can be grasped in the same ways.
fn is_same_after_half_a_turn(stands: &Footprint, list: &[ListedGrasp], gripper: &Gripper) -> bool {
    let Some(core) = stands.core() else { return false };
    let opposite = |v: &Vector2<f64>| core.vertices().iter().any(|other| (v + other).norm() < SAME);
    gripper.fingers().is_multiple_of(2)
        && list.iter().all(|grasp| grasp.offset() < SAME)
        && core.vertices().iter().all(opposite)
}

/// Yaws in [0, 2π), none twice.
struct Yaws {
    yaws: Vec<f64>,
    /// A turn by this makes no difference, rad.
    same_after: f64,
}

impl Yaws {
    fn add(&mut self, yaw: f64) {
        let yaw = wrap(yaw);
        let apart = |other: &f64| {
            let turns = (yaw - other) / self.same_after;
            (turns - turns.round()).abs() * self.same_after
        };
        if self.yaws.iter().all(|other| apart(other) >= SAME) {
            self.yaws.push(yaw);
        }
    }
}

fn wrap(yaw: f64) -> f64 {
    let wrapped = yaw - TAU * (yaw / TAU).floor();
    if wrapped < TAU { wrapped } else { 0.0 }
}

/// The direction of the longest edge, rad.
fn longest(core: &Core) -> f64 {
    let longer = |best: Vector2<f64>, edge: Vector2<f64>| if edge.dot(&edge) > best.dot(&best) { edge } else { best };
    let longest = core.edges().map(|[start, end]| end - start).fold(Vector2::zeros(), longer);
    libm::atan2(longest.y, longest.x)
}

/// The directions of the longest edges of the nearest objects with edges.
fn edges_nearby(layout: &Layout<'_>, object: ObjectIndex, stands: &Footprint) -> Vec<f64> {
    let others = layout.scene().indices().filter(|&other| other != object && !layout.is_lifted(other));
    let with_edges = others.filter_map(|other| {
        let footprint = layout.footprint(other);
        Some((distance(footprint.at(), stands.at()), longest(footprint.core()?)))
    });
    let mut near: Vec<(f64, f64)> = with_edges.collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    near.truncate(NEIGHBOURS);
    near.into_iter().map(|(_, direction)| direction).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knowledge::SweptFinger;
    use crate::scene::scenes::TestScene;
    use crate::scene::{GraspDraft, ObjectDraft, ShapeDraft};

    #[test]
    fn a_box_is_turned_along_the_table_and_along_its_neighbour() {
        let scene = TestScene::new(2)
            .rectangle("box", [0.5, 0.5, 0.3], [0.2, 0.1])
            .rectangle("other", [1.0, 0.5, -0.5], [0.1, 0.2])
            .disc("cup", 1.5, 1.5, 0.05)
            .build("cup");
        let yaws = |id: &str| orientations(&Layout::new(&scene, &SweptFinger), scene.find(id).unwrap());
        // The neighbour's longest edge is a quarter turn ahead of its frame.
        let along = wrap(FRAC_PI_2 - 0.5);
        let expected = [0.3, 0.0, FRAC_PI_2, 0.3 + FRAC_PI_2, along, along + FRAC_PI_2];
        let found = yaws("box");
        let same = |a: f64, b: f64| ((a - b) / PI - ((a - b) / PI).round()).abs() < 1e-9;
        assert!(found.len() == 6 && found.iter().zip(expected).all(|(a, b)| same(*a, b)), "{found:?}");
        assert_eq!(yaws("cup"), [0.0]);
    }

    #[test]
    fn fingers_are_laid_along_the_table_and_along_a_neighbour() {
        let grasp = GraspDraft { yaw: Some(0.4), ..GraspDraft::default() };
        let (length, width) = (Some(0.2), Some(0.1));
        let slanted = ObjectDraft {
            id: Some("box".into()),
            x: Some(0.5),
            y: Some(0.5),
            shape: ShapeDraft::Rectangle { length, width, corner_radius: None },
            grasps: Some(vec![grasp]),
            ..ObjectDraft::default()
        };
        let scene = TestScene::new(2)
            .object(slanted)
            .rectangle("other", [1.0, 0.5, -0.5], [0.1, 0.2])
            .disc("cup", 1.5, 1.5, 0.05)
            .build("cup");
        let found = orientations(&Layout::new(&scene, &SweptFinger), scene.find("box").unwrap());
        // The finger is 0.4 rad ahead of the frame.
        for along in [0.0, FRAC_PI_2, -0.5, FRAC_PI_2 - 0.5] {
            let turned = |yaw: &f64| ((yaw + 0.4 - along) / PI - ((yaw + 0.4 - along) / PI).round()).abs() < 1e-9;
            assert!(found.iter().any(turned), "{along} {found:?}");
        }
    }
}
