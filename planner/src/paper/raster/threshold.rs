//! Eq. 7: the part of the disc that must be white.

use core::f64::consts::PI;

/// The value of a place whose mask is all white.
pub(super) const WHITE: f64 = 255.0;

/// Eq. 7 as printed, 0 to 255: 255·(1 − 2θ/360 + sin θ/π) with the smaller of θ_g and θ_k for θ. `radius` and
/// `clearance` (r_g) in m, `period` is θ_k = 2π/k.
///
/// "The angle from the center of the circle when it overlaps by r_g" (θ_g) is read off the formula: the part that it
/// subtracts, (θ − sin θ)/π of the disc, is the lens of two equal circles, and in a lens r_g wide each of the two
/// segments is r_g/2 high. For the paper's gripper and objects (r = 0.075, r_g = 0.05) θ_g is 96.4°, the threshold
/// 199.1, and 22 % of the disc may be black: objects of one size then stay 4 mm apart by Eq. 7 alone. Smaller ones next
/// to larger ones may not; hence the separate test against other objects.
///
/// Read as the angle of one segment of height r_g, θ_g would be 141.1°, and Eq. 7 alone would let the paper's objects
/// overlap by 19 mm, against its own words.
pub(super) fn threshold(radius: f64, clearance: f64, period: f64) -> f64 {
    let angle = segment_angle(radius, clearance / 2.0).min(period);
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
        // θ_g = 96.38°; 60° for six fingers.
        check((0.075, 0.05, 3.0), 199.12898045865282);
        check((0.075, 0.05, 2.0), 199.12898045865282);
        check((0.075, 0.05, 6.0), 240.294_434_166_278_48);
        // Segments of half the disc, and higher ones.
        check((0.05, 0.1, 2.0), 0.0);
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
    fn the_threshold_keeps_equal_discs_apart() {
        let (radius, clearance) = (0.075, 0.05);
        let most = 1.0 - threshold(radius, clearance, TAU / 3.0) / WHITE;
        let at = |gap: f64| covered(radius, radius + clearance, 2.0 * radius + gap);
        assert!(at(0.0032) > most && most > at(0.0042), "{most}");
    }
}
