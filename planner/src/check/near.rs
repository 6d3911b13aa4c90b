//! Finds near objects: one tree of boxes over the objects at the start, and one over the new places of the steps.
//!
//! All places are known before the replay begins, so the trees never change; a caller skips places that are empty at
//! its step. Each box knows how far the objects in it extend, so a huge one costs only the boxes above it.

use std::collections::HashMap;
use std::rc::Rc;

use nalgebra::{Point2, Vector2};
use smallvec::SmallVec;

use crate::scene::{ObjectIndex, Scene};
use crate::statement::Step;

use super::allowed::Allowed;
use super::body::Body;
use super::measure::{away, gap};
use super::names::ObjectNames;
use super::poses::{at_every_yaw, is_place};

/// The number of a place. At the start, the n-th object stands on place n.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct PlaceIndex(usize);

/// The place of what was taken away: no place on the table.
const GONE: PlaceIndex = PlaceIndex(usize::MAX);

/// Every place of the start and of the stated steps.
pub(super) struct Places {
    start: Rc<Tree>,
    steps: Tree,
    /// Per place of the steps the object put there.
    owners: Vec<ObjectIndex>,
    /// For each step its new place on the table; `None` if it has none, or can't be carried out.
    of_steps: Vec<Option<PlaceIndex>>,
}

/// The place of each object at a step.
#[derive(Default)]
pub(super) struct Standing {
    /// The places of objects that were moved.
    moved: HashMap<ObjectIndex, PlaceIndex>,
}

impl Standing {
    /// The place of an object that is not [gone](Self::gone).
    pub(super) fn place(&self, object: ObjectIndex) -> PlaceIndex {
        self.moved.get(&object).copied().unwrap_or(PlaceIndex(object.get()))
    }

    /// True if the object was taken away.
    pub(super) fn gone(&self, object: ObjectIndex) -> bool {
        self.moved.get(&object) == Some(&GONE)
    }

    /// The object leaves the table.
    pub(super) fn take_away(&mut self, object: ObjectIndex) {
        self.moved.insert(object, GONE);
    }

    pub(super) fn put(&mut self, object: ObjectIndex, place: PlaceIndex) {
        self.moved.insert(object, place);
    }
}

/// Bodies by nearness.
pub(super) struct Tree {
    bodies: Vec<Body>,
    boxes: Vec<Bounds>,
    /// Numbers of bodies, so that each box holds a run of them.
    order: Vec<usize>,
}

struct Bounds {
    min: Point2<f64>,
    max: Point2<f64>,
    /// How far the bodies reach from their origins, at most, m.
    extent: f64,
    run: core::ops::Range<usize>,
    children: Option<[usize; 2]>,
}

/// Places in a box that is not divided further.
const LEAF: usize = 8;

/// True if the edge of a body is nearer to a point than `reach`, m.
fn comes_within(body: &Body, point: Point2<f64>, reach: f64) -> bool {
    // The square costs less than a distance to all sides.
    let far = reach + body.extent;
    (body.is_disc() || (body.pose.at - point).norm_squared() < far * far) && away(body, point) < reach
}

impl Places {
    /// `start` holds the scene's objects.
    pub(super) fn new(
        scene: &Scene,
        start: &Rc<Tree>,
        steps: &[Step],
        names: &ObjectNames<'_>,
        allowed: &Allowed<'_>,
    ) -> Self {
        let (mut bodies, mut owners) = (Vec::new(), Vec::new());
        let of_steps = steps.iter().map(|step| {
            let (object, to) = (names.find(step.object())?, step.rests_at()?);
            let liftable = allowed.graspable(object) && !scene.goal().is_candidate(object);
            let pose = if at_every_yaw(scene, object) { to.at.into() } else { to.into() };
            (liftable && is_place(scene, object, to)).then(|| {
                bodies.push(Body::new(scene.object(object).footprint().shape(), pose));
                owners.push(object);
                PlaceIndex(start.bodies.len() + bodies.len() - 1)
            })
        });
        let of_steps = of_steps.collect();
        Self { start: Rc::clone(start), steps: Tree::new(bodies), owners, of_steps }
    }

    /// What stands on a place.
    pub(super) fn body(&self, PlaceIndex(place): PlaceIndex) -> &Body {
        let start = &self.start.bodies;
        start.get(place).unwrap_or_else(|| &self.steps.bodies[place - start.len()])
    }

    /// An object where it stands at the start.
    pub(super) fn at_start(&self, object: ObjectIndex) -> &Body {
        self.start.body(object.get())
    }

    /// The object that belongs to the place.
    pub(super) fn owner(&self, PlaceIndex(place): PlaceIndex) -> ObjectIndex {
        place.checked_sub(self.start.bodies.len()).map_or_else(|| ObjectIndex::new(place), |step| self.owners[step])
    }

    /// The new place of a step, if it can be carried out.
    pub(super) fn of_step(&self, step: usize) -> Option<PlaceIndex> {
        self.of_steps[step]
    }

    /// Visit every place whose object comes nearer than `reach` to `centre` (edge to point, m).
    pub(super) fn within(&self, centre: Point2<f64>, reach: f64, mut visit: impl FnMut(PlaceIndex)) {
        self.start.within(centre, reach, |at| visit(PlaceIndex(at)));
        self.steps.within(centre, reach, |at| visit(PlaceIndex(self.start.bodies.len() + at)));
    }

    /// The least gap from `body` to an object on a place that `counts`, m; infinite if there is none.
    pub(super) fn least_gap(&self, body: &Body, counts: impl Fn(PlaceIndex) -> bool) -> f64 {
        let at_start = self.start.least_gap(body, |at| counts(PlaceIndex(at)));
        at_start.min(self.steps.least_gap(body, |at| counts(PlaceIndex(self.start.bodies.len() + at))))
    }
}

impl Tree {
    pub(super) fn new(bodies: Vec<Body>) -> Self {
        let order = (0..bodies.len()).collect();
        let mut tree = Self { bodies, boxes: Vec::new(), order };
        tree.divide(0..tree.order.len());
        tree
    }

    /// The objects of a scene at their places at the start: the n-th is the n-th object's.
    pub(super) fn of_start(scene: &Scene) -> Rc<Self> {
        Rc::new(Self::new(scene.objects().iter().map(|object| Body::of(object.footprint())).collect()))
    }

    /// The n-th body.
    pub(super) fn body(&self, at: usize) -> &Body {
        &self.bodies[at]
    }

    /// Box the run and divide it at the median of its longer side. Returns the box's number. The depth is logarithmic
    /// whatever the points are, as a run is halved by rank.
    fn divide(&mut self, run: core::ops::Range<usize>) -> usize {
        let bounds = self.bounds(run.clone());
        let wide = bounds.max.x - bounds.min.x >= bounds.max.y - bounds.min.y;
        let at = self.boxes.len();
        self.boxes.push(bounds);
        if run.len() > LEAF {
            let place = |one: &usize| self.bodies[*one].pose.at;
            let key = |one: &usize| if wide { place(one).x } else { place(one).y };
            let half = run.len() / 2;
            self.order[run.clone()].select_nth_unstable_by(half, |a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
            let middle = run.start + half;
            self.boxes[at].children = Some([self.divide(run.start..middle), self.divide(middle..run.end)]);
        }
        at
    }

    fn bounds(&self, run: core::ops::Range<usize>) -> Bounds {
        let (far, near) =
            (Point2::new(f64::INFINITY, f64::INFINITY), Point2::new(f64::NEG_INFINITY, f64::NEG_INFINITY));
        let mut bounds = Bounds { min: far, max: near, extent: 0.0, run: run.clone(), children: None };
        for body in self.order[run].iter().map(|&at| &self.bodies[at]) {
            bounds.min = bounds.min.inf(&body.pose.at);
            bounds.max = bounds.max.sup(&body.pose.at);
            bounds.extent = bounds.extent.max(body.extent);
        }
        bounds
    }

    /// Visit every body that comes nearer than `reach` to `centre` (edge to point, m).
    pub(super) fn within(&self, centre: Point2<f64>, reach: f64, mut visit: impl FnMut(usize)) {
        let mut open: SmallVec<[usize; 32]> = SmallVec::from_slice(&[0]);
        while let Some(at) = open.pop() {
            let bounds = &self.boxes[at];
            if bounds.least_gap(centre) >= reach {
                continue;
            }
            if let Some(children) = bounds.children {
                open.extend(children);
                continue;
            }
            for &at in &self.order[bounds.run.clone()] {
                if comes_within(&self.bodies[at], centre, reach) {
                    visit(at);
                }
            }
        }
    }

    /// The least gap from `body` to one that `counts`, m; infinite if there is none.
    fn least_gap(&self, body: &Body, counts: impl Fn(usize) -> bool) -> f64 {
        let (origin, own) = (body.pose.at, body.extent);
        let mut least = f64::INFINITY;
        let mut open: SmallVec<[(usize, f64); 32]> = SmallVec::from_slice(&[(0, f64::NEG_INFINITY)]);
        while let Some((at, bound)) = open.pop() {
            if bound >= least {
                continue;
            }
            let bounds = &self.boxes[at];
            if let Some(children) = bounds.children {
                let mut pair = children.map(|child| (child, self.boxes[child].least_gap(origin) - own));
                // The nearer box is looked at first, so it is pushed last.
                pair.sort_by(|a, b| b.1.total_cmp(&a.1));
                open.extend(pair);
                continue;
            }
            for &at in self.order[bounds.run.clone()].iter().filter(|at| counts(**at)) {
                least = least.min(gap(body, &self.bodies[at]));
            }
        }
        least
    }
}

impl Bounds {
    /// No body with its origin in the box has its edge nearer to the point than this, m.
    fn least_gap(&self, point: Point2<f64>) -> f64 {
        let outside = Vector2::new(
            (self.min.x - point.x).max(point.x - self.max.x).max(0.0),
            (self.min.y - point.y).max(point.y - self.max.y).max(0.0),
        );
        outside.norm() - self.extent
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Footprint;
    use crate::scene::scenes::TestScene;

    fn crowd() -> Scene {
        let mut scene = TestScene::new(3).table(10.0, 10.0);
        for n in 0..400_u32 {
            let (x, y) = (f64::from(n % 20) * 0.5 + 0.25, f64::from(n / 20) * 0.5 + 0.25);
            let radius = if n == 210 { 0.2 } else { 0.001 * f64::from(n * 7 % 40 + 1) };
            scene = scene.disc(&format!("d{n}"), x, y, radius);
        }
        scene.build("d0")
    }

    #[test]
    fn the_tree_finds_what_a_scan_finds() {
        let scene = crowd();
        let start = Tree::of_start(&scene);
        for n in 0..100_u32 {
            let centre = Point2::new(f64::from(n * 37 % 101) / 10.0, f64::from(n * 53 % 97) / 10.0);
            let reach = 0.05 * f64::from(n % 20);
            let mut found = Vec::new();
            start.within(centre, reach, |at| found.push(at));
            found.sort_unstable();
            let scan = start.bodies.iter().enumerate().filter(|(_, body)| away(body, centre) < reach);
            assert_eq!(found, scan.map(|(at, _)| at).collect::<Vec<_>>());
            let probe = Body::of(&Footprint::disc(centre, 0.001));
            let least = start.least_gap(&probe, |at| at % 3 == 0);
            let scan = start.bodies.iter().step_by(3).map(|body| gap(&probe, body));
            let scan = scan.fold(f64::INFINITY, f64::min);
            assert!(least == scan || (least - scan).abs() < 1e-12, "{least} {scan}");
        }
    }
}
