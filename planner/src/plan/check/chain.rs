//! What can be lifted while some objects are held: forward chaining, asked backwards from the target.
//!
//! Only objects that could matter are looked at: the target first, then whoever blocks an object that is not free yet. In
//! a crowd of thousands a landmark is decided among its neighbours.

use crate::budget::Interrupted;
use crate::scene::{ObjectIndex, Scene};

use super::meter::Meter;
use super::rings::{Ring, Rings};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    /// Must not be lifted.
    Held,
    /// Will be looked at.
    Queued,
    /// Was looked at and had no free yaw.
    Waiting,
    /// Out of the way.
    Lifted,
}

/// The chaining of one scene; its rings serve question after question.
pub(super) struct Chain<'a> {
    scene: &'a Scene,
    rings: Rings<'a>,
    /// The state of each object and the question to which it belongs, so that a new question begins with no work.
    states: Vec<(usize, State)>,
    question: usize,
    queue: Vec<ObjectIndex>,
}

impl<'a> Chain<'a> {
    pub(super) fn new(scene: &'a Scene, rings: Rings<'a>) -> Self {
        let states = vec![(0, State::Held); scene.objects().len()];
        Self { scene, rings, states, question: 0, queue: Vec::new() }
    }

    /// True if the target gets a free yaw once everything is lifted that can be lifted, one after the other, but the
    /// target itself, the fixed objects and those that are `held`.
    pub(super) fn frees_target(&mut self, held: &[ObjectIndex], meter: &mut Meter<'_>) -> Result<bool, Interrupted> {
        meter.spend(1 + held.len() / 100)?;
        self.question += 1;
        self.queue.clear();
        for object in held {
            self.set(*object, State::Held);
        }
        let target = self.scene.target();
        self.enqueue(target);
        while let Some(object) = self.queue.pop() {
            let ring = self.rings.ring(object, meter)?;
            meter.spend(1 + ring.len() / 64)?;
            if !self.rings.is_free(&ring, |other| self.state(other) != Some(State::Lifted)) {
                self.wait(object, &ring);
            } else if object == target {
                return Ok(true);
            } else {
                meter.spend(self.rings.watchers(object).len() / 50)?;
                self.lift(object);
            }
        }
        Ok(false)
    }

    /// The object's blockers matter from now on.
    fn wait(&mut self, object: ObjectIndex, ring: &Ring) {
        self.set(object, State::Waiting);
        for other in ring.blockers() {
            if self.state(other).is_none() && !self.scene.object(other).fixed() {
                self.enqueue(other);
            }
        }
    }

    /// Those that wait with this one in their way get another look.
    fn lift(&mut self, object: ObjectIndex) {
        self.set(object, State::Lifted);
        for at in 0..self.rings.watchers(object).len() {
            let watcher = self.rings.watchers(object)[at];
            if self.state(watcher) == Some(State::Waiting) {
                self.enqueue(watcher);
            }
        }
    }

    fn enqueue(&mut self, object: ObjectIndex) {
        self.set(object, State::Queued);
        self.queue.push(object);
    }

    fn set(&mut self, object: ObjectIndex, state: State) {
        self.states[object.get()] = (self.question, state);
    }

    /// `None` if the current question has not touched the object.
    fn state(&self, object: ObjectIndex) -> Option<State> {
        let (question, state) = self.states[object.get()];
        (question == self.question).then_some(state)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::budget::Budget;
    use crate::plan::check::names::Names;
    use crate::plan::check::near::Places;
    use crate::plan::check::rings::Leaning;
    use crate::scene::scenes::TestScene;

    /// Forward, over everything, again and again until nothing more can be lifted.
    fn naive(scene: &Scene, rings: &mut Rings<'_>, held: &[ObjectIndex], meter: &mut Meter<'_>) -> bool {
        let mut lifted = vec![false; scene.objects().len()];
        loop {
            let before = lifted.clone();
            for object in scene.indices().filter(|object| !held.contains(object) && *object != scene.target()) {
                let ring = rings.ring(object, meter).unwrap();
                lifted[object.get()] |= rings.is_free(&ring, |other| !lifted[other.get()]);
            }
            if lifted == before {
                let ring = rings.ring(scene.target(), meter).unwrap();
                return rings.is_free(&ring, |other| !lifted[other.get()]);
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
            let names = Names::new(&scene);
            let places = Places::new(&scene, &[], &names);
            let (budget, count) = (Budget::unlimited(), scene.objects().len());
            let mut meter = Meter::new(&budget);
            let mut rings = Rings::new(&scene, &places, Leaning::Blocked);
            let mut chain = Chain::new(&scene, Rings::new(&scene, &places, Leaning::Blocked));
            for hold in holds {
                let held: Vec<_> = hold.into_iter().filter(|at| *at < count).map(ObjectIndex::new).collect();
                let frees = chain.frees_target(&held, &mut meter).unwrap();
                prop_assert_eq!(frees, naive(&scene, &mut rings, &held, &mut meter));
            }
        }
    }
}
