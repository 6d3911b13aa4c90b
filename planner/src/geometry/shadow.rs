//! How one obstacle hinders the grasps of an object.

use nalgebra::{Point2, Vector2};

use super::arcs::ArcSet;
use super::finger::{BlockedOffsets, SweptRectangle};
use super::turns::{blocked_turns, meets_within};
use crate::scene::{Footprint, Grasps, Gripper, ListedGrasp, Placed, direction, distance, turned};

/// The grasps of an object that an obstacle blocks.
#[derive(Debug, Clone, PartialEq)]
pub enum Shadow {
    /// Of an object that may be grasped at every yaw: the blocked ones.
    Yaws(ArcSet),
    /// Of an object with listed grasps: a bit for each that is blocked.
    Grasps(u64),
}

impl Shadow {
    /// True if no grasp is blocked.
    pub fn is_empty(&self) -> bool {
        match self {
            Self::Yaws(yaws) => yaws.is_empty(),
            Self::Grasps(blocked) => *blocked == 0,
        }
    }

    /// What many obstacles block together of the grasps of one object.
    pub fn union<'a>(gripper: &Gripper, grasps: &Grasps, shadows: impl IntoIterator<Item = &'a Self>) -> Self {
        let shadows = shadows.into_iter();
        match grasps {
            Grasps::EveryYaw => Self::Yaws(ArcSet::union(gripper.period(), shadows.filter_map(Self::yaws))),
            Grasps::Listed(_) => Self::Grasps(shadows.map(Self::grasps).fold(0, |all, some| all | some)),
        }
    }

    /// The blocked yaws of an object that may be grasped at every yaw.
    pub fn yaws(&self) -> Option<&ArcSet> {
        match self {
            Self::Yaws(yaws) => Some(yaws),
            Self::Grasps(_) => None,
        }
    }

    /// A bit for each listed grasp that is blocked.
    pub fn grasps(&self) -> u64 {
        match self {
            Self::Yaws(_) => 0,
            Self::Grasps(blocked) => *blocked,
        }
    }
}

/// How much nearer than allowed an obstacle may come to the fingers of a listed grasp, or to the palm, m: rounding, so that what
/// touches in decimals does not block. Below the checker's tolerance.
const ROUNDING: f64 = 1e-10;

/// The shadow of an obstacle by the swept finger model, when fingers and palm must stay the gripper's margin plus `extra` (m)
/// away from it.
pub fn shadow(gripper: &Gripper, grasped: Placed<'_>, obstacle: Placed<'_>, extra: f64) -> Shadow {
    let hindered = Hindered {
        gripper,
        grasped: grasped.footprint,
        obstacle: obstacle.footprint,
        fingers: (!grasped.object.fingers_pass_over(obstacle.object, gripper))
            .then(|| obstacle.footprint.radius() + gripper.margin() + extra),
        palm: grasped.object.palm_distance(obstacle.object, gripper).map(|distance| distance + extra - ROUNDING),
    };
    match grasped.object.grasps() {
        Grasps::EveryYaw => Shadow::Yaws(hindered.yaws()),
        Grasps::Listed(list) => {
            let blocked = |(at, grasp)| u64::from(hindered.blocks(grasp)) << at;
            Shadow::Grasps(list.iter().enumerate().map(blocked).fold(0, |all, one| all | one))
        }
    }
}

/// One obstacle and the distances from it that are to be kept.
struct Hindered<'a> {
    gripper: &'a Gripper,
    grasped: &'a Footprint,
    obstacle: &'a Footprint,
    /// From the fingers to its core, m; `None` if they pass over it.
    fingers: Option<f64>,
    /// From the gripper's axis to its edge, m; `None` if the palm passes over it.
    palm: Option<f64>,
}

impl Hindered<'_> {
    fn meets_palm(&self, axis: Point2<f64>) -> bool {
        self.palm.is_some_and(|distance| self.obstacle.comes_within(axis, distance))
    }

    /// The blocked yaws. The k fingers are 2π/k apart, so modulo that period one finger's shadow is the gripper's.
    fn yaws(&self) -> ArcSet {
        let (gripper, period) = (self.gripper, self.gripper.period());
        if self.meets_palm(self.grasped.at()) {
            return ArcSet::full(period);
        }
        let Some(rho) = self.fingers else { return ArcSet::empty(period) };
        let finger = SweptRectangle {
            inner: self.grasped.circumradius(),
            outer: gripper.outer_distance(self.grasped),
            half_width: gripper.finger_width() / 2.0,
        };
        match self.obstacle.core() {
            None => disc_shadow(&finger, self.grasped.at(), self.obstacle.at(), rho, period),
            Some(core) => {
                let core = core.moved(self.obstacle.at() - self.grasped.at());
                ArcSet::fold(period, &blocked_turns(&finger, &core, rho))
            }
        }
    }

    /// True if a listed grasp is blocked at some yaw of its band.
    fn blocks(&self, grasp: &ListedGrasp) -> bool {
        let pose = self.grasped.pose();
        let axis = pose.point(grasp.at());
        if self.meets_palm(axis) {
            return true;
        }
        let Some(rho) = self.fingers.map(|rho| rho - ROUNDING) else { return false };
        if !self.obstacle.comes_within(axis, grasp.corner_distance() + rho - self.obstacle.radius()) {
            return false;
        }
        let (band, towards) = (grasp.band(), self.obstacle.at() - axis);
        grasp.inner().iter().zip(0_u32..).any(|(&inner, finger)| {
            let rectangle =
                SweptRectangle { inner, outer: grasp.outer(), half_width: self.gripper.finger_width() / 2.0 };
            let back = direction(-(pose.yaw + grasp.yaw() + f64::from(finger) * self.gripper.period()));
            let towards: Vector2<f64> = turned(towards, back);
            let core = self.obstacle.core().map(|core| core.turned(back).moved(towards));
            meets_within(&rectangle, core.as_ref(), towards, rho, band)
        })
    }
}

/// The yaws that a disc blocks, in closed form.
fn disc_shadow(finger: &SweptRectangle, grasped: Point2<f64>, obstacle: Point2<f64>, rho: f64, period: f64) -> ArcSet {
    match finger.blocked_offsets(distance(grasped, obstacle), rho) {
        BlockedOffsets::Clear => ArcSet::empty(period),
        BlockedOffsets::Every => ArcSet::full(period),
        BlockedOffsets::Between { first, last } => {
            let towards = obstacle - grasped;
            let bearing = libm::atan2(towards.y, towards.x);
            if first > 0.0 {
                ArcSet::fold(period, &[(bearing - last, bearing - first), (bearing + first, bearing + last)])
            } else {
                ArcSet::fold(period, &[(bearing - last, bearing + last)])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use nalgebra::{Point2, Rotation2};
    use proptest::prelude::*;

    use super::*;
    use crate::scene::{
        GoalDraft, GripperDraft, ObjectDraft, RectangleDraft, Scene, SceneDraft, SceneLimits, ShapeDraft, TableDraft,
    };

    fn gripper(fingers: u32, finger_width: f64, clearance: f64, margin: f64) -> Gripper {
        let side = |at: f64| Some(at);
        let top = RectangleDraft { x_min: side(-9.0), y_min: side(-9.0), x_max: side(9.0), y_max: side(9.0) };
        let shape = ShapeDraft::disc(1.0);
        let only = ObjectDraft { id: Some("a".into()), x: side(0.0), y: side(0.0), shape, ..ObjectDraft::default() };
        let gripper = GripperDraft {
            fingers: Some(fingers.into()),
            finger_width: Some(finger_width),
            clearance: Some(clearance),
            margin: Some(margin),
            yaw_tolerance: Some(0.0),
            ..GripperDraft::default()
        };
        let table = TableDraft { top, keep_out: vec![] };
        let goal = Some(GoalDraft::Target("a".into()));
        let draft = SceneDraft { table, gripper, objects: vec![only], goal, ..SceneDraft::default() };
        *Scene::new(draft, &SceneLimits::default()).expect("a sound scene").0.gripper()
    }

    /// How far the obstacle's edge is from the nearest finger, beyond the margin, m: the definition, finger by finger.
    fn room(gripper: &Gripper, grasped: &Footprint, obstacle: &Footprint, yaw: f64) -> f64 {
        let (inner, outer) = (grasped.circumradius(), grasped.circumradius() + gripper.clearance());
        (0..gripper.fingers())
            .map(|finger| {
                let turn = Rotation2::new(-(yaw + TAU * f64::from(finger) / f64::from(gripper.fingers())));
                let at = turn * (obstacle.at() - grasped.at());
                let dx = (inner - at.x).max(at.x - outer).max(0.0);
                let dy = (at.y.abs() - gripper.finger_width() / 2.0).max(0.0);
                (dx * dx + dy * dy).sqrt() - obstacle.circumradius() - gripper.margin()
            })
            .fold(f64::INFINITY, f64::min)
    }

    /// From 1 mm to 1 m, evenly in every order of magnitude.
    fn length() -> impl Strategy<Value = f64> {
        (-3.0..0.0_f64).prop_map(|exponent| libm::pow(10.0, exponent))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1500))]

        #[test]
        fn a_yaw_is_in_the_shadow_exactly_when_some_finger_meets_the_obstacle(
            fingers in 2_u32..=12,
            (radius, obstacle_radius, finger_width, clearance) in (length(), length(), length(), length()),
            margin in prop_oneof![Just(0.0), length()],
            (away, bearing) in (0.0..1.1_f64, 0.0..TAU),
            (x, y) in (-5.0..5.0_f64, -5.0..5.0_f64),
        ) {
            let gripper = gripper(fingers, finger_width, clearance, margin);
            let grasped = Footprint::disc(Point2::new(x, y), radius);
            // From touching to just out of reach.
            let (near, far) = (radius, gripper.corner_distance(&grasped) + margin);
            let apart = obstacle_radius + near + away * (far - near);
            let towards = Rotation2::new(bearing) * nalgebra::Vector2::new(apart, 0.0);
            let obstacle = Footprint::disc(grasped.at() + towards, obstacle_radius);
            let (fingers_keep, palm) = (Some(obstacle.radius() + gripper.margin()), None);
            let (grasped, obstacle) = (&grasped, &obstacle);
            let hindered = Hindered { gripper: &gripper, grasped, obstacle, fingers: fingers_keep, palm };
            let shadow = hindered.yaws();
            for step in 0..1440 {
                let yaw = TAU * f64::from(step) / 1440.0;
                let room = room(&gripper, grasped, obstacle, yaw);
                let folded = super::super::arcs::wrap(yaw, gripper.period());
                let says = shadow.arcs().iter().any(|arc| arc.lo < folded && folded < arc.hi);
                // A full shadow is closed at the turn's seam.
                prop_assert!(
                    room.abs() < 1e-9 || says == (room < 0.0) || shadow.is_full() && room < 0.0
                        || (folded.min(gripper.period() - folded) < 1e-9),
                    "yaw {yaw} room {room} {shadow:?}"
                );
            }
        }
    }
}
