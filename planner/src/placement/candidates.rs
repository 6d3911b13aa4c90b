//! Candidate places for one object, best first.
//!
//! The best place lies where two border curves of the free space meet, or where one of them has an extreme. The search
//! is best first: a curve is expanded in the order of the best score that any of its points can have. So places come
//! out in the order of their scores, and only the curves that matter are expanded.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

use nalgebra::Point2;

use super::borders::{Border, insets};
use super::effort::EffortMeter;
use super::layout::Layout;
use super::{INSIDE, Objective, scatter};
use crate::budget::Stop;
use crate::scene::{Footprint, ObjectIndex, Placed, Pose, distance};

/// Places that can be generated for the cost of trying one.
const PLACES_PER_EFFORT: usize = 32;

/// The requirements on a place, and the objective by which places are ranked.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlaceSpec {
    pub(super) object: ObjectIndex,
    /// How the object is turned, rad.
    pub(super) yaw: f64,
    /// The gap to other objects, m.
    pub(super) gap: f64,
    /// The gap to the table's edge and to keep-outs, m.
    pub(super) edge_gap: f64,
    pub(super) objective: Objective,
    /// The point from which places are far by [`Objective::FarFromTarget`].
    pub(super) focus: Point2<f64>,
}

/// Places in the order of their score.
pub(super) struct Candidates {
    spec: PlaceSpec,
    /// The object where it stood, turned as it is to be.
    own: Footprint,
    /// The target's centre or the object's own, by objective.
    origin: Point2<f64>,
    table: Border,
    /// How far an obstacle's border reaches from the obstacle's origin, at most, m.
    span: f64,
    /// Per obstacle its border, where it is not made of circles alone and so is worth keeping.
    borders: Vec<OnceCell<Box<Border>>>,
    /// Per obstacle whether its border is expanded: the points where it meets other borders are in the heap.
    expanded: Vec<bool>,
    /// The same per keep-out.
    expanded_areas: Vec<bool>,
    heap: BinaryHeap<HeapEntry>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Place,
    Obstacle(ObjectIndex),
    KeepOut(usize),
}

/// An entry of the heap. Higher scores come first, among equals smaller coordinates, so that the order is the same on
/// every machine.
#[derive(Debug, Clone, Copy, PartialEq)]
struct HeapEntry {
    score: f64,
    at: Point2<f64>,
    kind: Kind,
}

impl Eq for HeapEntry {}

impl Ord for HeapEntry {
    fn cmp(&self, other: &Self) -> Ordering {
        let key = |entry: &Self| (entry.kind != Kind::Place, entry.score);
        let ((curve, score), (other_curve, other_score)) = (key(self), key(other));
        score
            .total_cmp(&other_score)
            .then(curve.cmp(&other_curve))
            .then_with(|| other.at.x.total_cmp(&self.at.x))
            .then_with(|| other.at.y.total_cmp(&self.at.y))
    }
}

impl PartialOrd for HeapEntry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Candidates {
    /// Places for an object that is lifted off `layout`.
    pub(super) fn new(layout: &Layout<'_>, spec: PlaceSpec) -> Self {
        let mut candidates = Self::empty(layout, spec);
        candidates.add_table(layout);
        candidates.add_keep_outs(layout);
        candidates.add_obstacles(layout);
        if spec.objective == Objective::ShortMoves {
            candidates.add_spiral(layout);
        }
        candidates
    }

    /// Adds places round the old one, denser near it. Often a step aside is enough to let a finger pass, and the
    /// borders of shadows are not among the curves.
    fn add_spiral(&mut self, layout: &Layout<'_>) {
        let gripper = layout.scene().gripper();
        let reach =
            2.0 * self.own.core().map_or_else(|| gripper.corner_distance(&self.own), |_| self.own.circumradius());
        scatter::spiral(self.origin, reach).for_each(|at| self.add_place(at));
    }

    fn empty(layout: &Layout<'_>, spec: PlaceSpec) -> Self {
        let scene = layout.scene();
        let stands = layout.footprint(spec.object);
        let own = stands.moved_to(Pose { at: stands.at(), yaw: spec.yaw });
        let origin = match spec.objective {
            Objective::FarFromTarget => spec.focus,
            Objective::ShortMoves => own.at(),
        };
        Self {
            spec,
            own,
            origin,
            table: Border::default(),
            span: 0.0,
            borders: vec![OnceCell::new(); scene.objects().len()],
            expanded: vec![false; scene.objects().len()],
            expanded_areas: vec![false; scene.table().keep_out().len()],
            heap: BinaryHeap::new(),
        }
    }

    /// Places spread evenly over the table, for scenes where no point on a border curve will do: a release between
    /// obstacles may be possible only well inside a free region.
    pub(super) fn spread(layout: &Layout<'_>, spec: PlaceSpec) -> Self {
        let mut candidates = Self::empty(layout, spec);
        let top = layout.scene().table().top();
        let [low, high] = insets(&candidates.own, spec.edge_gap);
        scatter::even(top.min() + low, top.max() - high).for_each(|at| candidates.add_place(at));
        candidates
    }

    /// The next best place. The caller tests whether it is free.
    ///
    /// # Errors
    /// [`Stop`] when effort or budget end: many borders may be expanded before the next place.
    pub(super) fn next(&mut self, layout: &Layout<'_>, meter: &mut EffortMeter<'_>) -> Result<Option<Pose>, Stop> {
        while let Some(entry) = self.heap.pop() {
            let before = self.heap.len();
            match entry.kind {
                Kind::Place => return Ok(Some(Pose { at: entry.at, yaw: self.spec.yaw })),
                Kind::Obstacle(object) => {
                    self.expanded[object.get()] = true;
                    let (obstacle, border) = (layout.footprint(object).at(), self.beside(layout, object).into_owned());
                    self.expand(layout, &border, obstacle, border.farthest(obstacle));
                }
                Kind::KeepOut(at) => {
                    self.expanded_areas[at] = true;
                    let area = layout.scene().table().keep_out()[at];
                    let border = Border::outside(&self.own, &area, self.spec.edge_gap);
                    let middle = nalgebra::center(&area.min(), &area.max());
                    self.expand(layout, &border, middle, border.farthest(middle));
                }
            }
            meter.spend(self.heap.len().saturating_sub(before) / PLACES_PER_EFFORT)?;
            meter.look()?;
        }
        Ok(None)
    }

    /// True if the object keeps all gaps at `at`.
    pub(super) fn fits(&self, layout: &Layout<'_>, at: Pose) -> bool {
        let place = self.own.moved_to(at);
        let table = layout.scene().table();
        // Curves run a whole INSIDE away from the bound: half of it absorbs their rounding.
        let edge_gap = self.spec.edge_gap + INSIDE / 2.0;
        let gap = self.spec.gap + INSIDE / 2.0;
        place.gap_inside(&table.top()) >= edge_gap
            && table.keep_out().iter().all(|area| place.gap_outside(area) >= edge_gap)
            && self.stands_free(layout, &place, gap)
    }

    /// True if no other object is nearer to `place` than `gap`, m. The index only narrows the choice.
    fn stands_free(&self, layout: &Layout<'_>, place: &Footprint, gap: f64) -> bool {
        layout.near(place.at(), place.circumradius() + gap).all(|(_, other)| place.keeps_from(other, gap))
    }

    fn score(&self, at: Point2<f64>) -> f64 {
        let apart = distance(at, self.origin);
        match self.spec.objective {
            Objective::FarFromTarget => apart,
            Objective::ShortMoves => -apart,
        }
    }

    fn add_place(&mut self, at: Point2<f64>) {
        self.heap.push(HeapEntry { score: self.score(at), at, kind: Kind::Place });
    }

    /// The distance of the object's origin from keep-outs, at most, m.
    fn edge(&self) -> f64 {
        self.own.circumradius() + self.spec.edge_gap + INSIDE
    }

    fn add_table(&mut self, layout: &Layout<'_>) {
        self.table = Border::inside(&self.own, &layout.scene().table().top(), self.spec.edge_gap);
        let (table, origin) = (self.table.clone(), self.origin);
        table.extremes(origin, |at| self.add_place(at));
    }

    fn add_keep_outs(&mut self, layout: &Layout<'_>) {
        let keep = self.edge();
        for (at, area) in layout.scene().table().keep_out().iter().enumerate() {
            let score = match self.spec.objective {
                Objective::FarFromTarget => Border::outside(&self.own, area, self.spec.edge_gap).farthest(self.origin),
                Objective::ShortMoves => -(area.distance(self.origin) - keep).max(0.0),
            };
            self.heap.push(HeapEntry { score, at: area.min(), kind: Kind::KeepOut(at) });
        }
    }

    fn add_obstacles(&mut self, layout: &Layout<'_>) {
        for object in layout.scene().indices().filter(|&object| !layout.is_lifted(object)) {
            let at = layout.footprint(object).at();
            let [near, far, span] = self.bounds(layout, object);
            self.span = self.span.max(span);
            let score = match self.spec.objective {
                Objective::FarFromTarget => far,
                Objective::ShortMoves => -near,
            };
            self.heap.push(HeapEntry { score, at, kind: Kind::Obstacle(object) });
        }
    }

    /// Bounds on the distance of the border beside an obstacle from the origin, least and greatest, and from the obstacle's origin,
    /// m. Exact where it is made of circles alone; other borders are made when they are needed.
    fn bounds(&self, layout: &Layout<'_>, object: ObjectIndex) -> [f64; 3] {
        let (own, obstacle) = self.pair(layout, object);
        let at = obstacle.footprint.at();
        if own.footprint.core().is_none() && obstacle.footprint.core().is_none() {
            let border = self.beside(layout, object);
            return [border.nearest(self.origin), border.farthest(self.origin), border.farthest(at)];
        }
        let span = Border::span_beside(own, obstacle, layout.scene().gripper(), self.spec.gap);
        let away = distance(at, self.origin);
        [(away - span).max(0.0), away + span, span]
    }

    /// The border beside an obstacle.
    fn beside(&self, layout: &Layout<'_>, obstacle: ObjectIndex) -> Cow<'_, Border> {
        let (own, placed) = self.pair(layout, obstacle);
        let border = || Border::beside(own, placed, layout.scene().gripper(), self.spec.gap);
        if own.footprint.core().is_none() && placed.footprint.core().is_none() {
            return Cow::Owned(border());
        }
        Cow::Borrowed(self.borders[obstacle.get()].get_or_init(|| Box::new(border())))
    }

    fn pair<'a>(&'a self, layout: &'a Layout<'_>, obstacle: ObjectIndex) -> (Placed<'a>, Placed<'a>) {
        (Placed { object: layout.scene().object(self.spec.object), footprint: &self.own }, layout.placed(obstacle))
    }

    /// Adds the points where a border, which lies within `reach` of `centre`, meets those that are not expanded yet.
    fn expand(&mut self, layout: &Layout<'_>, border: &Border, centre: Point2<f64>, reach: f64) {
        let mut places: Vec<Point2<f64>> = Vec::new();
        let mut add = |at| places.push(at);
        border.extremes(self.origin, &mut add);
        border.meet(&self.table, &mut add);
        for (other, _) in layout.near(centre, reach + self.span).filter(|(other, _)| !self.expanded[other.get()]) {
            border.meet(&self.beside(layout, other), &mut add);
        }
        for (area, _) in layout.scene().table().keep_out().iter().zip(&self.expanded_areas).filter(|(_, done)| !**done)
        {
            if area.distance(centre) - (reach + self.edge()) <= 0.0 {
                border.meet(&Border::outside(&self.own, area, self.spec.edge_gap), &mut add);
            }
        }
        places.into_iter().for_each(|at| self.add_place(at));
        if self.heap.len() > MANY {
            self.forget_worst();
        }
    }

    /// Drops the worst places past a limit. Round a large disc among thousands of crumbs there are millions of places,
    /// more than effort can try.
    fn forget_worst(&mut self) {
        if self.heap.iter().filter(|entry| entry.kind == Kind::Place).count() <= MANY {
            return;
        }
        let (mut places, curves) = self.heap.drain().partition::<Vec<_>, _>(|entry| entry.kind == Kind::Place);
        // Among equal scores the order of places decides.
        places.select_nth_unstable_by(MANY / 2, |a, b| b.cmp(a));
        places.truncate(MANY / 2);
        self.heap.extend(places.into_iter().chain(curves));
    }
}

/// The most places in the heap. Past that only the best half stays.
const MANY: usize = 1 << 17;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knowledge::SweptFinger;
    use crate::scene::scenes::TestScene;

    #[test]
    fn places_beyond_the_limit_are_forgotten_even_with_equal_scores() {
        let scene = TestScene::new(3).disc("cup", 1.0, 1.0, 0.05).disc("plate", 0.5, 1.0, 0.1).build("cup");
        let (object, objective) = (ObjectIndex::new(1), Objective::FarFromTarget);
        let spec = PlaceSpec { object, yaw: 0.0, gap: 0.0, edge_gap: 0.0, objective, focus: Point2::new(1.0, 1.0) };
        let mut candidates = Candidates::empty(&Layout::new(&scene, &SweptFinger), spec);
        let place = |n: u32| HeapEntry { score: 0.5, at: Point2::new(f64::from(n), 0.0), kind: Kind::Place };
        let curve = HeapEntry { kind: Kind::Obstacle(object), ..place(0) };
        let many = u32::try_from(MANY).unwrap();
        candidates.heap.extend((0..=many).map(place).chain([curve]));
        candidates.forget_worst();
        assert!(candidates.heap.into_sorted_vec().into_iter().eq((0..many / 2).rev().map(place).chain([curve])));
    }
}
