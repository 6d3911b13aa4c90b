//! How far open and closing fingers stand from the gripper's axis round an object, over a band of yaws.
//!
//! A finger closes along its axis until it meets the object: it stops at the greatest coordinate along that axis of what the
//! object has within the finger's strip. Over a band this coordinate has its extremes at the band's ends or where it can change
//! its course: where an edge or a vertex lines up with the axis or stands square to it, where a vertex or an end of a grown edge
//! crosses the strip's border, and where an edge passes the border at an extreme of its own. Each is a closed form.

use core::f64::consts::{PI, TAU};

use nalgebra::Vector2;
use smallvec::SmallVec;

use super::convex::{direction, length, turned};
use super::shape::Shape;

/// A finger with the core of the object as the finger sees it: the gripper's axis at the origin, the finger along +x.
pub(super) struct ClosingFinger {
    vertices: SmallVec<[Vector2<f64>; 8]>,
    /// How far the core is grown, m.
    radius: f64,
    /// Half of the finger's width, m.
    half: f64,
}

impl ClosingFinger {
    /// A finger at the yaw `yaw` (rad) whose gripper stands with its axis over `axis`, both in the frame of `shape`.
    pub(super) fn new(shape: &Shape, axis: Vector2<f64>, yaw: f64, half: f64) -> Self {
        let origin = [Vector2::zeros()];
        let vertices = shape.core().map_or(&origin[..], |core| core.vertices());
        let back = direction(-yaw);
        Self { vertices: vertices.iter().map(|v| turned(v - axis, back)).collect(), radius: shape.radius(), half }
    }

    /// The least and the greatest coordinate at which the finger stops while it turns by up to `band` (rad) either way, m; 0
    /// where it meets nothing before the axis.
    pub(super) fn stops(&self, band: f64) -> [f64; 2] {
        let mut turns: SmallVec<[f64; 16]> = SmallVec::from_slice(&[-band]);
        if band > 0.0 {
            turns.push(band);
            self.turning_points(band, &mut turns);
            turns.retain(|turn| turn.abs() <= band);
            turns.sort_unstable_by(f64::total_cmp);
            turns.dedup();
        }
        let stops = turns.into_iter().map(|turn| self.stop(turn));
        stops.fold([f64::INFINITY, 0.0], |[least, most], stop| [least.min(stop), most.max(stop)])
    }

    /// Where the finger stops once it has turned by `turn`, rad.
    fn stop(&self, turn: f64) -> f64 {
        let back = direction(-turn);
        let vertices: SmallVec<[Vector2<f64>; 8]> = self.vertices.iter().map(|v| turned(*v, back)).collect();
        let mut most = 0.0_f64;
        for (at, v) in vertices.iter().enumerate() {
            if v.y.abs() <= self.half {
                most = most.max(v.x + self.radius);
            }
            let next = vertices[(at + 1) % vertices.len()];
            for border in [-self.half, self.half] {
                let across = self.radius * self.radius - (border - v.y) * (border - v.y);
                if across >= 0.0 {
                    most = most.max(v.x + across.sqrt());
                }
                most = most.max(self.edge_at(*v, next, border).unwrap_or(0.0));
            }
        }
        most
    }

    /// Where the grown edge between two vertices passes the strip's border.
    fn edge_at(&self, start: Vector2<f64>, end: Vector2<f64>, border: f64) -> Option<f64> {
        let along = end - start;
        let length = length(along);
        // The outward normal of an edge on the far side points along the finger.
        if along.y <= 0.0 {
            return None;
        }
        let start = start + Vector2::new(along.y, -along.x) * (self.radius / length);
        let share = (border - start.y) / along.y;
        (0.0..=1.0).contains(&share).then(|| start.x + share * along.x)
    }

    /// The turns within the band at which the stop can have an extreme. Those outside it are left out by a bound on how far a
    /// point moves.
    fn turning_points(&self, band: f64, turns: &mut SmallVec<[f64; 16]>) {
        for (at, &v) in self.vertices.iter().enumerate() {
            self.point(v, band, turns);
            let along = self.vertices[(at + 1) % self.vertices.len()] - v;
            let length = length(along);
            if length > 0.0 {
                let normal = Vector2::new(along.y, -along.x) / length;
                self.edge(normal, normal.dot(&v) + self.radius, band, turns);
                for end in [v, v + along] {
                    self.crossings(end + normal * self.radius, band, turns);
                }
            }
        }
    }

    /// Where a vertex lines up with the axis, or it or its arc crosses the strip's border.
    fn point(&self, v: Vector2<f64>, band: f64, turns: &mut SmallVec<[f64; 16]>) {
        let away = length(v);
        if v.y.abs() <= away * band {
            // Before the axis or behind it.
            turns.push(libm::atan2(v.y * v.x.signum(), v.x.abs()));
        }
        self.crossings(v, band, turns);
        // The arc comes into the strip, or the finger's corner lies on the line through axis and vertex, beyond it or before it.
        levels(v, away, self.half + self.radius, band, turns);
        for beside in [away + self.radius, (away - self.radius).abs()] {
            if beside > 0.0 {
                levels(v, away, self.half * away / beside, band, turns);
            }
        }
    }

    fn crossings(&self, point: Vector2<f64>, band: f64, turns: &mut SmallVec<[f64; 16]>) {
        let away = length(point);
        levels(point, away, self.half, band, turns);
    }

    /// Where an edge stands square to the axis or lies along it, or has an extreme on the strip's border.
    fn edge(&self, normal: Vector2<f64>, offset: f64, band: f64, turns: &mut SmallVec<[f64; 16]>) {
        if normal.y.abs() <= band {
            turns.push(libm::atan2(normal.y, normal.x));
        }
        if normal.x.abs() <= band {
            turns.push(libm::atan2(-normal.x, normal.y));
            turns.push(libm::atan2(normal.x, -normal.y));
        }
        if offset != 0.0 {
            levels(normal, 1.0, self.half / offset.abs(), band, turns);
        }
    }
}

/// The turns within the band that bring the point to the height `level` above or below the axis.
fn levels(point: Vector2<f64>, away: f64, level: f64, band: f64, turns: &mut SmallVec<[f64; 16]>) {
    for level in [-level, level] {
        if level.abs() <= away && (point.y - level).abs() <= away * band {
            let bearing = libm::atan2(point.y, point.x);
            let height = libm::asin(level / away);
            turns.push(within_a_turn(bearing - height));
            turns.push(within_a_turn(bearing + height - PI));
        }
    }
}

/// The same direction as an angle in [−π, π].
fn within_a_turn(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

#[cfg(test)]
mod tests {
    use super::super::convex::Core;
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_jaw_stops_at_the_side_that_it_is_square_to() {
        let shape = Shape::grown(Core::rectangle(0.4, 0.3), 0.0);
        let stops = |yaw, band| ClosingFinger::new(&shape, Vector2::zeros(), yaw, 0.01).stops(band);
        assert_eq!(stops(0.0, 0.0), [0.2, 0.2]);
        let [least, most] = stops(core::f64::consts::FRAC_PI_2, 0.1);
        assert!((least - 0.15).abs() < 1e-15, "{least}");
        let tilted = 0.15 / libm::cos(0.1) + 0.01 * libm::tan(0.1);
        assert!((most - tilted).abs() < 1e-15, "{most} {tilted}");
        let beside = ClosingFinger::new(&shape, Vector2::new(0.0, 0.17), 0.0, 0.01);
        assert_eq!(beside.stops(0.0), [0.0, 0.0]);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(600))]
        #[test]
        fn no_sampled_yaw_stops_the_finger_elsewhere(
            points in proptest::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64), 3..9),
            radius in prop_oneof![Just(0.0), 0.0..0.5_f64], disc in any::<bool>(),
            (x, y) in (-1.0..1.0_f64, -1.0..1.0_f64),
            yaw in 0.0..7.0_f64, band in 0.0..1.5_f64, half in 0.001..0.6_f64,
        ) {
            let points: Vec<_> = points.into_iter().map(|(x, y)| Vector2::new(x, y)).collect();
            let shape = match Core::hull(&points) {
                Some(core) if !disc => Shape::grown(Some(core), radius),
                _ => Shape::disc(radius + 0.01),
            };
            let finger = ClosingFinger::new(&shape, Vector2::new(x, y), yaw, half);
            let [least, most] = finger.stops(band);
            let samples = 3000;
            for sample in 0..=samples {
                let stop = finger.stop(band * (2.0 * f64::from(sample) / f64::from(samples) - 1.0));
                // Where an arc just comes into the strip, the last digit of the turn is the eighth of the stop.
                prop_assert!(least <= stop + 1e-7 && stop <= most + 1e-7, "{least} {stop} {most} at {sample}");
            }
        }
    }
}
