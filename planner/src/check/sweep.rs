//! The yaws at which a finger is too near to the core of an obstacle, found by marching: from each yaw to the next as far as it
//! is certain that nothing changes.
//!
//! Before a change the certain steps shrink faster than any fixed share, so an end is found to the last digits in a few steps.
//! Where two shapes only just touch the march steps over the touch by its least step, and the distance to keep, which leans as the
//! question does, decides.

use core::f64::consts::TAU;

use nalgebra::Point2;
use smallvec::SmallVec;

use super::body::{Body, Side, cos_sin};
use super::contact::Contact;
use super::finger::Finger;

/// The least step, rad: the ends of intervals are good to about this.
const LEAST_STEP: f64 = 1e-12;
/// A march takes some 15 steps. After so many the least step begins to double, so that one over hair-thin shapes ends too.
const PATIENCE: u32 = 512;
/// It doubles every so many steps then.
const HURRY: u32 = 64;
/// A band whose nearest yaw is asked for, for a message, is sampled at so many.
const SAMPLES: u32 = 64;

/// An obstacle with a core, as seen from a gripper's axis. The yaw counts from a base.
pub(super) struct Sweep<'a> {
    finger: &'a Finger,
    /// With the finger at the base yaw.
    sides: SmallVec<[Side; 8]>,
    /// With the finger at the last yaw that was looked at.
    seen: SmallVec<[Side; 8]>,
    farthest: f64,
}

impl<'a> Sweep<'a> {
    /// The finger of a hand over `axis`, with yaws from `base` on.
    pub(super) fn new(finger: &'a Finger, axis: Point2<f64>, base: f64, obstacle: &Body) -> Self {
        let (from_axis, back) = (obstacle.pose.at - axis, cos_sin(-base));
        let side = |side: &Side| Side { start: side.start + from_axis, ..*side }.rotated(back);
        let sides: SmallVec<[Side; 8]> = obstacle.sides.iter().map(side).collect();
        let farthest = sides.iter().map(|side| side.start.norm()).fold(0.0, f64::max);
        Self { finger, seen: sides.clone(), sides, farthest }
    }

    /// How the finger and the core stand at a yaw.
    fn at(&mut self, yaw: f64) -> Contact<'_> {
        let back = cos_sin(-yaw);
        self.seen.iter_mut().zip(&self.sides).for_each(|(seen, side)| *seen = side.rotated(back));
        Contact::new(self.finger, &self.seen, self.farthest)
    }

    /// True if the finger comes nearer than `rho` at some yaw from the base to `end`, rad.
    pub(super) fn comes_near(&mut self, end: f64, rho: f64) -> bool {
        // Most obstacles are far off, or in the way at the middle.
        let middle = self.at(end / 2.0).apart;
        if middle < rho || middle - self.finger.corner_distance() * end / 2.0 >= rho {
            return middle < rho;
        }
        let mut near = false;
        self.march(end, rho, |_, _, blocked| {
            near = blocked;
            !blocked
        });
        near
    }

    /// The intervals of yaws within a whole turn from the base at which the finger is nearer than `rho`, rad.
    pub(super) fn blocked(&mut self, rho: f64) -> SmallVec<[[f64; 2]; 4]> {
        let mut intervals: SmallVec<[[f64; 2]; 4]> = SmallVec::new();
        let mut open = false;
        self.march(TAU, rho, |from, to, blocked| {
            match intervals.last_mut() {
                Some(last) if blocked && open => last[1] = to,
                _ if blocked => intervals.push([from, to]),
                _ => {}
            }
            open = blocked;
            true
        });
        intervals
    }

    /// Visits the yaws from the base to `end` in pieces that are all free or all blocked, until `visit` says no.
    fn march(&mut self, end: f64, rho: f64, mut visit: impl FnMut(f64, f64, bool) -> bool) {
        let (mut yaw, mut least, mut steps) = (0.0, LEAST_STEP, 0);
        loop {
            let contact = self.at(yaw);
            let blocked = contact.apart < rho;
            let certain = if blocked { contact.stays_blocked(rho) } else { contact.stays_free(rho) };
            let next = (yaw + certain.max(least)).min(end);
            if !visit(yaw, next, blocked) || next >= end {
                return;
            }
            yaw = next;
            steps += 1;
            if steps >= PATIENCE && steps % HURRY == 0 {
                least *= 2.0;
            }
        }
    }

    /// The least distance at sampled yaws from the base to `end`, m: for messages.
    pub(super) fn nearest(&mut self, end: f64) -> f64 {
        let step = end / f64::from(SAMPLES);
        (0..=SAMPLES).map(|at| self.at(f64::from(at) * step).apart).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::check::shapes::{any_footprint, at, separation};
    use crate::scene::Footprint;

    /// The finger at a yaw as sides.
    fn turned(finger: &Finger, yaw: f64) -> Vec<Side> {
        let corners = finger.corners();
        let side = |at: usize| {
            let (start, along) = (corners[at], corners[(at + 1) % 4] - corners[at]);
            Side { start, along: along / along.norm(), length: along.norm() }.rotated(cos_sin(yaw))
        };
        (0..4).map(side).collect()
    }

    fn any_finger() -> impl Strategy<Value = Finger> {
        (0.0..0.2_f64, 0.001..0.2_f64, 0.0005..0.05_f64).prop_map(|(inner, clearance, half)| Finger {
            inner,
            outer: inner + clearance,
            half,
        })
    }

    fn any_polygon() -> impl Strategy<Value = Footprint> {
        any_footprint(0.1).prop_filter("a core", |shape| shape.shape().core().is_some())
    }

    /// The core as seen from the axis.
    fn sides(body: &Body) -> Vec<Side> {
        body.sides.iter().map(|side| Side { start: side.start + body.pose.at.coords, ..*side }).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn the_distance_is_the_greatest_separation(
            finger in any_finger(), shape in any_polygon(), (x, y, turn) in (-0.3..0.3_f64, -0.3..0.3_f64, -4.0..4.0_f64), yaw in -7.0..7.0_f64,
        ) {
            let body = at(&shape, [x, y, turn]);
            let real = Sweep::new(&finger, Point2::origin(), 1.0, &body).at(yaw - 1.0).apart;
            let sampled = separation(&turned(&finger, yaw), &sides(&body), 2000);
            prop_assert!(real >= sampled - 1e-12 && real <= sampled + 1.2 * 0.0016, "{} {}", real, sampled);
        }

        #[test]
        fn the_intervals_are_what_sampling_finds(
            finger in any_finger(), shape in any_polygon(), (x, y, turn) in (-0.3..0.3_f64, -0.3..0.3_f64, -4.0..4.0_f64),
            margin in prop_oneof![Just(0.0), 0.0..0.05_f64],
        ) {
            let body = at(&shape, [x, y, turn]);
            let (rho, mut sweep) = (body.radius + margin, Sweep::new(&finger, Point2::origin(), 0.0, &body));
            let intervals = sweep.blocked(rho);
            for step in 0..720 {
                let yaw = TAU * (f64::from(step) + 0.37) / 720.0;
                let apart = sweep.at(yaw).apart;
                if (apart - rho).abs() > 1e-11 {
                    let blocked = intervals.iter().any(|[lo, hi]| (*lo..=*hi).contains(&yaw));
                    prop_assert_eq!(blocked, apart < rho, "yaw {} apart {} of {:?}", yaw, apart, &intervals);
                }
            }
            for end in intervals.iter().flatten().filter(|end| **end > 0.0 && **end < TAU) {
                let apart = sweep.at(*end).apart;
                prop_assert!((apart - rho).abs() < 1e-11, "at {} apart {}", end, apart);
            }
        }

        #[test]
        fn a_band_is_near_where_a_sample_is(
            finger in any_finger(), shape in any_polygon(), (x, y, turn) in (-0.3..0.3_f64, -0.3..0.3_f64, -4.0..4.0_f64),
            margin in prop_oneof![Just(0.0), 0.0..0.05_f64], begin in -4.0..4.0_f64, band in 0.0..0.6_f64,
        ) {
            let body = at(&shape, [x, y, turn]);
            let (rho, mut sweep) = (body.radius + margin, Sweep::new(&finger, Point2::origin(), begin, &body));
            let nearest = sweep.nearest(band);
            let near = sweep.comes_near(band, rho);
            let coarse = finger.corner_distance() * band / f64::from(SAMPLES);
            prop_assert!(near || nearest >= rho - 1e-12, "free, and {} near", nearest);
            prop_assert!(!near || nearest < rho + coarse, "near, and {} apart", nearest);
        }
    }
}
