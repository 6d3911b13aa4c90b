//! A gripper over a place: its axis, its fingers, and the band of yaws at which they must be free.

use nalgebra::{Point2, Vector2};
use smallvec::SmallVec;

use crate::scene::{Gripper, ListedGrasp, Opening, Shape};

use super::TOLERANCE;
use super::body::Body;
use super::finger::{Finger, wrap};
use super::leaning::Leaning;
use super::stop::Grasped;
use super::sweep::Sweep;

/// A listed grasp, with what the checker finds out about it, in the object's own frame.
pub(super) struct Hold {
    axis: Vector2<f64>,
    yaw: f64,
    band: f64,
    fingers: SmallVec<[Finger; 4]>,
    /// True if the hand does not open as wide.
    pub(super) too_wide: bool,
}

/// Fingers over a place on the table.
pub(super) struct Grip {
    /// The gripper's axis.
    pub(super) axis: Point2<f64>,
    /// The direction of finger 0, rad.
    pub(super) yaw: f64,
    /// How far the yaw may be off, rad.
    pub(super) band: f64,
    fingers: SmallVec<[Finger; 4]>,
    period: f64,
}

/// How far the real yaw of a listed grasp may be off, rad.
pub(super) fn band_of(grasp: &ListedGrasp, gripper: &Gripper) -> f64 {
    grasp.tolerance().max(gripper.yaw_tolerance())
}

/// True if the hand does not open wide enough for the grasp. Where that is a matter of rounding, it is as the claim needs it.
pub(super) fn is_too_wide(shape: &Shape, grasp: &ListedGrasp, gripper: &Gripper, leaning: Leaning) -> bool {
    let Some(opening) = gripper.max_opening() else { return false };
    let grasped = Grasped::new(shape, grasp.at());
    let exceeds = |width: f64| leaning.out(width) > opening / 2.0;
    exceeds(grasped.extent()) && exceeds(widest(&grasped, grasp, gripper, leaning))
}

/// How far from the axis a finger stops at most, m, in favour of the claim.
fn widest(grasped: &Grasped, grasp: &ListedGrasp, gripper: &Gripper, leaning: Leaning) -> f64 {
    let half = leaning.out(gripper.finger_width() / 2.0);
    let most = |finger| grasped.most((yaw_of(grasp, gripper, finger), band_of(grasp, gripper)), half);
    (0..gripper.fingers()).map(most).fold(0.0, f64::max)
}

/// The direction of a finger in the object's own frame, rad.
fn yaw_of(grasp: &ListedGrasp, gripper: &Gripper, finger: u32) -> f64 {
    grasp.yaw() + f64::from(finger) * gripper.period()
}

/// What it takes to find out where the fingers close in a grasp, in units of work: few turns where the band is narrow.
pub(super) fn work(grasp: &ListedGrasp, shape: &Shape, gripper: &Gripper) -> usize {
    let corners = shape.core().map_or(1, |core| core.vertices().len());
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a band is at most π")]
    let turns = 1 + (band_of(grasp, gripper) * corners as f64) as usize;
    1 + gripper.fingers() as usize * corners * turns / 2
}

impl Hold {
    /// Finds out how far the fingers close and open, in favour of the claim.
    pub(super) fn new(shape: &Shape, grasp: &ListedGrasp, gripper: &Gripper, leaning: Leaning) -> Self {
        let grasped = Grasped::new(shape, grasp.at());
        let widest = widest(&grasped, grasp, gripper, leaning);
        let open = match (gripper.opening(), gripper.max_opening()) {
            (Opening::Full, Some(opening)) => opening / 2.0,
            _ => widest,
        };
        let (outer, half) = (open + gripper.clearance(), gripper.finger_width() / 2.0);
        let (band, strip) = (band_of(grasp, gripper), leaning.back(half));
        let turns = grasped.turns(strip);
        let finger = |finger| {
            let inner = grasped.least((yaw_of(grasp, gripper, finger), band), strip, &turns);
            // Where only leaning lets the finger stop farther out than it opens, there is nothing to close.
            Finger { inner: inner.min(outer), outer, half }
        };
        let too_wide = gripper.max_opening().is_some_and(|opening| leaning.out(widest) > opening / 2.0);
        let fingers = (0..gripper.fingers()).map(finger).collect();
        Self { axis: grasp.at(), yaw: grasp.yaw(), band, fingers, too_wide }
    }

    /// The grasp of an object where it stands.
    pub(super) fn of(self, body: &Body, gripper: &Gripper) -> Grip {
        let Self { axis, yaw, band, fingers, .. } = self;
        let (axis, yaw) = (body.point(axis), body.pose.yaw + yaw);
        Grip { axis, yaw, band, fingers, period: gripper.period() }
    }
}

impl Grip {
    /// A grasp of a disc over its centre.
    pub(super) fn centred(disc: &Body, gripper: &Gripper, (yaw, band): (f64, f64)) -> Self {
        let finger = Finger::new(gripper, disc);
        let fingers = (0..gripper.fingers()).map(|_| finger).collect();
        Self { axis: disc.pose.at, yaw, band, fingers, period: gripper.period() }
    }

    /// From the axis to the fingers' farthest corners, m.
    pub(super) fn span(&self) -> f64 {
        self.fingers.iter().map(Finger::corner_distance).fold(0.0, f64::max)
    }

    /// True if a finger comes nearer than `rho` to the obstacle's core at some yaw of the band.
    pub(super) fn comes_near(&self, obstacle: &Body, rho: f64) -> bool {
        if obstacle.is_disc() {
            return self.closest(obstacle) < rho;
        }
        self.sweeps(obstacle).any(|mut sweep| sweep.comes_near(2.0 * self.band, rho))
    }

    /// How much nearer than the margin an obstacle comes to the fingers, m, if that is more than rounding.
    pub(super) fn depth(&self, obstacle: &Body, margin: f64) -> Option<f64> {
        let rho = obstacle.radius + margin;
        if obstacle.is_disc() {
            return Some(rho - self.closest(obstacle)).filter(|depth| *depth > TOLERANCE);
        }
        self.comes_near(obstacle, rho - TOLERANCE).then(|| {
            let nearest = self.sweeps(obstacle).map(|mut sweep| sweep.nearest(2.0 * self.band));
            (rho - nearest.fold(f64::INFINITY, f64::min)).max(TOLERANCE)
        })
    }

    /// The least distance from a finger to the centre of a disc, m.
    fn closest(&self, disc: &Body) -> f64 {
        let apart = disc.pose.at - self.axis;
        let (distance, bearing) = (apart.norm(), libm::atan2(apart.y, apart.x));
        let closest = |(at, finger): (u32, &Finger)| {
            let offset = wrap(bearing - self.yaw - f64::from(at) * self.period);
            finger.closest(distance, offset, self.band)
        };
        (0..).zip(&self.fingers).map(closest).fold(f64::INFINITY, f64::min)
    }

    /// Each finger from the begin of the band on.
    fn sweeps<'a>(&'a self, obstacle: &'a Body) -> impl Iterator<Item = Sweep<'a>> + 'a {
        (0..).zip(&self.fingers).map(|(at, finger)| {
            let begin = self.yaw + f64::from(at) * self.period - self.band;
            Sweep::new(finger, self.axis, begin, obstacle)
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::check::body::{Side, cos_sin};
    use crate::check::measure::gap;
    use crate::check::shapes::{any_footprint, at};
    use crate::scene::scenes::TestScene;
    use crate::scene::{Core, Footprint, GraspDraft, ObjectDraft, Pose, Scene, ShapeDraft};

    /// A scene with an object of this shape that is grasped only in this way.
    fn grasped(shape: &Footprint, fingers: u32, grasp: (f64, f64, f64, f64)) -> Scene {
        let (x, y, yaw, tolerance) = grasp;
        let grasps = vec![GraspDraft { x: Some(x), y: Some(y), yaw: Some(yaw), tolerance: Some(tolerance) }];
        let object =
            ObjectDraft { id: Some("o".into()), x: Some(1.0), y: Some(1.0), grasps: Some(grasps), ..draft(shape) };
        TestScene::new(fingers).object(object).build("o")
    }

    fn draft(shape: &Footprint) -> ObjectDraft {
        let points = |core: &Core| core.vertices().iter().map(|v| [Some(v.x), Some(v.y)]).collect();
        let shape = match shape.shape().core() {
            Some(core) if core.vertices().len() > 2 => {
                ShapeDraft::Polygon { points: points(core), corner_radius: Some(shape.radius()) }
            }
            Some(core) => ShapeDraft::Capsule {
                length: Some(2.0 * core.vertices()[0].norm() + 2.0 * shape.radius()),
                radius: Some(shape.radius()),
            },
            None => ShapeDraft::disc(shape.radius()),
        };
        ObjectDraft { shape, ..ObjectDraft::default() }
    }

    /// The finger at a yaw as a body over the axis.
    fn turned(finger: &Finger, axis: Point2<f64>, yaw: f64) -> Body {
        let corners = finger.corners();
        let side = |n: usize| {
            let (start, along) = (corners[n], corners[(n + 1) % 4] - corners[n]);
            Side { start, along: along / along.norm(), length: along.norm() }.rotated(cos_sin(yaw))
        };
        let pose = Pose { at: axis, yaw: 0.0 };
        Body { pose, sides: (0..4).map(side).collect(), radius: 0.0, extent: finger.corner_distance() }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn a_band_is_free_where_every_sampled_yaw_of_every_finger_is(
            fingers in 2_u32..=6, shape in any_footprint(0.05), other in any_footprint(0.05), stands in (-4.0..4.0_f64, 0.0..0.25_f64, -4.0..4.0_f64),
            grasp in (-0.03..0.03_f64, -0.03..0.03_f64, -4.0..4.0_f64, 0.0..0.5_f64), turn in -4.0..4.0_f64,
        ) {
            let scene = grasped(&shape, fingers, grasp);
            let (gripper, object) = (scene.gripper(), &scene.objects()[0]);
            let body = Body::new(object.footprint().shape(), Pose { at: Point2::new(1.0, 1.0), yaw: turn });
            let listed = &object.grasps().listed().unwrap()[0];
            let obstacle = at(&other, [1.0 + stands.1 * libm::cos(stands.0), 1.0 + stands.1 * libm::sin(stands.0), stands.2]);
            let [free, blocked] = [Leaning::Free, Leaning::Blocked].map(|leaning| {
                let grip = Hold::new(object.footprint().shape(), listed, gripper, leaning).of(&body, gripper);
                let comes_near = grip.comes_near(&obstacle, leaning.to_keep(obstacle.radius));
                (grip, !comes_near)
            });
            // What is free by the one leaning is so by the other, and only rounding is between them.
            prop_assert!(free.1 || !blocked.1);
            let samples = 60;
            let (grip, is_free) = blocked;
            let mut nearest = f64::INFINITY;
            for sample in 0..=samples {
                let yaw = grip.yaw + grip.band * (f64::from(sample) / f64::from(samples) * 2.0 - 1.0);
                for (m, finger) in (0..).zip(&grip.fingers) {
                    let finger = turned(finger, grip.axis, yaw + f64::from(m) * gripper.period());
                    nearest = nearest.min(gap(&finger, &obstacle));
                }
            }
            let coarse = grip.span() * grip.band / f64::from(samples);
            prop_assert!(!is_free || nearest >= -1e-12, "free, and {} near", nearest);
            prop_assert!(is_free || nearest < coarse + 1e-11, "blocked, and {} apart", nearest);
        }
    }
}
