//! The main loop: hit, chain, learn.

use super::chain::Chain;
use super::clauses::{Known, Wishes};
use super::hitting::{Allowance, Stop};
use super::memory::Memory;
use super::outcome::{Derivation, LeastSet, Outcome, Restriction};
use super::pace::Pace;
use super::problem::{Node, Problem};
use super::reduction::{Reduced, reduce};
use super::{hitting, incumbent, landmark, proof};
use crate::budget::{Budget, Interrupted};
use crate::knowledge::KnowledgeBase;
use crate::scene::ObjectIndex;

/// Landmarks for each node after which cheap sets have taught what they can. Easy bases have fewer by far.
const ENOUGH: usize = 4;
/// How long least hitting sets and clauses go on at their first turns: choices, conflicts. Some tenths of a second; what
/// hitting sets are good at takes fewer choices.
const FIRST_TURN: (usize, u64) = (500, 50_000);

/// The least set of objects from which the target follows.
pub fn least(base: &KnowledgeBase, target: ObjectIndex, restriction: &Restriction, budget: &Budget<'_>) -> Outcome {
    least_within(&Memory::default(), base, target, restriction, budget)
}

/// The same with other limits of memory.
pub fn least_within(
    memory: &Memory,
    base: &KnowledgeBase,
    target: ObjectIndex,
    restriction: &Restriction,
    budget: &Budget<'_>,
) -> Outcome {
    let mut pace = Pace::new(budget);
    let Reduced { problem, necessary } = match reduce(base, target, restriction, &mut pace) {
        Ok(Some(reduced)) => reduced,
        Ok(None) => return Outcome::Underivable,
        Err(Interrupted) => return Outcome::Interrupted(None),
    };
    let (mut forced, mut excused) = (necessary, Vec::new());
    for object in &restriction.required {
        // What the target does not depend on is in no least set.
        if pace.step(1 + (problem.movable() + forced.len()) / 256).is_err() {
            return Outcome::Interrupted(None);
        }
        let Some(node) = problem.node(*object) else { return Outcome::Underivable };
        if !forced.contains(&node) {
            forced.push(node);
            excused.push(node);
        }
    }
    let Ok(mut search) = Search::new(&problem, forced, excused, memory, &mut pace) else {
        return Outcome::Interrupted(None);
    };
    match search.run(&mut pace) {
        Ok(()) => Outcome::Least(search.known(&mut pace)),
        Err(Interrupted) => Outcome::Interrupted(Some(search.known(&mut pace))),
    }
}

struct Search<'p> {
    problem: &'p Problem,
    memory: &'p Memory,
    /// Between two questions only what is `forced` may be moved.
    chain: Chain<'p>,
    /// What is in every set: required, or a landmark by itself.
    forced: Vec<Node>,
    /// What of that need not be graspable: it is required, whether it helps or not.
    excused: Vec<Node>,
    /// All other landmarks.
    landmarks: Vec<Vec<Node>>,
    best: Vec<Node>,
    bound: usize,
    /// As much of it as the landmarks prove.
    shown: usize,
}

impl<'p> Search<'p> {
    fn new(
        problem: &'p Problem,
        forced: Vec<Node>,
        excused: Vec<Node>,
        memory: &'p Memory,
        pace: &mut Pace<'_>,
    ) -> Result<Self, Interrupted> {
        let mut chain = Chain::new(problem);
        forced.iter().for_each(|&node| chain.allow(node));
        let best = incumbent::greedy(problem, pace)?;
        let best = incumbent::derivation(&mut chain, &best, pace).unwrap_or(best);
        let bound = forced.len();
        let (landmarks, shown) = (Vec::new(), bound);
        let mut search = Self { problem, memory, chain, forced, excused, landmarks, best: Vec::new(), bound, shown };
        search.best = search.with_forced(best);
        Ok(search)
    }

    fn run(&mut self, pace: &mut Pace<'_>) -> Result<(), Interrupted> {
        if self.best.len() <= self.bound {
            return Ok(());
        }
        let first = self.learn(&[], pace);
        // So far all are disjoint.
        self.show(self.forced.len() + self.landmarks.len());
        first?;
        self.learn_one_of_each(pace)?;
        // Cheap sets first: each that fails teaches more landmarks.
        let mut priced = self.landmarks.len();
        loop {
            pace.note(self.best.len(), self.bound);
            if self.best.len() <= self.bound {
                return Ok(());
            }
            if self.landmarks.len() > 2 * priced {
                priced = self.landmarks.len();
                self.raise_bound(pace)?;
                continue;
            }
            if self.landmarks.len() > ENOUGH * self.problem.movable() {
                break;
            }
            let candidate = hitting::greedy(&self.landmarks, pace)?;
            if !self.learn(&candidate, pace)? {
                break;
            }
        }
        self.settle(FIRST_TURN, pace)
    }

    /// Least hitting sets and clauses in turn, each turn twice as long as the one before: nobody knows which of the two
    /// comes to an end.
    fn settle(&mut self, first: (usize, u64), pace: &mut Pace<'_>) -> Result<(), Interrupted> {
        let (mut choices, mut conflicts) = first;
        let mut wishes = None;
        loop {
            if self.settle_by_hitting(choices, pace)? {
                return Ok(());
            }
            let mut by_clauses = match wishes.take() {
                Some(by_clauses) => by_clauses,
                None => self.wishes(pace)?,
            };
            let raised = by_clauses.raise(conflicts, self.best.len(), &mut |set| self.adopt(set, pace));
            self.bound = self.bound.max(by_clauses.bound());
            pace.note(self.best.len(), self.bound);
            if self.best.len() <= self.bound {
                return Ok(());
            }
            raised?;
            wishes = Some(by_clauses);
            (choices, conflicts) = (choices.saturating_mul(2), conflicts.saturating_mul(2));
        }
    }

    /// The question by clauses. It knows the landmarks of now; those of later turns it has no need of.
    fn wishes<'b>(&self, pace: &mut Pace<'b>) -> Result<Wishes<'p, 'b>, Interrupted> {
        let known =
            Known { problem: self.problem, forced: &self.forced, excused: &self.excused, landmarks: &self.landmarks };
        Wishes::new(&known, self.memory.literals, pace)
    }

    /// True if that many choices are enough.
    fn settle_by_hitting(&mut self, choices: usize, pace: &mut Pace<'_>) -> Result<bool, Interrupted> {
        let mut allowance = Allowance { choices, words: self.memory.words };
        while self.best.len() > self.bound {
            pace.note(self.best.len(), self.bound);
            match self.least_hitting_set(&mut allowance, pace) {
                Ok(Some(hit)) => self.learn(&hit, pace)?,
                Ok(None) => return Ok(true),
                Err(Stop::Spent) => return Ok(false),
                Err(Stop::Interrupted) => return Err(Interrupted),
            };
        }
        Ok(true)
    }

    /// No set is smaller, and the landmarks prove it.
    fn show(&mut self, bound: usize) {
        self.shown = self.shown.max(bound);
        self.bound = self.bound.max(bound);
    }

    /// The best set known, by what is needed of another one.
    fn adopt(&mut self, set: &[Node], pace: &mut Pace<'_>) -> usize {
        if let Some(order) = incumbent::derivation(&mut self.chain, set, pace)
            && order.len() < self.best.len()
        {
            let order = self.with_forced(order);
            if order.len() < self.best.len() {
                self.best = order;
            }
        }
        self.best.len()
    }

    fn raise_bound(&mut self, pace: &mut Pace<'_>) -> Result<(), Interrupted> {
        let forced = self.forced.len();
        let bound = forced + hitting::bound(&self.landmarks, self.best.len() - forced, pace)?;
        self.show(bound);
        Ok(())
    }

    /// A least set that meets all landmarks but those of what is forced; `None` if the best derivation is as small.
    fn least_hitting_set(&mut self, allowance: &mut Allowance, pace: &mut Pace<'_>) -> Result<Option<Vec<Node>>, Stop> {
        let forced = self.forced.len();
        let found = hitting::least(&self.landmarks, self.best.len() - forced, allowance, pace);
        let reached = match &found {
            Ok(Some(hit)) => forced + hit.len(),
            Ok(None) => self.best.len(),
            Err(cut) => forced + cut.bound,
        };
        self.show(reached);
        found.map_err(|cut| cut.stop)
    }

    /// Landmarks that are seen without chaining, round what every derivation grasps.
    fn learn_one_of_each(&mut self, pace: &mut Pace<'_>) -> Result<(), Interrupted> {
        let is_forced = self.members(&self.forced);
        for &object in self.forced.iter().chain(&[self.problem.target()]) {
            pace.step(1 + self.problem.rules_of(object).len() / 64 + self.landmarks.len() / 64)?;
            if let Some(landmark) = landmark::one_of_each(self.problem, object, |node| is_forced[node as usize])
                && !self.landmarks.contains(&landmark)
            {
                self.landmarks.push(landmark);
            }
        }
        Ok(())
    }

    /// Per node whether it is one of these.
    fn members(&self, nodes: &[Node]) -> Vec<bool> {
        let mut members = vec![false; self.problem.movable() + 1];
        nodes.iter().for_each(|&node| members[node as usize] = true);
        members
    }

    /// Chain with only `candidate` and what is forced movable. While the target does not follow, learn a landmark that
    /// none of what may be moved meets, and let all its members be moved. True if anything was learnt.
    fn learn(&mut self, candidate: &[Node], pace: &mut Pace<'_>) -> Result<bool, Interrupted> {
        pace.step(1 + self.problem.movable() / 64)?;
        let start = self.chain.mark();
        candidate.iter().for_each(|&node| self.chain.allow(node));
        let (known, forced) = (self.landmarks.len(), self.forced.len());
        let mut result = Ok(());
        while result.is_ok() && !self.chain.reaches_target() {
            result = self.learn_one(pace);
        }
        if result.is_ok() {
            // What was learnt in one go is disjoint from the candidate and from each other.
            let allowed = (0..self.problem.target()).filter(|&node| self.chain.is_allowed(node)).collect::<Vec<_>>();
            self.chain.undo(start);
            self.forced[forced..].iter().for_each(|&node| self.chain.allow(node));
            self.adopt(&allowed, pace);
        } else {
            self.chain.undo(start);
        }
        result.map(|()| self.landmarks.len() + self.forced.len() > known + forced)
    }

    fn learn_one(&mut self, pace: &mut Pace<'_>) -> Result<(), Interrupted> {
        let landmark = landmark::extract(self.problem, &mut self.chain, self.problem.target(), pace)?;
        landmark.iter().for_each(|&node| self.chain.allow(node));
        if let [node] = landmark[..] {
            self.forced.push(node);
        } else {
            self.landmarks.push(landmark);
        }
        Ok(())
    }

    /// A required object is in the set even where nothing in it makes that object graspable.
    fn with_forced(&self, mut order: Vec<Node>) -> Vec<Node> {
        let is_there = self.members(&order);
        let missing: Vec<Node> = self.forced.iter().copied().filter(|&node| !is_there[node as usize]).collect();
        order.extend(missing);
        order
    }

    fn known(&self, pace: &mut Pace<'_>) -> LeastSet {
        let objects = |nodes: &[Node]| nodes.iter().map(|&node| self.problem.object(node)).collect::<Vec<_>>();
        let landmarks = self.forced.iter().map(|&node| vec![node]).chain(self.landmarks.iter().cloned()).collect();
        let mut landmarks: Vec<Vec<ObjectIndex>> =
            proof::concise(landmarks, self.shown, pace).iter().map(|landmark| objects(landmark)).collect();
        landmarks.iter_mut().for_each(|landmark| landmark.sort_unstable());
        landmarks.sort_unstable_by(|a, b| a.len().cmp(&b.len()).then_with(|| a.cmp(b)));
        LeastSet {
            derivation: Derivation { order: objects(&self.best) },
            bound: self.bound,
            shown: self.shown,
            landmarks,
        }
    }
}
