//! How far a closing finger comes: to the farthest point of what is grasped within the strip that it sweeps.
//!
//! Over a band of yaws the greatest is at an end of the band, or straight out over a corner: a point that is met at several
//! yaws is farthest along the finger's axis at that which is nearest to its own bearing, and the distance from the axis has no
//! other greatest values within a sector. The least is at an end or at one of finitely many turns, at which the point that stops
//! the finger changes from one corner, side or border of the strip to another, or has its own least.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Vector2;
use smallvec::SmallVec;

use crate::scene::Shape;

use super::body::{Side, Sides, cos_sin, rotated, sides};

/// Beside a turn the finger may stop elsewhere than at it, rad.
const BESIDE: f64 = 1e-12;
/// A border of the strip meets a side whose end is no farther from it, m.
const TOUCHING: f64 = 1e-14;

/// What is grasped, as seen from the gripper's axis, in the object's own frame.
#[derive(Debug)]
pub(super) struct Grasped {
    corners: SmallVec<[Vector2<f64>; 8]>,
    sides: Sides,
    radius: f64,
}

impl Grasped {
    /// A shape grasped with the gripper's axis over `axis`, m.
    pub(super) fn new(shape: &Shape, axis: Vector2<f64>) -> Self {
        let side = |side: Side| Side { start: side.start - axis, ..side };
        let sides: Sides = sides(shape, 0.0).into_iter().map(side).collect();
        let mut corners: SmallVec<[Vector2<f64>; 8]> = sides.iter().map(|side| side.start).collect();
        if corners.is_empty() {
            corners.push(-axis);
        }
        Self { corners, sides, radius: shape.radius() }
    }

    /// All of it is within this distance from the axis, m.
    pub(super) fn extent(&self) -> f64 {
        self.corners.iter().map(|corner| corner.norm()).fold(0.0, f64::max) + self.radius
    }

    /// Where a finger at this yaw stops, with a strip that reaches `half` to each side, m; 0 where it meets nothing in front.
    pub(super) fn stop(&self, yaw: f64, half: f64) -> f64 {
        let back = cos_sin(-yaw);
        let mut tip = Vector2::new(f64::NEG_INFINITY, 0.0);
        for corner in &self.corners {
            let corner = rotated(*corner, back);
            if corner.x > tip.x {
                tip = corner;
            }
        }
        let stop = if tip.y.abs() <= half { tip.x + self.radius } else { self.exit(back, half.copysign(tip.y)) };
        stop.max(0.0)
    }

    /// The farthest point on a border of the strip; −∞ where there is none.
    fn exit(&self, back: [f64; 2], border: f64) -> f64 {
        let mut farthest = f64::NEG_INFINITY;
        for corner in &self.corners {
            let corner = rotated(*corner, back);
            let across = border - corner.y;
            let square = (self.radius - across) * (self.radius + across);
            if square >= 0.0 {
                farthest = farthest.max(corner.x + square.sqrt());
            }
        }
        for side in &self.sides {
            let grown = self.radius * side.outward();
            let [start, end] = [side.start + grown, side.end() + grown].map(|end| rotated(end, back));
            if border >= start.y.min(end.y) - TOUCHING && border <= start.y.max(end.y) + TOUCHING {
                let share = (border - start.y) / (end.y - start.y);
                // A side along the border is met as a whole.
                let x = if share.is_finite() {
                    start.x + share.clamp(0.0, 1.0) * (end.x - start.x)
                } else {
                    start.x.max(end.x)
                };
                farthest = farthest.max(x);
            }
        }
        farthest
    }

    /// Where a finger stops at most while its yaw is within `yaw` ± `band`, m.
    pub(super) fn most(&self, (yaw, band): (f64, f64), half: f64) -> f64 {
        let ends = self.stop(yaw - band, half).max(self.stop(yaw + band, half));
        let ahead =
            self.corners.iter().filter(|corner| off(bearing(**corner), yaw).abs() <= band || corner.norm() <= 0.0);
        ahead.map(|corner| corner.norm() + self.radius).fold(ends, f64::max)
    }

    /// Where a finger stops at least while its yaw is within `yaw` ± `band`, m. The turns are those of [`Self::turns`].
    pub(super) fn least(&self, (yaw, band): (f64, f64), half: f64, turns: &[f64]) -> f64 {
        let mut least = self.stop(yaw, half).min(self.stop(yaw - band, half)).min(self.stop(yaw + band, half));
        for turn in turns {
            let off = off(*turn, yaw);
            if off.abs() <= band {
                for off in [off - BESIDE, off, off + BESIDE] {
                    least = least.min(self.stop(yaw + off.clamp(-band, band), half));
                }
            }
        }
        least
    }

    /// The yaws at which the least distance may be found at which a finger stops.
    pub(super) fn turns(&self, half: f64) -> Vec<f64> {
        let mut turns = Vec::with_capacity(16 * self.corners.len());
        for corner in &self.corners {
            let (bearing, away) = (bearing(*corner), corner.norm());
            // The corner's arc has its top, or its lower end, on a border of the strip.
            across(&mut turns, bearing, half / away);
            if self.radius > 0.0 {
                across(&mut turns, bearing, (half + self.radius) / away);
            }
            // It is straight behind: the top is as near to the axis as it comes.
            turns.push(bearing + PI);
        }
        for side in &self.sides {
            let normal = bearing(side.outward());
            // The top passes to the next corner; the side is parallel to the strip.
            turns.extend([normal, normal + FRAC_PI_2, normal - FRAC_PI_2]);
            // The side's point on a border has its least.
            across(&mut turns, normal, half / (side.outward().dot(&side.start) + self.radius));
            if self.radius > 0.0 {
                // The grown side ends on a border.
                for end in [side.start, side.end()].map(|end| end + self.radius * side.outward()) {
                    across(&mut turns, bearing(end), half / end.norm());
                }
            }
        }
        turns
    }
}

/// Adds the yaws at which a point of this bearing is `share` of its distance to one or the other side of the finger's axis.
fn across(turns: &mut Vec<f64>, bearing: f64, share: f64) {
    if share.abs() <= 1.0 {
        let beside = libm::asin(share);
        turns.extend([bearing - beside, bearing + beside, bearing + PI - beside, bearing + PI + beside]);
    }
}

fn bearing(v: Vector2<f64>) -> f64 {
    libm::atan2(v.y, v.x)
}

/// From a yaw to an angle, within half a turn.
fn off(angle: f64, yaw: f64) -> f64 {
    let off = angle - yaw;
    off - TAU * (off / TAU).round()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::check::shapes::any_footprint;

    /// The grown outline as a polygon of many corners.
    fn outline(grasped: &Grasped) -> Vec<Vector2<f64>> {
        let rounds = 2000;
        let arc = |at: u32| {
            let (sin, cos) = libm::sincos(TAU * f64::from(at) / f64::from(rounds));
            let n = Vector2::new(cos, sin);
            let corner = grasped.corners.iter().copied().reduce(|a, b| if b.dot(&n) > a.dot(&n) { b } else { a });
            corner.unwrap() + grasped.radius * n
        };
        (0..rounds).map(arc).collect()
    }

    /// The farthest point of a polygon within the strip.
    fn farthest(outline: &[Vector2<f64>], yaw: f64, half: f64) -> f64 {
        let turned: Vec<_> = outline.iter().map(|v| rotated(*v, cos_sin(-yaw))).collect();
        let mut farthest = 0.0_f64;
        for (at, a) in turned.iter().enumerate() {
            let b = turned[(at + 1) % turned.len()];
            for border in [-half, half] {
                if (a.y < border) != (b.y < border) {
                    farthest = farthest.max(a.x + (border - a.y) / (b.y - a.y) * (b.x - a.x));
                }
            }
            if a.y.abs() <= half {
                farthest = farthest.max(a.x);
            }
        }
        farthest
    }

    fn any_grasped() -> impl Strategy<Value = Grasped> {
        (any_footprint(0.1), -0.15..0.15_f64, -0.15..0.15_f64)
            .prop_map(|(shape, x, y)| Grasped::new(shape.shape(), Vector2::new(x, y)))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn a_finger_stops_at_the_farthest_point_in_its_way(
            grasped in any_grasped(), yaw in -7.0..7.0_f64, half in 0.0005..0.05_f64,
        ) {
            let outline = outline(&grasped);
            // The outline is finer than the strips are apart.
            let (less, more) = (farthest(&outline, yaw, half - 1e-6), farthest(&outline, yaw, half + 1e-6));
            let stop = grasped.stop(yaw, half);
            prop_assert!(stop >= less - 1e-4 && stop <= more + 1e-4, "{} {} {}", stop, less, more);
        }

        #[test]
        fn no_yaw_of_the_band_stops_it_nearer_or_farther(
            grasped in any_grasped(), yaw in -7.0..7.0_f64, band in prop_oneof![Just(0.0), 0.0..0.3_f64, 0.0..3.2_f64], half in 0.0005..0.05_f64,
        ) {
            let turns = grasped.turns(half);
            let (least, most) = (grasped.least((yaw, band), half, &turns), grasped.most((yaw, band), half));
            let samples = 2000;
            let stops = (0..=samples).map(|at| grasped.stop(yaw + band * (f64::from(at) / f64::from(samples) * 2.0 - 1.0), half));
            let (lowest, highest) = stops.fold((f64::INFINITY, 0.0_f64), |(l, h), stop| (l.min(stop), h.max(stop)));
            prop_assert!(least <= lowest + 1e-11 && most >= highest - 1e-11, "{} {} {} {}", least, lowest, most, highest);
            // What is found between two samples is found by finer ones too, unless it is a jump that lasts no longer.
            let fine = |wanted: &dyn Fn(f64) -> bool| {
                turns.iter().chain(&[yaw]).any(|turn| {
                    let off = off(*turn, yaw).clamp(-band, band);
                    (-50..=50).any(|at| wanted(grasped.stop(yaw + (off + 1e-6 * f64::from(at)).clamp(-band, band), half)))
                })
            };
            prop_assert!(lowest <= least + 1e-3 || fine(&|stop| stop <= least + 1e-3), "{} {}", least, lowest);
            prop_assert!(highest >= most - 1e-3, "{} {}", most, highest);
        }
    }
}
