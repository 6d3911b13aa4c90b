//! Checks a stated grasp or release: it is one that the object has, and the hand meets no other object.

use core::f64::consts::PI;

use nalgebra::Point2;

use crate::budget::{Interrupted, Ticker};
use crate::scene::{Grasps, ListedGrasp, Object, ObjectIndex, Scene};
use crate::statement::{PickPlace, StatedGrasp};

use super::TOLERANCE;
use super::body::Body;
use super::fault::{FaultCode, Faults, figure, point};
use super::finger::wrap;
use super::grip::{Grip, Hold, band_of, work};
use super::hand::Hand;
use super::leaning::Leaning;
use super::near::{PlaceIndex, Places, Standing};
use super::poses::MAX_YAW;
use super::terms::Terms;

/// A hand about to close round an object, or to let it go, while the others stand on `standing`.
pub(super) struct Grasping<'r, 'a> {
    pub(super) scene: &'a Scene,
    pub(super) places: &'a Places,
    pub(super) standing: &'r Standing,
    pub(super) terms: &'a Terms,
    /// `None` for the final grasp.
    pub(super) step: Option<usize>,
    pub(super) object: ObjectIndex,
    pub(super) faults: &'r mut Faults,
    pub(super) ticker: &'r mut Ticker<'a>,
}

/// The listed grasp by which an object is held: its position in the list.
pub(super) type Held = Option<usize>;

impl<'a> Grasping<'_, 'a> {
    fn stated(&self) -> &'a Object {
        self.scene.object(self.object)
    }

    fn fault(&mut self, code: FaultCode, detail: impl FnOnce() -> String) {
        let id = self.stated().id();
        self.faults.add(code, self.step, Some(id), detail);
    }

    /// How far a stated axis may be off, m.
    fn off_axis(&self) -> f64 {
        TOLERANCE + self.terms.position_tolerance
    }

    /// How far a stated yaw of a listed grasp may be off, rad.
    fn off_yaw(&self, grasp: &ListedGrasp) -> f64 {
        if self.terms.position_tolerance == 0.0 {
            TOLERANCE
        } else {
            band_of(grasp, self.scene.gripper()).max(TOLERANCE)
        }
    }

    /// The grasp of the object where it stands. The result is the listed grasp, if it is one.
    pub(super) fn grasp(&mut self, code: FaultCode, body: &Body, stated: StatedGrasp) -> Result<Held, Interrupted> {
        if !self.resolvable(stated) {
            return Ok(None);
        }
        let Grasps::Listed(list) = self.stated().grasps() else {
            self.centred(code, body, stated)?;
            return Ok(None);
        };
        // Of those that are near enough, the nearest: within a tolerance there may be several.
        let near = (0..list.len()).filter(|&at| self.is(&list[at], body, stated));
        let off = |at: &usize| self.off(&list[*at], body, stated);
        let held = near.min_by(|a, b| off(a).total_cmp(&off(b)));
        match held {
            Some(at) => self.hold(code, body, &list[at], stated)?,
            None => {
                let axis = stated.at.unwrap_or(body.pose.at);
                let detail = || format!("has no grasp over {} at yaw {}", point(axis), figure(stated.yaw));
                self.fault(FaultCode::NoSuchGrasp, detail);
            }
        }
        Ok(held)
    }

    /// The release of the object that is held, at its new place. The hand has turned with it.
    pub(super) fn release(
        &mut self,
        (held, step): (Held, &PickPlace),
        (from, to): (&Body, &Body),
    ) -> Result<(), Interrupted> {
        let release = step.release;
        let Grasps::Listed(list) = self.stated().grasps() else {
            return self.grasp(FaultCode::ReleaseBlocked, to, release).map(|_| ());
        };
        let Some(grasp) = held.map(|at| &list[at]) else { return Ok(()) };
        if !self.resolvable(release) {
            return Ok(());
        }
        // Where a tolerance forgives what was seen since, the hand still turns as planned.
        let planned = step.from.filter(|_| self.terms.position_tolerance > 0.0).and_then(|from| from.yaw);
        let tolerance = if planned.is_some() { TOLERANCE } else { self.off_yaw(grasp) };
        let turn = to.pose.yaw - planned.unwrap_or(from.pose.yaw);
        self.turns(turn, release.yaw - step.grasp.yaw, tolerance, "the hand");
        if let Some(stated) = step.turn {
            self.turns(turn, stated, tolerance, "as stated it");
            if !(-PI..=PI).contains(&stated) || stated <= -PI {
                self.fault(FaultCode::WrongTurn, || format!("turn {} is not in (−π, π]", figure(stated)));
            }
        }
        let (axis, stated) = (to.point(grasp.at()), release.at.unwrap_or(to.pose.at));
        self.over(axis, stated);
        self.hold(FaultCode::ReleaseBlocked, to, grasp, release)
    }

    /// Reports figures that are no numbers, or too large.
    fn resolvable(&mut self, StatedGrasp { yaw, slack, .. }: StatedGrasp) -> bool {
        let slack = slack.filter(|_| self.terms.exact()).unwrap_or(0.0);
        let resolvable = yaw.abs() <= MAX_YAW && slack.is_finite();
        if !resolvable {
            let detail = || format!("yaw {yaw:e} with slack {slack:e} can't be resolved");
            self.fault(FaultCode::NumberOutOfRange, detail);
        }
        resolvable
    }

    /// True if what is stated is this grasp of the object where it stands.
    fn is(&self, grasp: &ListedGrasp, body: &Body, stated: StatedGrasp) -> bool {
        let axis = stated.at.unwrap_or(body.pose.at);
        let near = (axis - body.point(grasp.at())).norm() <= self.off_axis();
        near && self.off(grasp, body, stated) <= self.off_yaw(grasp)
    }

    /// How far the stated yaw is from that of a listed grasp, rad.
    fn off(&self, grasp: &ListedGrasp, body: &Body, stated: StatedGrasp) -> f64 {
        let period = self.scene.gripper().period();
        let turned = (stated.yaw - body.pose.yaw - grasp.yaw()) / period;
        (turned - turned.round()).abs() * period
    }

    /// Reports a turn that is not the object's.
    fn turns(&mut self, real: f64, stated: f64, tolerance: f64, what: &str) {
        // NaN agrees with nothing.
        let agrees = wrap(stated - real).abs() <= tolerance;
        if !agrees {
            let detail = || format!("turns by {:.9} rad, {what} by {} rad", wrap(real), figure(wrap(stated)));
            self.fault(FaultCode::WrongTurn, detail);
        }
    }

    /// Reports an axis that is not over this point.
    fn over(&mut self, axis: Point2<f64>, stated: Point2<f64>) {
        // NaN agrees with nothing.
        let agrees = (axis - stated).norm() <= self.off_axis();
        if !agrees {
            let detail = || format!("the gripper's axis belongs over {}, not over {}", point(axis), point(stated));
            self.fault(FaultCode::WrongAxis, detail);
        }
    }

    /// The grasp of a disc over its centre, at any yaw.
    fn centred(&mut self, code: FaultCode, body: &Body, stated: StatedGrasp) -> Result<(), Interrupted> {
        self.over(body.pose.at, stated.at.unwrap_or(body.pose.at));
        let gripper = self.scene.gripper();
        let (least, most) = (gripper.yaw_tolerance(), PI / f64::from(gripper.fingers()));
        let slack = stated.slack.filter(|_| self.terms.exact());
        // Without obstacles the slack is π/k even if the tolerance is more.
        let in_range = |slack| (least.min(most) - TOLERANCE..=most + TOLERANCE).contains(&slack);
        if let Some(slack) = slack.filter(|slack| !in_range(*slack)) {
            let detail = || format!("slack {} is not between {least:.9} and {most:.9} rad", figure(slack));
            self.fault(FaultCode::WrongSlack, detail);
        }
        let band = slack.unwrap_or(0.0).clamp(least, most.max(least));
        self.clear(code, &Grip::centred(body, gripper, (stated.yaw, band)))
    }

    /// A listed grasp, over its whole band.
    fn hold(
        &mut self,
        code: FaultCode,
        body: &Body,
        grasp: &ListedGrasp,
        stated: StatedGrasp,
    ) -> Result<(), Interrupted> {
        let (gripper, band) = (self.scene.gripper(), band_of(grasp, self.scene.gripper()));
        if let Some(slack) = stated.slack.filter(|slack| self.terms.exact() && (slack - band).abs() > TOLERANCE) {
            let detail = || format!("the slack of this grasp is {band:.9} rad, not {} rad", figure(slack));
            self.fault(FaultCode::WrongSlack, detail);
        }
        self.ticker.step(work(grasp, self.stated().footprint().shape(), gripper))?;
        let hold = Hold::new(self.stated().footprint().shape(), grasp, gripper, Leaning::Free);
        if hold.too_wide {
            self.fault(FaultCode::TooWide, || "is wider in this grasp than the greatest opening".to_owned());
            return Ok(());
        }
        let (mut grip, faults) = (hold.of(body, gripper), self.faults.count());
        self.clear(code, &grip)?;
        let aside = ((stated.yaw - grip.yaw) / gripper.period()).fract();
        let aside = (aside - aside.round()) * gripper.period();
        if aside.abs() > TOLERANCE && self.faults.count() == faults {
            // The hand goes by the stated yaw, and may be off from there.
            grip.yaw += aside;
            self.clear(code, &grip)?;
        }
        Ok(())
    }

    /// Fingers and palm meet no other object at any yaw of the band. Names the obstacle that they go deepest into.
    fn clear(&mut self, code: FaultCode, grip: &Grip) -> Result<(), Interrupted> {
        let gripper = self.scene.gripper();
        let hand = Hand::at(self.stated(), gripper, Leaning::Free);
        let (mut near, mut visited) = (Vec::new(), 0);
        self.places.within(grip.axis, (grip.span() + gripper.margin()).max(hand.span()), |place| {
            visited += 1;
            let owner = self.places.owner(place);
            if owner != self.object && self.standing.place(owner) == place {
                near.push((owner, place));
            }
        });
        self.ticker.step(visited / 16)?;
        let mut worst: Option<(f64, ObjectIndex, &str)> = None;
        for (owner, place) in near {
            self.ticker.step(1)?;
            if let Some((depth, what)) = self.meets(&hand, grip, owner, place)
                && worst.is_none_or(|(deepest, ..)| depth > deepest)
            {
                worst = Some((depth, owner, what));
            }
        }
        if let Some((depth, by, what)) = worst {
            let (by, yaw, band) = (self.scene.object(by).id(), figure(grip.yaw), grip.band);
            let detail = || format!("{what} comes {depth:.9} m too near to '{by}' at yaw {yaw} ± {band:.9} rad");
            self.fault(code, detail);
        }
        Ok(())
    }

    /// How much too near the hand comes to an object, m, and with what, if that is more than rounding.
    fn meets(&self, hand: &Hand, grip: &Grip, other: ObjectIndex, place: PlaceIndex) -> Option<(f64, &'static str)> {
        let (obstacle, body) = (self.scene.object(other), self.places.body(place));
        let palm = hand.under_palm(obstacle, body, grip.axis).filter(|depth| *depth > TOLERANCE);
        if let Some(depth) = palm {
            return Some((depth, "the palm"));
        }
        let finger = hand.fingers_reach(obstacle).then(|| grip.depth(body, self.scene.gripper().margin()));
        Some((finger??, "a finger"))
    }
}
