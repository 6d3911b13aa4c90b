//! One finger's swept rectangle against one disc, in closed form.
//!
//! The finger of an open gripper sweeps the rectangle [r, R] × [−h, h] in a frame at the grasped object's centre whose
//! x axis points along the finger. A disc blocks it when its centre is nearer to the rectangle than ρ, that is when the
//! centre lies inside the rectangle grown by ρ, a convex shape K with round corners. An obstacle at distance d from the
//! object moves on the circle |p| = d as the gripper turns. Along the upper border of K, from (r − ρ, 0) over the inner
//! edge, inner corner, side and outer corner to (R + ρ, 0), the distance |p| first grows from |r − ρ| to D + ρ (where
//! the normal points away from the origin through the outer corner, D² = R² + h²), then falls to R + ρ. (The clockwise
//! tangent t has p·t ≥ 0 on every piece before that point and ≤ 0 after it.) So the circle crosses the growing part
//! once, at the *last* blocked offset, and for R + ρ < d < D + ρ the falling part once, at the *first*.

/// The rectangle that an open finger sweeps: [`inner`, `outer`] × [−`half_width`, `half_width`], m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SweptRectangle {
    /// Where the closed finger stands: r, the radius of a grasped disc.
    /// 0 where it meets nothing before the axis.
    pub inner: f64,
    /// R, how far out the open fingers stand.
    pub outer: f64,
    /// h = w/2.
    pub half_width: f64,
}

/// The offsets δ between finger and bearing, in [0, π], at which an obstacle blocks the finger.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum BlockedOffsets {
    /// None: the obstacle is out of reach, or wholly inside the object.
    Clear,
    /// All: the obstacle covers the object's centre so far that no turn helps.
    Every,
    /// Those between the two, ends free. `first` is 0 unless the tip clears the obstacle when it points straight at it.
    Between {
        /// The first blocked offset, rad.
        first: f64,
        /// The last blocked offset, rad.
        last: f64,
    },
}

impl SweptRectangle {
    /// From the gripper's axis to the outer corners, m.
    pub(super) fn corner_distance(&self) -> f64 {
        (self.outer * self.outer + self.half_width * self.half_width).sqrt()
    }

    /// The offsets at which a disc whose centre is at `distance` d > 0 blocks, when it must stay `rho` ρ > 0 away (m).
    pub(super) fn blocked_offsets(&self, distance: f64, rho: f64) -> BlockedOffsets {
        let Self { inner: r, outer, half_width: h } = *self;
        if distance >= (outer * outer + h * h).sqrt() + rho || distance <= r - rho {
            BlockedOffsets::Clear
        } else if distance < rho - r {
            BlockedOffsets::Every
        } else {
            BlockedOffsets::Between { first: self.first(distance, rho), last: self.last(distance, rho) }
        }
    }

    /// The offset where the circle crosses the growing part of the border. The piece is chosen by the distances of its
    /// ends, which avoids the rounding of a test on the crossing itself.
    fn last(&self, d: f64, rho: f64) -> f64 {
        let Self { inner: r, outer, half_width: h } = *self;
        let (edge, side, square) = (r - rho, h + rho, d * d);
        if square <= edge * edge + h * h {
            libm::atan2(leg(d, edge), edge)
        } else if square <= r * r + side * side {
            corner(r, h, d, rho).1
        } else if square <= outer * outer + side * side {
            libm::atan2(side, leg(d, side))
        } else {
            corner(outer, h, d, rho).1
        }
    }

    /// The offset where the circle crosses the falling part of the border; 0 where it does not.
    fn first(&self, d: f64, rho: f64) -> f64 {
        let tip = self.outer + rho;
        let h = self.half_width;
        if d <= tip {
            0.0
        } else if d * d <= tip * tip + h * h {
            libm::atan2(leg(d, tip), tip)
        } else {
            corner(self.outer, h, d, rho).0.max(0.0)
        }
    }
}

/// The other leg of a right triangle with hypotenuse `d`. Computed as a product, which loses no digits when the legs
/// differ.
fn leg(d: f64, leg: f64) -> f64 {
    ((d - leg) * (d + leg)).max(0.0).sqrt()
}

/// The two directions in which the circle of radius `d` round the origin meets the circle of radius `rho` round the
/// corner (x, h), nearer to the finger's axis first. Law of cosines, with the half-angle tangent, which keeps its
/// digits where the circles all but touch (acos does not).
fn corner(x: f64, h: f64, d: f64, rho: f64) -> (f64, f64) {
    let to_corner = (x * x + h * h).sqrt();
    let swing = (rho - (d - to_corner)) * (rho + (d - to_corner));
    let rest = (d + to_corner - rho) * (d + to_corner + rho);
    let half = libm::atan2(swing.max(0.0).sqrt(), rest.max(0.0).sqrt());
    let direction = libm::atan2(h, x);
    (direction - 2.0 * half, direction + 2.0 * half)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Distance of the point at (`distance`, `offset`) to the finger's rectangle: the definition, nothing else.
    fn gap(finger: &SweptRectangle, distance: f64, offset: f64) -> f64 {
        let (x, y) = (distance * libm::cos(offset), distance * libm::sin(offset));
        let dx = (finger.inner - x).max(x - finger.outer).max(0.0);
        let dy = (y.abs() - finger.half_width).max(0.0);
        (dx * dx + dy * dy).sqrt()
    }

    fn check(finger: &SweptRectangle, distance: f64, rho: f64) {
        let blocked = finger.blocked_offsets(distance, rho);
        let scale = finger.outer + finger.half_width + distance;
        for step in 0..=2000 {
            let offset = core::f64::consts::PI * f64::from(step) / 2000.0;
            let room = gap(finger, distance, offset) - rho;
            let says = match blocked {
                BlockedOffsets::Clear => false,
                BlockedOffsets::Every => true,
                BlockedOffsets::Between { first, last } => (first..=last).contains(&offset),
            };
            assert!(
                room.abs() < 1e-9 * scale || says == (room < 0.0),
                "{finger:?} d={distance} rho={rho} offset={offset} room={room} {blocked:?}"
            );
        }
    }

    #[test]
    fn every_case_has_its_scene() {
        let finger = SweptRectangle { inner: 0.075, outer: 0.125, half_width: 0.01 };
        let cases = [
            ("side", 0.11, 0.03),
            ("outer corner", 0.16, 0.075),
            ("inner corner", 0.085, 0.03),
            ("inner edge", 0.06, 0.02),
            ("free gap in front of the tip, outer edge", 0.2, 0.074_9),
            ("free gap in front of the tip, outer corner", 0.200_35, 0.075),
            ("a crumb inside the ring", 0.1, 0.002),
            ("a disc that covers every yaw", 0.1, 0.3),
            ("touches the tip", 0.2, 0.075),
            ("touches the corner", (finger.outer * finger.outer + 0.01 * 0.01).sqrt() + 0.075, 0.075),
        ];
        for (_, distance, rho) in cases {
            check(&finger, distance, rho);
        }
    }

    #[test]
    fn a_disc_that_touches_the_fingers_does_not_block() {
        let finger = SweptRectangle { inner: 1.0, outer: 2.0, half_width: 0.0 };
        assert_eq!(finger.blocked_offsets(2.5, 0.5), BlockedOffsets::Clear);
        assert_eq!(finger.blocked_offsets(0.5, 0.5), BlockedOffsets::Clear);
    }

    proptest! {
        #[test]
        fn closed_forms_agree_with_a_sampled_sweep(
            inner in 0.001..1.0_f64,
            clearance in 0.001..0.5_f64,
            half_width in 0.000_5..0.3_f64,
            rho in 0.001..1.0_f64,
            place in 0.0..1.1_f64,
        ) {
            let finger = SweptRectangle { inner, outer: inner + clearance, half_width };
            let farthest = (finger.outer * finger.outer + half_width * half_width).sqrt() + rho;
            check(&finger, (farthest * place).max(1e-6), rho);
        }
    }
}
