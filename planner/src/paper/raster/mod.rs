//! Section IV.C: new places on an image of the table.
//!
//! For each object in turn (the letters are those of Fig. 5): the other objects, grown by the clearance r_g, are black
//! on white (c); the share of white under the object's mask is counted at every pixel (d), and pixels above the
//! threshold of Eq. 7 are marked (e); of these the one farthest from the target is taken that does not interfere with
//! what comes later (f). There is no way back: where no pixel is left, there is no arrangement.
//!
//! Three demands of the paper's text that its formulas leave out are met too. A new place "does not overlap with other
//! objects": it keeps the margin to each. It lies on the table and outside keep-outs. It leaves r_g, and the margin,
//! round the target and round all objects still to be moved. These are decided by distances from the middle of each
//! pixel, not by counting pixels: objects are put onto pixel middles, so no rounding to pixels takes part, and no
//! object is put onto another. Only the counts of Eq. 7 are as coarse as the pixels.
//!
//! The gap that the paper states stays: it does not ask whether the gripper can open at the new place. Also the fingers
//! reach farther than r_g, with their outer corners, so a later grasp may be blocked; most of all with wide fingers
//! that open only a little.

mod blot;
mod convolution;
mod grid;
mod mask;
#[cfg(test)]
mod tests;
mod threshold;

pub use grid::{DEFAULT_RESOLUTION, Raster, TooFine};

use nalgebra::Point2;

use super::angles::radius;
use crate::budget::{Budget, Interrupted};
use crate::geometry::Grasp;
use crate::knowledge::GraspModel;
use crate::placement::{Arrangement, INSIDE, Layout, Move, Relocation};
use crate::scene::{Footprint, ObjectIndex, Pose, Scene};

use blot::Blot;
use convolution::Convolution;
use mask::Mask;
use threshold::{WHITE, threshold};

/// Places for the objects of `order`, movable ones other than the target, moved one after the other. `None` if one of
/// them finds no place. The raster is one of the scene's table.
///
/// Grasps are the middle of the widest free interval under `model`. A release that has none is at the yaw of its grasp,
/// a grasp that has none at 0, both with slack 0: whether such a plan can be carried out is for the checker to say.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn reposition(
    scene: &Scene,
    target: ObjectIndex,
    order: &[ObjectIndex],
    raster: &Raster,
    model: &dyn GraspModel,
    budget: &Budget<'_>,
) -> Result<Option<Arrangement>, Interrupted> {
    let mut table =
        Pictured { layout: Layout::new(scene, model), scene, target, convolution: Convolution::new(*raster), raster };
    let mut moves = Vec::with_capacity(order.len());
    for (at, &object) in order.iter().enumerate() {
        let Some(to) = table.place(object, &order[at + 1..], budget)? else { return Ok(None) };
        moves.push(Move::Place(table.relocate(object, to.into())));
    }
    Ok(Some(Arrangement { moves, target_grasp: Some((target, table.grasp(target))) }))
}

/// A layout and the images that are made of it.
struct Pictured<'a> {
    layout: Layout<'a>,
    scene: &'a Scene,
    target: ObjectIndex,
    convolution: Convolution,
    raster: &'a Raster,
}

impl Pictured<'_> {
    fn grasp(&self, object: ObjectIndex) -> Grasp {
        let axis = self.layout.footprint(object).at();
        self.layout.grasp(object).unwrap_or(Grasp { axis, yaw: 0.0, slack: 0.0 })
    }

    fn relocate(&mut self, object: ObjectIndex, to: Pose) -> Relocation {
        let (from, grasp) = (self.layout.footprint(object).pose(), self.grasp(object));
        let placed = self.layout.footprint(object).moved_to(to);
        let gap = self.layout.gap(object, &placed);
        self.layout.put(object, to);
        let release = self.layout.grasp(object).unwrap_or(Grasp { axis: to.at, slack: 0.0, ..grasp });
        Relocation { object, from, to, grasp, release, gap }
    }

    /// The marked place farthest from the target; the first in row order among equals.
    fn place(
        &mut self,
        object: ObjectIndex,
        later: &[ObjectIndex],
        budget: &Budget<'_>,
    ) -> Result<Option<Point2<f64>>, Interrupted> {
        let (raster, top) = (self.raster, self.scene.table().top());
        let radius = radius(self.layout.footprint(object));
        let edge = radius + INSIDE;
        let columns = raster.columns_between(top.min().x + edge, top.max().x - edge);
        let rows = raster.rows_between(top.min().y + edge, top.max().y - edge);
        if columns.is_empty() || rows.is_empty() {
            return Ok(None);
        }
        // The object fits on the table, so the mask is no larger than the image.
        let mask = Mask::new(radius, raster.resolution());
        let taken = blot::image(raster, &self.taken(object, later), budget)?;
        let grown = blot::image(raster, &self.grown(object), budget)?;
        self.convolution.run(&grown, &mask, budget)?;
        let gripper = self.scene.gripper();
        let least = threshold(radius, gripper.clearance(), gripper.period()) / WHITE * mask.pixels() as f64;
        let target = self.layout.footprint(self.target).at();
        let mut best: Option<(f64, Point2<f64>)> = None;
        for row in rows {
            budget.check()?;
            for column in columns.clone() {
                let (pixel, at) = (raster.at(column, row), raster.centre(column, row));
                let far = (at - target).norm_squared();
                let farthest = best.is_none_or(|(farthest, _)| far > farthest);
                if farthest && !taken[pixel] && self.convolution.white(pixel) > least {
                    best = Some((far, at));
                }
            }
        }
        Ok(best.map(|(_, at)| at))
    }

    fn others(&self, object: ObjectIndex) -> impl Iterator<Item = (ObjectIndex, &Footprint)> {
        self.scene.indices().filter(move |&other| other != object).map(|other| (other, self.layout.footprint(other)))
    }

    /// Fig. 5c: the other objects grown by the clearance.
    fn grown(&self, object: ObjectIndex) -> Vec<Blot> {
        let clearance = self.scene.gripper().clearance();
        self.others(object).map(|(_, disc)| Blot::disc(disc, clearance)).collect()
    }

    /// The places where the object's centre may not be: too near to others, to keep-outs, or to objects still to be
    /// grasped.
    fn taken(&self, object: ObjectIndex, later: &[ObjectIndex]) -> Vec<Blot> {
        let (gripper, radius) = (self.scene.gripper(), radius(self.layout.footprint(object)));
        let apart = radius + gripper.margin() + INSIDE;
        let around = |object: &ObjectIndex| Blot::disc(self.layout.footprint(*object), apart + gripper.clearance());
        let keep_outs = self.scene.table().keep_out().iter().map(|area| Blot::round(area, radius + INSIDE));
        let others = self.others(object).map(|(_, disc)| Blot::disc(disc, apart));
        let target = self.target;
        others.chain(keep_outs).chain(later.iter().chain([&target]).map(around)).collect()
    }
}
