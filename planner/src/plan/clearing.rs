//! Clears a table: takes away all that can go, the nearest first.

use std::collections::HashSet;

use nalgebra::Point2;
use rstar::RTree;
use rstar::primitives::GeomWithData;

use super::answer::{Statistics, timed};
use super::choice::{Choice, MOST_OBJECTS};
use super::confirm::PlanError;
use super::reasons::{grasped, greatest_lock};
use super::shares::{PLACEMENT_SHARE, SEARCH_SHARE};
use super::stated::{locked, step};
use crate::budget::{Budget, Interrupted, Ticker};
use crate::geometry::Grasp;
use crate::knowledge::{Chaining, KnowledgeBase, NoBase, SweptFinger, complete, derivable};
use crate::placement::{DropOffs, Layout, Move, Removal};
use crate::scene::{Object, ObjectIndex, Scene};
use crate::statement::{Deadlock, Statement, Step, Verdict};

/// The statement of a clearing. Where time ends, its steps so far.
///
/// # Errors
/// [`PlanError`]: the objects stand too dense, or knowledge and geometry contradict each other.
pub(super) fn stated(scene: &Scene, budget: &Budget<'_>, times: &mut Statistics) -> Result<Statement, PlanError> {
    let known = timed(&mut times.knowledge, budget, || Known::of(scene, &budget.share(SEARCH_SHARE)));
    let known = match known {
        Ok(known) => known,
        Err(NoBase::Interrupted) => return Ok(Statement::uncleared(scene)),
        Err(NoBase::TooLarge) => return Err(PlanError::TooDense),
    };
    let sought = || Plan::seek(scene, &known, &budget.share(SEARCH_SHARE));
    let plan = timed(&mut times.search, budget, sought);
    let rest = budget.share(PLACEMENT_SHARE);
    let taken = timed(&mut times.placement, budget, || steps(scene, &known, plan.choice, &rest))?;
    let proven = plan.most.is_some_and(|most| most == taken.len());
    Ok(Statement::clearing(scene, taken, known.stuck, proven))
}

/// What can go if drop-offs had no limits, and what can't.
struct Known {
    base: KnowledgeBase,
    /// In index order.
    loose: Vec<ObjectIndex>,
    stuck: Option<Deadlock>,
}

impl Known {
    fn of(scene: &Scene, budget: &Budget<'_>) -> Result<Self, NoBase> {
        let base = complete(scene, &SweptFinger, budget)?;
        let derivable = derivable(&base, |_| false, budget)?;
        let mut loose = derivable.order.clone();
        loose.sort_unstable();
        let held = scene.indices().find(|&object| scene.movable(object) && !derivable.derives(object));
        // Steps are worth more than the lock: a late one is left out.
        let locks = held.and_then(|object| greatest_lock(scene, &base, &derivable, &[object], budget).ok());
        let stuck = locks.map(|locks| locked(scene, &locks.blocked, &locks.core));
        Ok(Self { base, loose, stuck })
    }
}

/// How many objects can be taken away at most, and how to choose them.
struct Plan {
    /// `None` where that is not known.
    most: Option<usize>,
    /// `None` where they go as they come: every order leads to as many, or there are too many to choose the best.
    choice: Option<Choice>,
}

impl Plan {
    fn seek(scene: &Scene, known: &Known, budget: &Budget<'_>) -> Self {
        let mut ticker = Ticker::new(budget);
        Self::sought(scene, known, &mut ticker).unwrap_or(Self { most: None, choice: None })
    }

    fn sought(scene: &Scene, Known { base, loose, .. }: &Known, ticker: &mut Ticker<'_>) -> Result<Self, Interrupted> {
        let mut drop_offs = DropOffs::new(scene);
        let mut held = 0;
        for &object in loose {
            held += usize::from(drop_offs.take(object, |looks| ticker.step(looks))?);
        }
        // The drop-offs hold no more than this, whatever the order.
        if held == loose.len() || loose.len() > MOST_OBJECTS {
            return Ok(Self { most: Some(held), choice: None });
        }
        let mut choice = Choice::new(scene, base, loose, held);
        let most = choice.most(ticker)?;
        Ok(Self { most: Some(most), choice: Some(choice) })
    }
}

/// The steps, nearest first: each the nearest to the axis of the last grasp, the first to the table's corner.
fn steps(
    scene: &Scene,
    known: &Known,
    mut choice: Option<Choice>,
    budget: &Budget<'_>,
) -> Result<Vec<Removal>, PlanError> {
    let mut taken: Vec<Removal> = Vec::new();
    let Ok(mut chaining) = Chaining::new(&known.base, budget) else { return Ok(taken) };
    let (mut layout, mut drop_offs) = (Layout::new(scene, &SweptFinger), DropOffs::new(scene));
    let (mut frontier, mut seen) = (Frontier::new(scene), 0);
    let (mut axis, mut ticker) = (scene.table().top().min(), Ticker::new(budget));
    let mut gone = Vec::new();
    loop {
        frontier.add(&chaining.known().order[seen..]);
        seen = chaining.known().order.len();
        let Ok(next) = frontier.next(axis, |object| match &mut choice {
            Some(choice) => choice.leads_on(&gone, object, &mut ticker),
            None => drop_offs.take(object, |looks| ticker.step(looks)),
        }) else {
            break;
        };
        let Some(object) = next else { break };
        if choice.is_some() && drop_offs.take(object, |looks| ticker.step(looks)).is_err() {
            break;
        }
        let from = layout.footprint(object).pose();
        let grasp: Grasp = grasped(scene, object, layout.grasp(object))?;
        layout.take_away(object);
        chaining.move_away(object);
        gone.push(object);
        taken.push(Removal { object, from, grasp, drop_off: 0 });
        axis = grasp.axis;
    }
    let places = drop_offs.places();
    taken.iter_mut().for_each(|removal| removal.drop_off = places[removal.object.get()].unwrap_or_default());
    Ok(taken)
}

/// A graspable object and its origin.
type Graspable = GeomWithData<[f64; 2], ObjectIndex>;

/// The objects that can be grasped and still stand.
struct Frontier<'a> {
    scene: &'a Scene,
    tree: RTree<Graspable>,
}

impl<'a> Frontier<'a> {
    fn new(scene: &'a Scene) -> Self {
        Self { scene, tree: RTree::new() }
    }

    fn add(&mut self, objects: &[ObjectIndex]) {
        if self.tree.size() == 0 {
            self.tree = RTree::bulk_load(objects.iter().map(|&object| self.entry(object)).collect());
        } else {
            objects.iter().for_each(|&object| self.tree.insert(self.entry(object)));
        }
    }

    fn entry(&self, object: ObjectIndex) -> Graspable {
        let at = self.scene.object(object).footprint().at();
        GeomWithData::new([at.x, at.y], object)
    }

    /// Takes out the nearest object to `axis` that `may_go`; among equally near ones the first by index. Those that may not are
    /// dropped: what has no room, or is in no greatest choice, has none and is in none later either.
    fn next(
        &mut self,
        axis: Point2<f64>,
        mut may_go: impl FnMut(ObjectIndex) -> Result<bool, Interrupted>,
    ) -> Result<Option<ObjectIndex>, Interrupted> {
        loop {
            let nearest = self.tree.nearest_neighbors(&[axis.x, axis.y]);
            let Some(entry) = nearest.into_iter().min_by_key(|entry| entry.data).copied() else { return Ok(None) };
            self.tree.remove(&entry);
            if may_go(entry.data)? {
                return Ok(Some(entry.data));
            }
        }
    }
}

impl Statement {
    /// Nothing is taken away.
    pub(super) fn uncleared(scene: &Scene) -> Self {
        Self::clearing(scene, Vec::new(), None, false)
    }

    /// A clearing. Only `true` is stated of its proof: the checker may show more than the planner knew in time.
    fn clearing(scene: &Scene, taken: Vec<Removal>, stuck: Option<Deadlock>, proven: bool) -> Self {
        let steps = taken.into_iter().map(|removal| step(scene, &Move::Drop(removal))).collect();
        Self { stuck, proven: proven.then_some(true), ..Self::cleared_by(scene, steps) }
    }

    /// The first steps of a clearing.
    pub(super) fn up_to_step(self, scene: &Scene, count: usize) -> Self {
        let steps = self.relocations.unwrap_or_default().into_iter().take(count).collect();
        Self { stuck: self.stuck, ..Self::cleared_by(scene, steps) }
    }

    fn cleared_by(scene: &Scene, steps: Vec<Step>) -> Self {
        let gone: HashSet<&str> = steps.iter().map(Step::object).collect();
        let stays = |object: &&Object| !object.fixed() && !gone.contains(object.id());
        let left: Vec<String> = scene.objects().iter().filter(stays).map(|object| object.id().to_owned()).collect();
        Self {
            verdict: Some(if left.is_empty() { Verdict::Cleared } else { Verdict::PartlyCleared }),
            cost: Some(steps.iter().map(Step::cost).sum()),
            relocations: Some(steps),
            left: Some(left),
            ..Self::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::budget::clocks::Looks;
    use crate::check::Checker;
    use crate::plan::{Settings, plan};
    use crate::scene::GoalDraft;
    use crate::scene::scenes::TestScene;
    use crate::search::SILENT;

    /// A row of five plates, the second of them fixed; the first and the last two can be taken away one after the other.
    fn row(capacity: Option<u32>, accepts: Option<&[&str]>) -> Scene {
        let mut scene = TestScene::new(2).finger(0.04, 0.05);
        for (n, x) in [0.2, 0.37, 0.54, 0.71, 0.88].into_iter().enumerate() {
            scene = scene.disc(&format!("p{n}"), x, 1.0, 0.08);
        }
        scene = scene.disc("cup", 0.54, 1.13, 0.04).fix("p1").drop_off("tray", capacity, None);
        scene.drop_off("box", None, accepts.or(Some(&[]))).with_goal(GoalDraft::Clear)
    }

    #[test]
    fn wherever_time_ends_the_steps_so_far_are_served() {
        for scene in [row(None, None), row(Some(2), Some(&["p3"])), row(Some(1), Some(&["p2", "p4"]))] {
            let whole = plan(&scene, &Settings::default(), &Budget::unlimited(), SILENT).unwrap().statement;
            assert_eq!(whole.proven, Some(true));
            let mut cut = 0;
            for looks in 0..200 {
                let clock = Looks::ending_after(looks);
                let part = plan(&scene, &Settings::default(), &clock.budget(), SILENT).unwrap().statement;
                let report = Checker::new(&scene).check(&part, &Budget::unlimited());
                assert_eq!(report.faults, [], "{part:?}");
                assert!(part.proven.is_some() && whole.steps().len() >= part.steps().len());
                assert!(part.proven == Some(false) || part.steps().len() == whole.steps().len(), "{part:?}");
                cut += usize::from(part != whole);
            }
            assert!(cut > 10, "{cut}");
        }
    }
}
