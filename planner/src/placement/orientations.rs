//! How an object may be turned when it is set down.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use nalgebra::Vector2;

use super::layout::Layout;
use crate::scene::{Core, Footprint, ObjectIndex, distance};

/// The most orientations that are tried.
const MOST: usize = 10;
/// Two orientations nearer than this are one, rad.
const SAME: f64 = 1e-9;
/// The neighbours along whose edges an object is laid.
const NEIGHBOURS: usize = 2;

/// The yaws of the frame of an object that are tried in turn: as it stands; along the table's axes; across; along the edges of its
/// neighbours. A disc that may be grasped at every yaw has one.
pub(super) fn orientations(layout: &Layout<'_>, object: ObjectIndex) -> Vec<f64> {
    let (stands, grasps) = (layout.footprint(object), layout.scene().object(object).grasps());
    let yaw = stands.pose().yaw;
    if grasps.listed().is_none() {
        return vec![yaw];
    }
    let mut yaws = Yaws(vec![wrap(yaw)]);
    match stands.core() {
        // A disc covers the same however it is turned, but its grasps turn with it.
        None => (1..8).for_each(|eighth| yaws.add(yaw + f64::from(eighth) * FRAC_PI_4)),
        Some(core) => {
            let side = longest(core);
            let nearest = (side / FRAC_PI_2).round() * FRAC_PI_2;
            let quarters = [0.0, FRAC_PI_2, PI, -FRAC_PI_2];
            quarters.iter().for_each(|quarter| yaws.add(yaw + nearest - side + quarter));
            quarters.iter().for_each(|quarter| yaws.add(yaw + quarter));
            for edge in edges_nearby(layout, object, stands) {
                quarters.iter().take(2).for_each(|quarter| yaws.add(yaw + edge - side + quarter));
            }
        }
    }
    yaws.0.truncate(MOST);
    yaws.0
}

/// Yaws in [0, 2π), none twice.
struct Yaws(Vec<f64>);

impl Yaws {
    fn add(&mut self, yaw: f64) {
        let yaw = wrap(yaw);
        let is = |other: &f64| (yaw - other).abs() < SAME || TAU - (yaw - other).abs() < SAME;
        if !self.0.iter().any(is) {
            self.0.push(yaw);
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
