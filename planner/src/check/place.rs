//! Checks a new place: on the table, outside every keep-out, clear of other objects.

use core::cell::Cell;

use crate::budget::{Interrupted, Ticker};
use crate::scene::{ObjectIndex, Rectangle, Scene};

use super::TOLERANCE;
use super::body::Body;
use super::fault::{FaultCode, Faults, figure};
use super::measure::{gap, intrusion, overhang};
use super::near::{PlaceIndex, Places, Standing};

/// An object about to be set down, while the others stand on `standing`.
pub(super) struct Landing<'a> {
    pub(super) scene: &'a Scene,
    pub(super) places: &'a Places,
    pub(super) standing: &'a Standing,
    pub(super) step: usize,
    pub(super) object: ObjectIndex,
    pub(super) to: &'a Body,
}

impl Landing<'_> {
    /// All rules of a new place, and the stated gap.
    pub(super) fn check(
        &self,
        stated_gap: Option<f64>,
        faults: &mut Faults,
        ticker: &mut Ticker<'_>,
    ) -> Result<(), Interrupted> {
        self.on_table(faults);
        for (at, areas) in self.scene.table().keep_out().chunks(64).enumerate() {
            ticker.step(1)?;
            self.outside(64 * at, areas, faults);
        }
        self.clear(faults, ticker)?;
        if let Some(stated) = stated_gap {
            let visited = self.gap_as_stated(stated, faults);
            ticker.step(1 + visited / 16)?;
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
    fn clear(&self, faults: &mut Faults, ticker: &mut Ticker<'_>) -> Result<(), Interrupted> {
        let margin = self.scene.gripper().margin();
        let mut visited = 0;
        self.places.within(self.to.pose.at, self.to.extent + margin, |place| {
            visited += 1;
            if !self.taken(place) {
                return;
            }
            let other = self.places.owner(place);
            let first = gap(self.places.at_start(self.object), self.places.at_start(other));
            let (real, asked) = (gap(self.to, self.places.body(place)), margin.min(first).max(0.0));
            if real < asked - TOLERANCE {
                let id = self.scene.object(other).id();
                let detail = || format!("stands {real:.9} m from '{id}' where {asked:.9} m are asked");
                faults.of_step(FaultCode::TooClose, self.step, self.id(), detail);
            }
        });
        ticker.step(1 + visited / 16)
    }

    /// The result is the number of places visited: empty ones don't end the search, so they are charged too.
    fn gap_as_stated(&self, stated: f64, faults: &mut Faults) -> usize {
        let visited = Cell::new(0);
        let real = self.places.least_gap(self.to, |place| {
            visited.set(visited.get() + 1);
            self.taken(place)
        });
        // NaN agrees with nothing.
        let agrees = (real - stated).abs() <= TOLERANCE;
        if !agrees {
            let detail = || format!("the least gap is {real:.9} m, not {} m", figure(stated));
            faults.of_step(FaultCode::WrongGap, self.step, self.id(), detail);
        }
        visited.get()
    }
}
