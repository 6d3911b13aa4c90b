//! Eq. 7: how much of the disc must be white.

use core::f64::consts::PI;

/// The value of a place under which all is white.
pub(super) const WHITE: f64 = 255.0;

/// Eq. 7 as printed, 0 to 255: 255·(1 − 2θ/360 + sin θ/π) with the smaller of θ_g and θ_k for θ. `radius` and `clearance`
/// (r_g) in m, `period` is θ_k = 2π/k.
///
/// "The angle from the center of the circle when it overlaps by r_g" (θ_g) is read as the central angle of the segment of
/// height r_g. For the paper's gripper and objects (r = 0.075, r_g = 0.05) that is 141.1°, so with k = 3 it is θ_k that
/// counts: the threshold is 155.3, and 39 % of the disc may be black. That alone would let an object overlap another of its
/// size by 19 mm, and by 43 mm with k = 2 (threshold 106.2); where they touch, 24 % are black. Hence the separate look at
/// what stands there.
///
/// There is another reading: what the formula takes off, (θ − sin θ)/π of the disc, is twice the segment, which is the lens
/// of two equal circles; in a lens r_g wide each segment is r_g/2 high. θ_g would be 96.4°, the threshold 199.1, the most
/// 22 %, and the paper's objects would stay 4 mm apart by Eq. 7 alone.
pub(super) fn threshold(radius: f64, clearance: f64, period: f64) -> f64 {
    let angle = segment_angle(radius, clearance).min(period);
    WHITE * (1.0 - angle / PI + libm::sin(angle) / PI)
}

/// The central angle of a segment of this height, rad. From half a disc on π, which no θ_k exceeds.
fn segment_angle(radius: f64, height: f64) -> f64 {
    // 2·acos(1 − h/r), without the loss of digits where h is small.
    4.0 * libm::asin((height / radius / 2.0).min(0.5).sqrt())
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::*;

    #[track_caller]
    fn check((radius, clearance, fingers): (f64, f64, f64), expected: f64) {
        let threshold = threshold(radius, clearance, TAU / fingers);
        assert!((threshold - expected).abs() < 1e-9, "{threshold}");
    }

    #[test]
    fn the_threshold_is_that_of_the_printed_formula() {
        // 255·(1 − 2·120/360 + sin 120°/π), and θ_g = 141.06° for two fingers.
        check((0.075, 0.05, 3.0), 155.294_434_166_277_6);
        check((0.075, 0.05, 2.0), 106.186_383_046_626_28);
        check((0.075, 0.05, 6.0), 240.294_434_166_278_48);
        // A segment of half the disc, and what is higher than that.
        check((0.05, 0.05, 2.0), 0.0);
        check((0.05, 0.5, 2.0), 0.0);
        // Next to no clearance: next to nothing may be black.
        check((1e3, 1e-6, 2.0), 255.0);
        assert!(threshold(1e3, 1e-6, TAU / 2.0) < 255.0);
    }

    /// How much of a disc a larger one covers, 0 to 1, when their centres are `apart`: two segments.
    fn covered(radius: f64, larger: f64, apart: f64) -> f64 {
        let segment = |own: f64, other: f64| {
            let half = libm::acos((apart * apart + own * own - other * other) / (2.0 * apart * own));
            own * own * (half - libm::sin(2.0 * half) / 2.0)
        };
        (segment(radius, larger) + segment(larger, radius)) / (PI * radius * radius)
    }

    #[test]
    fn the_threshold_alone_lets_equal_discs_overlap() {
        let (radius, clearance) = (0.075, 0.05);
        for (fingers, overlap) in [(3.0, 0.019), (2.0, 0.043)] {
            let most = 1.0 - threshold(radius, clearance, TAU / fingers) / WHITE;
            let at = |overlap: f64| covered(radius, radius + clearance, 2.0 * radius - overlap);
            assert!(at(overlap - 0.0005) < most && most < at(overlap + 0.0005), "{fingers} fingers");
            assert!((at(0.0) - 0.245).abs() < 1e-4);
        }
    }
}
