//! One finger against an obstacle with a core, exactly: the turns of the finger at which it comes too near.
//!
//! While the finger turns about the gripper's axis, whether it comes nearer to the core than ρ can only change where a vertex of
//! the core meets the outline of the finger grown by ρ, or a corner of the finger meets an edge of the core grown by ρ. Each such
//! turn is a closed form. Between two of them nothing changes, so one distance in the middle decides.

use core::f64::consts::{PI, TAU};

use nalgebra::Vector2;
use smallvec::SmallVec;

use super::finger::{BlockedOffsets, SweptRectangle};
use crate::scene::{Core, direction, length};

type Turns = SmallVec<[f64; 24]>;

/// The turns from the direction +x, as intervals (lo, hi) of at most 2π, at which the finger comes nearer than `rho` ≥ 0 (m) to a
/// core that is given relative to the gripper's axis.
pub(super) fn blocked_turns(finger: &SweptRectangle, core: &Core, rho: f64) -> SmallVec<[(f64, f64); 4]> {
    let mut cuts: Turns = cuts(finger, core, rho).into_iter().map(|turn| turn - TAU * (turn / TAU).floor()).collect();
    cuts.sort_unstable_by(f64::total_cmp);
    let Some(&first) = cuts.first() else {
        return if meets(finger, core, rho, 0.0) { SmallVec::from_slice(&[(0.0, TAU)]) } else { SmallVec::new() };
    };
    cuts.push(first + TAU);
    let mut blocked: SmallVec<[(f64, f64); 4]> = SmallVec::new();
    for piece in cuts.windows(2) {
        let (lo, hi) = (piece[0], piece[1]);
        if lo < hi && meets(finger, core, rho, f64::midpoint(lo, hi)) {
            match blocked.last_mut() {
                Some(last) if last.1 >= lo => last.1 = hi,
                _ => blocked.push((lo, hi)),
            }
        }
    }
    blocked
}

/// True if the finger comes nearer than `rho` (m) at some turn of at most `band` (rad) either way. The core is given relative to
/// the gripper's axis with the finger along +x; `None` stands for a point at `at`.
pub(super) fn meets_within(
    finger: &SweptRectangle,
    core: Option<&Core>,
    at: Vector2<f64>,
    rho: f64,
    band: f64,
) -> bool {
    let Some(core) = core else { return point_meets_within(finger, at, rho, band) };
    let [min, max] = sides(finger);
    let room = core.distance_to_box(min, max) - rho;
    // No point of the finger moves farther than its corner.
    if room < 0.0 || band == 0.0 || room >= finger.corner_distance() * band {
        return room < 0.0;
    }
    let within = |turn: f64| Some(turn - TAU * (turn / TAU).round()).filter(|turn| turn.abs() < band);
    let mut cuts: Turns = cuts(finger, core, rho).into_iter().filter_map(within).collect();
    cuts.extend([-band, band]);
    cuts.sort_unstable_by(f64::total_cmp);
    cuts.windows(2).any(|piece| piece[0] < piece[1] && meets(finger, core, rho, f64::midpoint(piece[0], piece[1])))
        || [-band, band].into_iter().any(|end| meets(finger, core, rho, end))
}

/// The same for a point.
fn point_meets_within(finger: &SweptRectangle, at: Vector2<f64>, rho: f64, band: f64) -> bool {
    let away = length(at);
    if away == 0.0 {
        return finger.inner < rho;
    }
    let (first, last) = match finger.blocked_offsets(away, rho) {
        BlockedOffsets::Clear => return false,
        BlockedOffsets::Every => return true,
        BlockedOffsets::Between { first, last } => (first, last),
    };
    let bearing = libm::atan2(at.y, at.x);
    // The offsets that come about, mirrored to positive ones.
    let (least, most) = ((bearing.abs() - band).max(0.0), (bearing.abs() + band).min(PI));
    least < last && (first < most || first == 0.0)
}

/// True if the finger comes nearer than `rho` (m) once it has turned.
fn meets(finger: &SweptRectangle, core: &Core, rho: f64, turn: f64) -> bool {
    let [min, max] = sides(finger);
    core.turned(direction(-turn)).box_comes_within(min, max, rho)
}

fn sides(finger: &SweptRectangle) -> [Vector2<f64>; 2] {
    [Vector2::new(finger.inner, -finger.half_width), Vector2::new(finger.outer, finger.half_width)]
}

/// All turns at which the answer can change, in no order.
fn cuts(finger: &SweptRectangle, core: &Core, rho: f64) -> Turns {
    let mut cuts = Turns::new();
    for vertex in core.vertices() {
        if let BlockedOffsets::Between { first, last } = finger.blocked_offsets(length(*vertex), rho) {
            let bearing = libm::atan2(vertex.y, vertex.x);
            cuts.extend([bearing - last, bearing + last]);
            if first > 0.0 {
                cuts.extend([bearing - first, bearing + first]);
            }
        }
    }
    let half = finger.half_width;
    let corners = [finger.inner, finger.outer].map(|x| (length(Vector2::new(x, half)), libm::atan2(half, x)));
    for [start, end] in core.edges() {
        edge_cuts(start, end, rho, corners, &mut cuts);
    }
    cuts
}

/// The turns at which a corner of the finger, at (distance, ± bearing), meets the edge moved outwards by `rho`.
fn edge_cuts(start: Vector2<f64>, end: Vector2<f64>, rho: f64, corners: [(f64, f64); 2], cuts: &mut Turns) {
    let along = end - start;
    let along = along / length(along);
    let normal = Vector2::new(along.y, -along.x);
    let offset = normal.dot(&start) + rho;
    let (from, to) = (along.dot(&start), along.dot(&end));
    for (away, bearing) in corners {
        let square = (away - offset) * (away + offset);
        if square < 0.0 {
            continue;
        }
        for along in [square.sqrt(), -square.sqrt()] {
            // A little beyond the ends: there a vertex cuts nearby, and one cut too many does no harm.
            let slack = 1e-9 * (away + 1e-3);
            if (from - slack..=to + slack).contains(&along) {
                // Where the corner is then, seen along the normal; the edge's own direction is a quarter turn ahead of it.
                let towards = libm::atan2(normal.y, normal.x) + libm::atan2(along, offset);
                cuts.extend([towards - bearing, towards + bearing]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]

        #[test]
        fn a_band_is_met_exactly_when_some_turn_of_it_is(
            points in proptest::collection::vec((-0.2..0.2_f64, -0.2..0.2_f64), 3..9),
            (away, bearing) in (0.0..0.5_f64, 0.0..TAU), band in 0.0..1.5_f64,
            (inner, clearance, half_width) in (0.0..0.1_f64, 0.005..0.1_f64, 0.002..0.05_f64),
        ) {
            let points: Vec<Vector2<f64>> = points.into_iter().map(|(x, y)| Vector2::new(x, y)).collect();
            let Some(core) = Core::hull(&points) else { return Ok(()) };
            let core = core.moved(Vector2::new(away * libm::cos(bearing), away * libm::sin(bearing)));
            let finger = SweptRectangle { inner, outer: inner + clearance, half_width };
            let [min, max] = sides(&finger);
            let samples = 400;
            let room = |sample: u32| {
                let turn = band * (2.0 * f64::from(sample) / f64::from(samples) - 1.0);
                core.turned(direction(-turn)).distance_to_box(min, max)
            };
            let least = (0..=samples).map(room).fold(f64::INFINITY, f64::min);
            // Between two samples no point of the finger moves farther than this.
            let coarse = finger.corner_distance() * band / f64::from(samples);
            let met = |rho: f64| meets_within(&finger, Some(&core), Vector2::zeros(), rho, band);
            // Just nearer than allowed at one turn, and nowhere.
            prop_assert!(met(least.max(0.0) + 1e-7), "{least}");
            prop_assert!(least < coarse || !met(least - coarse), "{least} {coarse}");
        }
    }
}
