//! Goal-directed forward chaining: can the target be freed while some objects are held?
//!
//! Only objects that could matter are visited: the target first, then the blockers of each visited object that is not
//! free yet. So in a crowd of thousands a landmark is checked among its neighbours.

use crate::budget::{Interrupted, Ticker};
use crate::scene::{ObjectIndex, Scene};

use super::rings::{Ring, Rings};
use super::ways::way;

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

/// The chaining of one scene. Its rings are shared by all questions, whatever their targets.
pub(super) struct Chain<'s> {
    rings: Rings<'s>,
    /// Per object its state, and the number of the question that set it: a new question needs no reset.
    states: Vec<(usize, Visit)>,
    question: usize,
    queue: Vec<ObjectIndex>,
    /// The objects lifted in the current question, in order.
    lifted: Vec<ObjectIndex>,
}

/// How a target is freed.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Freed {
    /// A free yaw of the target, rad.
    pub(super) yaw: f64,
    /// The objects lifted before it, in order. Not all need have to do with the target.
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

    /// Lifts objects one after the other, but never the target, a fixed object or one that is `held`. Returns how the
    /// target becomes free, or `None` if it stays blocked. `scene` is the scene of the rings, with any target.
    pub(super) fn frees_target(
        &mut self,
        scene: &Scene,
        held: &[ObjectIndex],
        ticker: &mut Ticker<'_>,
    ) -> Result<Option<Freed>, Interrupted> {
        ticker.step(1 + held.len() / 100)?;
        self.question += 1;
        self.queue.clear();
        self.lifted.clear();
        for object in held {
            self.set(*object, Visit::Held);
        }
        let target = scene.target();
        self.enqueue(target);
        while let Some(object) = self.queue.pop() {
            let ring = self.rings.ring(object, ticker)?;
            ticker.step(1 + ring.len() / 64)?;
            let stands = |other| self.state(other) != Some(Visit::Lifted);
            if object == target {
                if let Some(yaw) = self.rings.free_yaw(&ring, stands) {
                    return Ok(Some(Freed { yaw, lifted: self.lifted.clone() }));
                }
                self.wait(scene, object, &ring);
            } else if way(&self.rings, &ring, stands).is_some() {
                ticker.step(self.rings.watchers(object).len() / 50)?;
                self.lift(object);
            } else {
                self.wait(scene, object, &ring);
            }
        }
        Ok(None)
    }

    /// The object waits, so its blockers are visited.
    fn wait(&mut self, scene: &Scene, object: ObjectIndex, ring: &Ring) {
        self.set(object, Visit::Waiting);
        for other in ring.blockers() {
            if self.state(other).is_none() && !scene.object(other).fixed() {
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
    use crate::check::near::Tree;
    use crate::check::rings::Leaning;
    use crate::scene::scenes::TestScene;

    /// Forward chaining over all objects, in rounds until nothing more can be lifted.
    fn naive(scene: &Scene, rings: &mut Rings<'_>, held: &[ObjectIndex], ticker: &mut Ticker<'_>) -> bool {
        let mut lifted = vec![false; scene.objects().len()];
        loop {
            let before = lifted.clone();
            for object in scene.indices().filter(|object| !held.contains(object) && *object != scene.target()) {
                let ring = rings.ring(object, ticker).unwrap();
                lifted[object.get()] |= rings.free_yaw(&ring, |other| !lifted[other.get()]).is_some();
            }
            if lifted == before {
                let ring = rings.ring(scene.target(), ticker).unwrap();
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
            let start = Tree::of_start(&scene);
            let (budget, count) = (Budget::unlimited(), scene.objects().len());
            let mut ticker = Ticker::new(&budget);
            let mut rings = Rings::new(&scene, &start, Leaning::Blocked);
            let mut chain = Chain::new(Rings::new(&scene, &start, Leaning::Blocked));
            for hold in holds {
                let held: Vec<_> = hold.into_iter().filter(|at| *at < count).map(ObjectIndex::new).collect();
                let frees = chain.frees_target(&scene, &held, &mut ticker).unwrap();
                prop_assert_eq!(frees.is_some(), naive(&scene, &mut rings, &held, &mut ticker));
            }
        }
    }
}
