//! The definitions by another library: fingers as polygons, distances of polygons, footprints as fine polygons.

use core::f64::consts::TAU;

use geo::{Coord, Distance, Euclidean, Geometry, Intersects, LineString, Point, Polygon};
use singulate_planner::scene::{Footprint, Gripper};

/// The core where it stands.
pub(crate) fn core(footprint: &Footprint) -> Geometry {
    let (at, yaw) = (footprint.at(), footprint.pose().yaw);
    let placed = |x: f64, y: f64| Coord {
        x: at.x + x * libm::cos(yaw) - y * libm::sin(yaw),
        y: at.y + x * libm::sin(yaw) + y * libm::cos(yaw),
    };
    let Some(core) = footprint.shape().core() else { return Point(placed(0.0, 0.0)).into() };
    let corners: Vec<Coord> = core.vertices().iter().map(|v| placed(v.x, v.y)).collect();
    match corners[..] {
        [start, end] => geo::Line { start, end }.into(),
        _ => Polygon::new(LineString(corners), Vec::new()).into(),
    }
}

/// A finger's rectangle from `inner` to `outer`, turned to `yaw`, with its axis at (x, y).
pub(crate) fn finger([x, y]: [f64; 2], yaw: f64, inner: f64, outer: f64, half: f64) -> Polygon {
    let placed = |along: f64, across: f64| Coord {
        x: x + along * libm::cos(yaw) - across * libm::sin(yaw),
        y: y + along * libm::sin(yaw) + across * libm::cos(yaw),
    };
    let corners = vec![placed(inner, -half), placed(outer, -half), placed(outer, half), placed(inner, half)];
    Polygon::new(LineString(corners), Vec::new())
}

/// The distance of a finger from a core beyond `keep`, m; −1 where they overlap.
pub(crate) fn room(finger: &Polygon, core: &Geometry, keep: f64) -> f64 {
    if finger.intersects(core) {
        return -1.0;
    }
    Euclidean.distance(&Geometry::from(finger.clone()), core) - keep
}

/// The least room of all fingers round a disc at a yaw, m.
pub(crate) fn room_round_disc(gripper: &Gripper, grasped: &Footprint, obstacle: &Footprint, yaw: f64) -> f64 {
    let (core, radius, at) = (core(obstacle), grasped.radius(), grasped.at());
    let keep = obstacle.radius() + gripper.margin();
    let fingers = 0..gripper.fingers();
    let rooms = fingers.map(|m| {
        let yaw = yaw + TAU * f64::from(m) / f64::from(gripper.fingers());
        let outer = radius + gripper.clearance();
        room(&finger([at.x, at.y], yaw, radius, outer, gripper.finger_width() / 2.0), &core, keep)
    });
    rooms.fold(f64::INFINITY, f64::min)
}

/// Points on the edge of a footprint in its own frame, so dense that straight lines between them are off by less than 1e-5 m.
pub(crate) fn edge(footprint: &Footprint) -> Vec<[f64; 2]> {
    let radius = footprint.radius();
    let origin = [nalgebra::Vector2::zeros()];
    let corners = footprint.shape().core().map_or(&origin[..], |core| core.vertices());
    let steps = 2000_u32;
    let directions = (0..steps).map(|step| TAU * f64::from(step) / f64::from(steps));
    // Along each direction the farthest vertex, grown.
    directions
        .map(|angle| {
            let (cos, sin) = (libm::cos(angle), libm::sin(angle));
            let far = |v: &&nalgebra::Vector2<f64>| v.x * cos + v.y * sin;
            let v = corners.iter().max_by(|a, b| far(a).total_cmp(&far(b))).expect("a corner");
            [v.x + radius * cos, v.y + radius * sin]
        })
        .collect()
}

/// Where a finger stops that closes along +x within |y| ≤ `half` on a convex closed line of points, m.
pub(crate) fn stop(points: &[[f64; 2]], half: f64) -> f64 {
    let mut most = 0.0_f64;
    for (at, &[x, y]) in points.iter().enumerate() {
        let [next_x, next_y] = points[(at + 1) % points.len()];
        if y.abs() <= half {
            most = most.max(x);
        }
        for border in [-half, half] {
            let (low, high) = (y.min(next_y), y.max(next_y));
            if low < border && border < high {
                most = most.max(x + (next_x - x) * (border - y) / (next_y - y));
            }
        }
    }
    most
}
