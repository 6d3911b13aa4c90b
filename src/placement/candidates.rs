//! Places worth trying for one object, best first.
//!
//! The best place lies where two border curves of the free space meet, or where one of them has its extreme. Curves are
//! expanded in the order of the best score that any of their points can have, so that places come out in the order of
//! their score and only the curves that matter are ever looked at.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use nalgebra::Point2;
use smallvec::SmallVec;

use super::curves::{Circle, Line};
use super::layout::Layout;
use super::{INSIDE, Objective};
use crate::scene::{Disc, ObjectIndex, distance};

/// What a place must keep, and what makes it good.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wish {
    pub(super) object: ObjectIndex,
    /// Kept from other objects, m.
    pub(super) gap: f64,
    /// Kept from table edge and keep-outs, m.
    pub(super) edge_gap: f64,
    pub(super) objective: Objective,
}

/// Places in the order of their score.
pub(super) struct Candidates {
    wish: Wish,
    radius: f64,
    /// The target's centre or the object's own, by objective.
    origin: Point2<f64>,
    lines: Vec<Line>,
    corners: Vec<Circle>,
    /// How far apart two obstacles' circles can still meet, m.
    span: f64,
    expanded: Vec<bool>,
    heap: BinaryHeap<Entry>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Place,
    Obstacle(ObjectIndex),
    Corner(usize),
}

/// Higher scores first; among equals the smaller coordinates, so that the order is one and the same everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Entry {
    score: f64,
    at: Point2<f64>,
    kind: Kind,
}

impl Eq for Entry {}

impl Ord for Entry {
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

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Candidates {
    /// Places for an object that is lifted off `layout`.
    pub(super) fn new(layout: &Layout<'_>, wish: Wish) -> Self {
        let mut candidates = Self::empty(layout, wish);
        candidates.add_straight_borders(layout);
        candidates.add_obstacles(layout);
        candidates
    }

    fn empty(layout: &Layout<'_>, wish: Wish) -> Self {
        let scene = layout.scene();
        let own = layout.disc(wish.object);
        let origin = match wish.objective {
            Objective::FarFromTarget => scene.object(scene.target()).disc().centre,
            Objective::ShortMoves => own.centre,
        };
        Self {
            wish,
            radius: own.radius,
            origin,
            lines: Vec::new(),
            corners: Vec::new(),
            span: 0.0,
            expanded: vec![false; scene.objects().len()],
            heap: BinaryHeap::new(),
        }
    }

    /// Places spread evenly over the table, for where no border curve's points will do: a release between obstacles may be
    /// possible only well inside a free region.
    pub(super) fn spread(layout: &Layout<'_>, wish: Wish) -> Self {
        let mut candidates = Self::empty(layout, wish);
        let top = layout.scene().table().top();
        let keep = candidates.radius + wish.edge_gap + INSIDE;
        let (min, size) = (top.min(), top.max() - top.min());
        for n in 1..=SPREAD {
            let (x, y) = (radical_inverse(n, 2), radical_inverse(n, 3));
            let inner = |share: f64, size: f64| keep + share * (size - 2.0 * keep);
            candidates.add_place(Point2::new(min.x + inner(x, size.x), min.y + inner(y, size.y)));
        }
        candidates
    }

    /// The next best place. Whether it is free is for the caller to see.
    pub(super) fn next(&mut self, layout: &Layout<'_>) -> Option<Point2<f64>> {
        loop {
            let entry = self.heap.pop()?;
            match entry.kind {
                Kind::Place => return Some(entry.at),
                Kind::Obstacle(object) => self.expand(layout, object),
                Kind::Corner(at) => self.expand_circle(self.corners[at]),
            }
        }
    }

    /// True if the object keeps all gaps there.
    pub(super) fn fits(&self, layout: &Layout<'_>, at: Point2<f64>) -> bool {
        let disc = Disc { centre: at, radius: self.radius };
        let table = layout.scene().table();
        // Curves run a whole INSIDE away from the bound: half of it absorbs their rounding.
        let edge_gap = self.wish.edge_gap + INSIDE / 2.0;
        let gap = self.wish.gap + INSIDE / 2.0;
        table.top().inner_gap(&disc) >= edge_gap
            && table.keep_out().iter().all(|area| area.outer_gap(&disc) >= edge_gap)
            && layout.near(at, self.radius + gap).next().is_none()
    }

    fn score(&self, at: Point2<f64>) -> f64 {
        let apart = distance(at, self.origin);
        match self.wish.objective {
            Objective::FarFromTarget => apart,
            Objective::ShortMoves => -apart,
        }
    }

    fn add_place(&mut self, at: Point2<f64>) {
        self.heap.push(Entry { score: self.score(at), at, kind: Kind::Place });
    }

    fn add_curve(&mut self, circles: &[Circle], kind: Kind) {
        let best = |circle: &Circle| {
            let apart = distance(circle.centre, self.origin);
            match self.wish.objective {
                Objective::FarFromTarget => apart + circle.radius,
                Objective::ShortMoves => -(apart - circle.radius).abs(),
            }
        };
        let score = circles.iter().map(best).fold(f64::NEG_INFINITY, f64::max);
        if let Some(circle) = circles.first() {
            self.heap.push(Entry { score, at: circle.centre, kind });
        }
    }

    /// The table's inner border, and the borders round keep-outs with their rounded corners.
    fn add_straight_borders(&mut self, layout: &Layout<'_>) {
        let table = layout.scene().table();
        let keep = self.radius + self.wish.edge_gap + INSIDE;
        let (min, max) = (table.top().min(), table.top().max());
        let mut vertical = vec![min.x + keep, max.x - keep];
        let mut horizontal = vec![min.y + keep, max.y - keep];
        for area in table.keep_out() {
            let (min, max) = (area.min(), area.max());
            vertical.extend([min.x - keep, max.x + keep]);
            horizontal.extend([min.y - keep, max.y + keep]);
            let corners = [min, max, Point2::new(min.x, max.y), Point2::new(max.x, min.y)];
            self.corners.extend(corners.map(|centre| Circle { centre, radius: keep }));
        }
        for &x in &vertical {
            self.add_place(Point2::new(x, self.origin.y));
            horizontal.iter().for_each(|&y| self.add_place(Point2::new(x, y)));
        }
        horizontal.iter().for_each(|&y| self.add_place(Point2::new(self.origin.x, y)));
        self.lines.extend(vertical.into_iter().map(Line::Vertical));
        self.lines.extend(horizontal.into_iter().map(Line::Horizontal));
        for at in 0..self.corners.len() {
            self.add_curve(&[self.corners[at]], Kind::Corner(at));
        }
    }

    fn add_obstacles(&mut self, layout: &Layout<'_>) {
        let scene = layout.scene();
        for object in scene.indices().filter(|&object| !layout.is_lifted(object)) {
            let circles = self.circles(layout, object);
            self.span = circles.iter().map(|circle| circle.radius).fold(self.span, f64::max);
            self.add_curve(&circles, Kind::Obstacle(object));
        }
    }

    /// Round an obstacle: as near as the gap allows, where it no longer hinders the release, where it no longer hinders a
    /// grasp of that obstacle.
    fn circles(&self, layout: &Layout<'_>, obstacle: ObjectIndex) -> SmallVec<[Circle; 3]> {
        let gripper = layout.scene().gripper();
        let Disc { centre, radius } = layout.disc(obstacle);
        let clear = gripper.margin() + INSIDE;
        let mut radii: SmallVec<[f64; 3]> = SmallVec::from_buf([
            self.radius + radius + self.wish.gap + INSIDE,
            gripper.corner_distance(self.radius) + radius + clear,
            gripper.corner_distance(radius) + self.radius + clear,
        ]);
        radii.dedup_by(|a, b| (*a - *b).abs() < INSIDE);
        radii.into_iter().map(|radius| Circle { centre, radius }).collect()
    }

    fn expand(&mut self, layout: &Layout<'_>, object: ObjectIndex) {
        self.expanded[object.get()] = true;
        let circles = self.circles(layout, object);
        let reach = circles.iter().map(|circle| circle.radius).fold(0.0, f64::max) + self.span;
        let others: Vec<ObjectIndex> =
            layout.near(circles[0].centre, reach).map(|(o, _)| o).filter(|o| !self.expanded[o.get()]).collect();
        circles.iter().for_each(|&circle| self.expand_circle(circle));
        for other in others {
            let theirs = self.circles(layout, other);
            for (a, b) in circles.iter().flat_map(|a| theirs.iter().map(move |b| (a, b))) {
                a.meet(b).into_iter().flatten().for_each(|at| self.add_place(at));
            }
        }
        for corner in self.corners.clone() {
            circles.iter().filter_map(|circle| circle.meet(&corner)).flatten().for_each(|at| self.add_place(at));
        }
    }

    fn expand_circle(&mut self, circle: Circle) {
        for line in self.lines.clone() {
            circle.meet_line(line).into_iter().flatten().for_each(|at| self.add_place(at));
        }
        circle.extremes(self.origin).into_iter().for_each(|at| self.add_place(at));
    }
}

/// How many places are spread over the table.
const SPREAD: u32 = 1024;

/// The digits of `n` mirrored at the point: Halton's sequence, evenly spread at any length.
fn radical_inverse(mut n: u32, base: u32) -> f64 {
    let (mut result, mut digit) = (0.0, 1.0 / f64::from(base));
    while n > 0 {
        result += f64::from(n % base) * digit;
        n /= base;
        digit /= f64::from(base);
    }
    result
}
