//! How a finger's rectangle and a core stand to each other at one yaw, and how far the yaw may turn before that changes.
//!
//! All is seen from the gripper's axis with the finger along +x, so a growing yaw turns the core clockwise. Every step is
//! certified: a point at distance c from the axis moves along any direction by at most its rate times the turn and c/2 times
//! the turn's square.

use nalgebra::Vector2;

use super::body::Side;
use super::finger::Finger;

/// A finger and the core of an obstacle.
pub(super) struct Contact<'a> {
    finger: &'a Finger,
    /// The core's sides.
    sides: &'a [Side],
    /// The farthest corner of the core from the axis, m.
    farthest: f64,
    /// The signed distance, m: where the two overlap minus the least translation that parts them.
    pub(super) apart: f64,
    /// The direction from the finger to the core along which they are parted, of length 1.
    towards: Vector2<f64>,
    /// The nearest points of finger and core, where these are apart.
    nearest: Option<[Vector2<f64>; 2]>,
}

/// A separation along one direction.
struct Parting {
    apart: f64,
    towards: Vector2<f64>,
    /// Nearest points, if this is the distance for certain.
    nearest: Option<[Vector2<f64>; 2]>,
}

impl<'a> Contact<'a> {
    /// `sides` as seen from the axis; none of their corners is farther away than `farthest`.
    pub(super) fn new(finger: &'a Finger, sides: &'a [Side], farthest: f64) -> Self {
        let across = across_faces(finger, sides);
        let outward = across_sides(finger, sides);
        let Parting { apart, towards, nearest } = if across.apart >= outward.apart { across } else { outward };
        let mut contact = Self { finger, sides, farthest, apart, towards, nearest: nearest.filter(|_| apart > 0.0) };
        if apart > 0.0 && nearest.is_none() {
            contact.between_corners();
        }
        contact
    }

    /// Looks at all corners of both: the parting was no distance.
    fn between_corners(&mut self) {
        let (mut least, mut pair) = (f64::INFINITY, [Vector2::zeros(); 2]);
        let mut compare = |finger: Vector2<f64>, core: Vector2<f64>| {
            let square = (core - finger).norm_squared();
            if square < least {
                (least, pair) = (square, [finger, core]);
            }
        };
        for side in self.sides {
            compare(self.finger.nearest(side.start), side.start);
            for corner in self.finger.corners() {
                compare(corner, side.nearest(corner));
            }
        }
        // Rounding apart, no direction parts them by more than this.
        self.apart = least.sqrt();
        if self.apart > 0.0 {
            self.towards = (pair[1] - pair[0]) / self.apart;
            self.nearest = Some(pair);
        }
    }

    /// While the yaw grows by less than this, rad, the finger keeps `rho` from the core, as it does now.
    pub(super) fn stays_free(&self, rho: f64) -> f64 {
        let n = self.towards;
        let reach = self.finger.corners().map(|corner| n.dot(&corner)).into_iter().fold(f64::NEG_INFINITY, f64::max);
        let (mut nearest, mut with_finger) = (f64::INFINITY, f64::INFINITY);
        for Side { start, .. } in self.sides {
            let along = n.dot(start);
            nearest = nearest.min(along);
            // The direction turns with the finger, the core's corners turn back.
            with_finger = with_finger.min(turn(along - reach - rho, n.dot(&clockwise(*start)), self.farthest));
        }
        // Or it stays with the core, and the finger's corners turn.
        let far = self.finger.corner_distance();
        let corners =
            self.finger.corners().map(|corner| turn(nearest - rho - n.dot(&corner), n.dot(&clockwise(corner)), far));
        with_finger.max(corners.into_iter().fold(f64::INFINITY, f64::min))
    }

    /// While the yaw grows by less than this, rad, the finger stays nearer to the core than `rho`, as it is now.
    pub(super) fn stays_blocked(&self, rho: f64) -> f64 {
        // No point of the finger moves farther than this times the turn.
        let moved = (rho - self.apart) / self.finger.corner_distance();
        match self.nearest {
            Some([finger, core]) => {
                let gap = (rho - self.apart) * (rho + self.apart) / 2.0;
                moved.max(turn(gap, finger.dot(&clockwise(core)), finger.norm() * core.norm()))
            }
            None => moved.max(self.corner_stays_inside()),
        }
    }

    /// How long some corner of the one stays inside the other.
    fn corner_stays_inside(&self) -> f64 {
        let in_finger = self.sides.iter().map(|side| {
            let (v, back) = (side.start, clockwise(side.start));
            let faces = self.finger.faces();
            let stays = faces.map(|(n, offset)| turn(offset - n.dot(&v), -n.dot(&back), self.farthest));
            stays.into_iter().fold(f64::INFINITY, f64::min)
        });
        let far = self.finger.corner_distance();
        let in_core = self.finger.corners().map(|corner| {
            let stays = |side: &Side| {
                let n = side.outward();
                turn(n.dot(&(side.start - corner)), n.dot(&clockwise(corner)), far)
            };
            // A segment has no inside.
            if self.sides.len() > 2 { self.sides.iter().map(stays).fold(f64::INFINITY, f64::min) } else { 0.0 }
        });
        in_finger.chain(in_core).fold(0.0, f64::max)
    }
}

/// How a point that the core holds moves while the yaw grows, per rad, as seen from the finger.
fn clockwise(v: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(v.y, -v.x)
}

/// The greatest turn t with gap + rate·t − bend·t²/2 ≥ 0; 0 where the gap is negative.
fn turn(gap: f64, rate: f64, bend: f64) -> f64 {
    if gap < 0.0 {
        return 0.0;
    }
    let root = (rate * rate + 2.0 * bend * gap).sqrt();
    // Each form where it loses no digits.
    if rate > 0.0 {
        (rate + root) / bend
    } else if root - rate > 0.0 {
        2.0 * gap / (root - rate)
    } else if bend > 0.0 {
        0.0
    } else {
        f64::INFINITY
    }
}

/// The greatest separation along a normal of the finger.
fn across_faces(finger: &Finger, sides: &[Side]) -> Parting {
    let mut widest = Parting { apart: f64::NEG_INFINITY, towards: Vector2::x(), nearest: None };
    for (normal, offset) in finger.faces() {
        let (mut least, mut corner) = (f64::INFINITY, Vector2::zeros());
        for Side { start, .. } in sides {
            let along = normal.dot(start) - offset;
            if along < least {
                (least, corner) = (along, *start);
            }
        }
        if least > widest.apart {
            let foot = finger.nearest(corner);
            let straight = (corner - foot - normal * least).norm_squared() <= 0.0;
            widest = Parting { apart: least, towards: normal, nearest: straight.then_some([foot, corner]) };
        }
    }
    widest
}

/// The greatest separation along a normal of the core.
fn across_sides(finger: &Finger, sides: &[Side]) -> Parting {
    let mut widest = Parting { apart: f64::NEG_INFINITY, towards: Vector2::x(), nearest: None };
    for side in sides {
        let normal = side.outward();
        let corner = finger.corner_against(normal);
        let apart = normal.dot(&(corner - side.start));
        if apart > widest.apart {
            let share = side.along.dot(&(corner - side.start));
            let beside = (0.0..=side.length).contains(&share);
            let nearest = beside.then(|| [corner, side.start + side.along * share]);
            widest = Parting { apart, towards: -normal, nearest };
        }
    }
    widest
}
