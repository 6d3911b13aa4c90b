//! Goal-directed forward chaining: can the goal be reached while some objects are held?
//!
//! Only objects that could matter are visited: those that the goal names first, then the blockers of each visited object that
//! is not free yet. So in a crowd of thousands a landmark is checked among its neighbours.

use crate::budget::{Interrupted, Ticker};
use crate::scene::{ObjectIndex, Scene};

use super::allowed::Allowed;
use super::ring::Ring;
use super::rings::Rings;
use super::ways::{Way, grasp, way};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Visit {
    /// Must not be lifted.
    Held,
    /// In the queue.
    Queued,
    /// Visited, and had no free yaw.
    Waiting,
    /// Out of the way.
    Lifted,
}

/// The chaining of one scene. Its rings are shared by all questions, whatever their goals.
pub(super) struct Chain<'s> {
    rings: Rings<'s>,
    /// Per object its state, and the number of the question that set it: a new question needs no reset.
    states: Vec<(usize, Visit)>,
    question: usize,
    queue: Vec<ObjectIndex>,
    /// The objects lifted in the current question, in order.
    lifted: Vec<ObjectIndex>,
}

/// How a goal is reached.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Reached {
    /// The object that is grasped in the end, and how; `None` where all that is wanted was lifted.
    pub(super) grasped: Option<(ObjectIndex, Way)>,
    /// The objects lifted, in order. Not all need have to do with the goal.
    pub(super) lifted: Vec<ObjectIndex>,
}

impl<'s> Chain<'s> {
    pub(super) fn new(rings: Rings<'s>) -> Self {
        let states = vec![(0, Visit::Held); rings.count()];
        Self { rings, states, question: 0, queue: Vec::new(), lifted: Vec::new() }
    }

    pub(super) fn rings(&mut self) -> &mut Rings<'s> {
        &mut self.rings
    }

    /// Lifts objects one after the other, but none that may not be moved or that is `held`. Returns how the goal is reached, or
    /// `None` if it is not. `scene` is the scene of the rings, with any goal.
    pub(super) fn reaches_goal(
        &mut self,
        scene: &Scene,
        allowed: &Allowed<'_>,
        held: &[ObjectIndex],
        ticker: &mut Ticker<'_>,
    ) -> Result<Option<Reached>, Interrupted> {
        let goal = scene.goal();
        ticker.step(1 + (held.len() + goal.named().len()) / 100)?;
        self.question += 1;
        self.queue.clear();
        self.lifted.clear();
        for object in held {
            self.set(*object, Visit::Held);
        }
        let mut wanted = goal.wanted_away().len();
        for &object in goal.named() {
            if self.state(object).is_none() {
                self.enqueue(object);
            }
        }
        while let Some(object) = self.queue.pop() {
            let ring = self.rings.ring(object, ticker)?;
            ticker.step(1 + ring.len() / 64)?;
            let stands = |other| self.state(other) != Some(Visit::Lifted);
            if goal.is_candidate(object) {
                if let Some(way) = grasp(&self.rings, &ring, stands) {
                    return Ok(Some(Reached { grasped: Some((object, way)), lifted: self.lifted.clone() }));
                }
                self.wait(scene, allowed, object, &ring);
            } else if way(&self.rings, &ring, stands).is_some() {
                ticker.step(self.rings.watchers(object).len() / 50)?;
                self.lift(object);
                wanted -= usize::from(goal.wants_away(object));
                if wanted == 0 && !goal.wanted_away().is_empty() {
                    return Ok(Some(Reached { grasped: None, lifted: self.lifted.clone() }));
                }
            } else {
                self.wait(scene, allowed, object, &ring);
            }
        }
        Ok(None)
    }

    /// The object waits, so its blockers are visited.
    fn wait(&mut self, scene: &Scene, allowed: &Allowed<'_>, object: ObjectIndex, ring: &Ring) {
        self.set(object, Visit::Waiting);
        for other in ring.blockers() {
            if self.state(other).is_none() && allowed.relocatable(scene, other) {
                self.enqueue(other);
            }
        }
    }

    /// Lifts the object, and visits the waiting objects that it blocked once more.
    fn lift(&mut self, object: ObjectIndex) {
        self.set(object, Visit::Lifted);
        self.lifted.push(object);
        for at in 0..self.rings.watchers(object).len() {
            let watcher = self.rings.watchers(object)[at];
            if self.state(watcher) == Some(Visit::Waiting) {
                self.enqueue(watcher);
            }
        }
    }

    fn enqueue(&mut self, object: ObjectIndex) {
        self.set(object, Visit::Queued);
        self.queue.push(object);
    }

    fn set(&mut self, object: ObjectIndex, state: Visit) {
        self.states[object.get()] = (self.question, state);
    }

    /// `None` if the current question has not touched the object.
    fn state(&self, object: ObjectIndex) -> Option<Visit> {
        let (question, state) = self.states[object.get()];
        (question == self.question).then_some(state)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::budget::Budget;
    use crate::check::leaning::Leaning;
    use crate::check::near::Tree;
    use crate::scene::scenes::TestScene;

    /// Forward chaining over all objects, in rounds until nothing more can be lifted.
    fn naive(scene: &Scene, rings: &mut Rings<'_>, held: &[ObjectIndex], ticker: &mut Ticker<'_>) -> bool {
        let mut lifted = vec![false; scene.objects().len()];
        loop {
            let before = lifted.clone();
            for object in scene.indices().filter(|object| !held.contains(object) && !scene.goal().is_candidate(*object))
            {
                let ring = rings.ring(object, ticker).unwrap();
                lifted[object.get()] |= rings.free_yaw(&ring, |other| !lifted[other.get()]).is_some();
            }
            if lifted == before {
                let ring = rings.ring(scene.target().unwrap(), ticker).unwrap();
                return rings.free_yaw(&ring, |other| !lifted[other.get()]).is_some();
            }
        }
    }

    proptest! {
        #[test]
        fn asking_backwards_finds_what_chaining_everything_finds(
            fingers in 2_u32..=4,
            others in proptest::collection::vec((0.3..0.7_f64, 0.3..0.7_f64, 0.02..0.06_f64), 60),
            holds in proptest::collection::vec(proptest::collection::vec(1_usize..20, 0..5), 8),
        ) {
            let mut discs = vec![(0.5, 0.5, 0.05)];
            discs.extend(others);
            let scene = TestScene::new(fingers).scatter(&discs).build("d0");
            let (start, allowed) = (Tree::of_start(&scene), Allowed::new(&scene));
            let (budget, count) = (Budget::unlimited(), scene.objects().len());
            let mut ticker = Ticker::new(&budget);
            let mut rings = Rings::new(&scene, &start, Leaning::Blocked);
            let mut chain = Chain::new(Rings::new(&scene, &start, Leaning::Blocked));
            for hold in holds {
                let held: Vec<_> = hold.into_iter().filter(|at| *at < count).map(ObjectIndex::new).collect();
                let reached = chain.reaches_goal(&scene, &allowed, &held, &mut ticker).unwrap();
                prop_assert_eq!(reached.is_some(), naive(&scene, &mut rings, &held, &mut ticker));
            }
        }
    }
}
