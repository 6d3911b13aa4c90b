//! Checks a new place: on the table, outside every keep-out, clear of other objects.

use nalgebra::Vector2;

use crate::budget::Interrupted;
use crate::scene::{Disc, ObjectIndex, Rectangle, Scene};

use super::TOLERANCE;
use super::fault::{FaultCode, Faults, figure};
use super::meter::Meter;
use super::near::{PlaceIndex, Places, Standing};

/// A disc about to be set down, while the others stand on `standing`.
pub(super) struct Landing<'a> {
    pub(super) scene: &'a Scene,
    pub(super) places: &'a Places,
    pub(super) standing: &'a Standing,
    pub(super) step: usize,
    pub(super) object: ObjectIndex,
    pub(super) to: Disc,
}

/// How far the disc sticks out of the rectangle, m.
fn overhang(disc: Disc, top: Rectangle) -> f64 {
    let (c, min, max) = (disc.centre, top.min(), top.max());
    disc.radius + (min.x - c.x).max(c.x - max.x).max(min.y - c.y).max(c.y - max.y)
}

/// How deep the disc reaches into the rectangle, m.
fn intrusion(disc: Disc, area: Rectangle) -> f64 {
    let nearest = disc.centre.sup(&area.min()).inf(&area.max());
    disc.radius - (nearest - disc.centre).norm()
}

/// Edge to edge, m.
fn gap(a: Disc, b: Disc) -> f64 {
    let apart: Vector2<f64> = b.centre - a.centre;
    apart.norm() - a.radius - b.radius
}

impl Landing<'_> {
    /// All rules of a new place, and the stated gap.
    pub(super) fn check(
        &self,
        stated_gap: Option<f64>,
        faults: &mut Faults,
        meter: &mut Meter<'_>,
    ) -> Result<(), Interrupted> {
        self.on_table(faults);
        for (at, areas) in self.scene.table().keep_out().chunks(64).enumerate() {
            meter.spend(1)?;
            self.outside(64 * at, areas, faults);
        }
        self.clear(faults, meter)?;
        if let Some(stated) = stated_gap {
            meter.spend(1)?;
            self.gap_as_stated(stated, faults);
        }
        Ok(())
    }

    fn id(&self) -> &str {
        self.scene.object(self.object).id()
    }

    fn on_table(&self, faults: &mut Faults) {
        let overhang = overhang(self.to, self.scene.table().top());
        if overhang > TOLERANCE {
            let detail = || format!("the new place sticks out over the table's edge by {overhang:.9} m");
            faults.of_step(FaultCode::OffTable, self.step, self.id(), detail);
        }
    }

    fn outside(&self, first: usize, areas: &[Rectangle], faults: &mut Faults) {
        for (at, area) in areas.iter().enumerate() {
            let depth = intrusion(self.to, *area);
            if depth > TOLERANCE {
                let detail = || format!("the new place reaches {depth:.9} m into keep-out {}", first + at);
                faults.of_step(FaultCode::InKeepOut, self.step, self.id(), detail);
            }
        }
    }

    /// True for a place on which another object stands now.
    fn taken(&self, place: PlaceIndex) -> bool {
        let owner = self.places.owner(place);
        owner != self.object && self.standing.place(owner) == place
    }

    /// Every other object is at least the margin away. Pairs that were closer at the start need only keep that
    /// distance, since the scene allows it.
    fn clear(&self, faults: &mut Faults, meter: &mut Meter<'_>) -> Result<(), Interrupted> {
        let margin = self.scene.gripper().margin();
        let mut visited = 0;
        self.places.within(self.to.centre, self.to.radius + margin, |place| {
            visited += 1;
            if !self.taken(place) {
                return;
            }
            let other = self.scene.object(self.places.owner(place));
            let first = gap(self.scene.object(self.object).disc(), other.disc());
            let (real, asked) = (gap(self.to, self.places.disc(place)), margin.min(first).max(0.0));
            if real < asked - TOLERANCE {
                let detail = || format!("stands {real:.9} m from '{}' where {asked:.9} m are asked", other.id());
                faults.of_step(FaultCode::TooClose, self.step, self.id(), detail);
            }
        });
        meter.spend(1 + visited / 16)
    }

    fn gap_as_stated(&self, stated: f64, faults: &mut Faults) {
        let real = self.places.least_gap(self.to.centre, |place| self.taken(place)) - self.to.radius;
        // NaN agrees with nothing.
        let agrees = (real - stated).abs() <= TOLERANCE;
        if !agrees {
            let detail = || format!("the least gap is {real:.9} m, not {} m", figure(stated));
            faults.of_step(FaultCode::WrongGap, self.step, self.id(), detail);
        }
    }
}
