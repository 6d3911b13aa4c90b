//! The yaws that one obstacle blocks round a disc, found by cutting a circle with an outline; of an obstacle with a core by
//! marching ([`super::sweep`]).
//!
//! Seen from the grasped object, with the finger along +x, the obstacle's centre runs on a circle while the yaw turns. It
//! blocks while it is inside the finger grown by ρ: a rectangle with rounded corners. Every angle at which the circle can
//! meet the outline's lines and corner circles is a cut; between two cuts nothing changes, so one distance at the middle
//! decides. A cut that is not on the outline only divides a piece in two. The outline is symmetric, so half will do.

use core::f64::consts::PI;

use nalgebra::Vector2;
use smallvec::SmallVec;

use crate::scene::Gripper;

use super::body::Body;
use super::finger::Finger;
use super::leaning::Leaning;
use super::sweep::Sweep;

/// Added to a disc's radius, or subtracted, by leaning, as a share of the lengths involved. Where a circle is only just touched,
/// the last digit decides between no shadow and one of 1e-8 rad; this is far above the last digit and far below the leaning of an
/// interval's width.
pub(super) const LENGTH_LEANING: f64 = 1e-12;

/// A closed interval of yaws within [0, period], rad.
pub(super) type Interval = [f64; 2];
/// The yaws that one obstacle blocks; an interval over the period's end is held as two.
pub(super) type Intervals = SmallVec<[Interval; 4]>;

/// The offsets from 0 to π at which the obstacle may enter or leave the grown finger, in order, 0 and π included.
fn cuts(finger: &Finger, distance: f64, rho: f64) -> SmallVec<[f64; 12]> {
    let mut cuts: SmallVec<[f64; 12]> = SmallVec::from_slice(&[0.0, PI]);
    let mut add = |cut: f64| {
        if cut > 0.0 && cut < PI {
            cuts.push(cut);
        }
    };
    for along in [finger.inner - rho, finger.outer + rho] {
        if along.abs() < distance {
            add(libm::acos(along / distance));
        }
    }
    let across = finger.half + rho;
    if across < distance {
        let cut = libm::asin(across / distance);
        add(cut);
        add(PI - cut);
    }
    for corner in [Vector2::new(finger.inner, finger.half), Vector2::new(finger.outer, finger.half)] {
        let (away, bearing) = (corner.norm(), libm::atan2(corner.y, corner.x));
        // sin² of half the angle at which two circles cross; the law of cosines would lose the digits of a small ρ.
        let square = (rho - (distance - away)) * (rho + (distance - away)) / (4.0 * distance * away);
        if square > 0.0 && square < 1.0 {
            let turn = 2.0 * libm::asin(square.sqrt());
            add(bearing - turn);
            add(bearing + turn);
        }
    }
    cuts.sort_unstable_by(f64::total_cmp);
    cuts
}

/// The offsets from 0 to π at which the obstacle's centre is nearer to the finger than `rho`.
fn blocked_offsets(finger: &Finger, distance: f64, rho: f64) -> Intervals {
    let mut blocked = Intervals::new();
    for piece in cuts(finger, distance, rho).windows(2) {
        let (lo, hi) = (piece[0], piece[1]);
        if hi <= lo || finger.distance(distance, f64::midpoint(lo, hi)) >= rho {
            continue;
        }
        match blocked.last_mut() {
            Some(last) if last[1] >= lo => last[1] = hi,
            _ => blocked.push([lo, hi]),
        }
    }
    blocked
}

/// The yaws at which `obstacle` blocks a grasp of the disc `grasped`, in favour of a claim.
pub(super) fn blocked_by(
    obstacle: &Body,
    finger: &Finger,
    grasped: &Body,
    gripper: &Gripper,
    leaning: Leaning,
) -> Intervals {
    let (rho, apart) = (obstacle.radius + gripper.margin(), obstacle.pose.at - grasped.pose.at);
    if obstacle.is_disc() {
        let longer = leaning.sign() * LENGTH_LEANING;
        return blocked_yaws(finger, gripper.period(), apart, rho + longer * (rho + apart.norm()));
    }
    // From the far side on, where most likely nothing is blocked.
    let base = libm::atan2(-apart.y, -apart.x);
    let mut yaws = Intervals::new();
    for [lo, hi] in Sweep::new(finger, grasped.pose.at, base, obstacle).blocked(leaning.to_keep(rho)) {
        fold(&mut yaws, base + lo, hi - lo, gripper.period());
    }
    yaws
}

/// Every yaw.
pub(super) fn all(gripper: &Gripper) -> Intervals {
    Intervals::from_slice(&[[0.0, gripper.period()]])
}

/// The yaws, modulo `period`, at which an obstacle at `obstacle` from the object's centre blocks a finger grown by `rho`.
fn blocked_yaws(finger: &Finger, period: f64, obstacle: Vector2<f64>, rho: f64) -> Intervals {
    let (distance, mut yaws) = (obstacle.norm(), Intervals::new());
    if distance >= finger.corner_distance() + rho {
        return yaws;
    }
    let bearing = libm::atan2(obstacle.y, obstacle.x);
    // A finger at the yaw φ sees the obstacle at the offset bearing − φ, and both signs of an offset are alike.
    for [lo, hi] in blocked_offsets(finger, distance, rho) {
        if lo <= 0.0 {
            fold(&mut yaws, bearing - hi, 2.0 * hi, period);
        } else {
            fold(&mut yaws, bearing - hi, hi - lo, period);
            fold(&mut yaws, bearing + lo, hi - lo, period);
        }
    }
    yaws
}

/// Add the arc that begins at `start` and is `length` long, modulo the period.
fn fold(yaws: &mut Intervals, start: f64, length: f64, period: f64) {
    if length >= period {
        yaws.push([0.0, period]);
        return;
    }
    let start = start.rem_euclid(period).min(period);
    let end = start + length;
    yaws.push([start, end.min(period)]);
    if end > period {
        yaws.push([0.0, end - period]);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The rule as stated: some finger is nearer to the obstacle's centre than ρ.
    fn depth(finger: &Finger, fingers: u32, obstacle: Vector2<f64>, rho: f64, yaw: f64) -> f64 {
        let period = core::f64::consts::TAU / f64::from(fingers);
        (0..fingers)
            .map(|m| {
                let (sin, cos) = libm::sincos(-(yaw + f64::from(m) * period));
                let (x, y) = (cos * obstacle.x - sin * obstacle.y, sin * obstacle.x + cos * obstacle.y);
                let along = (finger.inner - x).max(x - finger.outer).max(0.0);
                let across = (y.abs() - finger.half).max(0.0);
                rho - (along * along + across * across).sqrt()
            })
            .fold(f64::NEG_INFINITY, f64::max)
    }

    fn agrees(finger: &Finger, fingers: u32, obstacle: Vector2<f64>, rho: f64) -> Result<(), TestCaseError> {
        let period = core::f64::consts::TAU / f64::from(fingers);
        let yaws = blocked_yaws(finger, period, obstacle, rho);
        for step in 0..720 {
            let yaw = period * (f64::from(step) + 0.37) / 720.0;
            let depth = depth(finger, fingers, obstacle, rho, yaw);
            // Within rounding of the edge, both answers are right.
            if depth.abs() > 1e-12 * (rho + obstacle.norm()) {
                let blocked = yaws.iter().any(|[lo, hi]| (*lo..=*hi).contains(&yaw));
                prop_assert_eq!(blocked, depth > 0.0, "yaw {} depth {} yaws {:?}", yaw, depth, yaws);
            }
        }
        Ok(())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn the_intervals_are_what_sampling_finds(
            fingers in 2_u32..=12, radius_log in -3.0..0.0_f64, obstacle_log in -3.0..0.0_f64,
            width in 0.0001..0.3_f64, clearance in 0.0001..0.5_f64, share in 0.0..1.1_f64, bearing in -3.2..3.2_f64,
        ) {
            let (radius, rho) = (libm::pow(10.0, radius_log), libm::pow(10.0, obstacle_log));
            let finger = Finger { inner: radius, outer: radius + clearance, half: width / 2.0 };
            let distance = share * (finger.corner_distance() + rho);
            let obstacle = distance * Vector2::new(libm::cos(bearing), libm::sin(bearing));
            agrees(&finger, fingers, obstacle, rho)?;
        }

        #[test]
        fn a_small_disc_before_the_tip_leaves_the_tip_free(
            fingers in 2_u32..=12, rho in 0.001..0.01_f64, beyond in 0.0..1.2_f64, bearing in -3.2..3.2_f64,
        ) {
            let finger = Finger { inner: 0.1, outer: 0.15, half: 0.05 };
            let tip = finger.outer + rho;
            let distance = tip + beyond * (finger.corner_distance() + rho - tip);
            agrees(&finger, fingers, distance * Vector2::new(libm::cos(bearing), libm::sin(bearing)), rho)?;
        }
    }

    #[test]
    fn an_obstacle_out_of_reach_or_all_round_is_told_apart() {
        let finger = Finger { inner: 0.1, outer: 0.15, half: 0.01 };
        assert!(blocked_yaws(&finger, 2.0, Vector2::new(0.3, 0.0), 0.1).is_empty());
        assert_eq!(blocked_yaws(&finger, 2.0, Vector2::new(0.05, 0.0), 0.2).as_slice(), [[0.0, 2.0]]);
        assert_eq!(blocked_yaws(&finger, 2.0, Vector2::zeros(), 0.2).as_slice(), [[0.0, 2.0]]);
    }
}
