//! The main loop: hit, chain, learn.

use super::chain::Chain;
use super::outcome::{Derivation, LeastSet, Outcome, Restriction};
use super::problem::{Node, Problem};
use super::reduction::reduce;
use super::{hitting_set, incumbent, landmark, proof};
use crate::budget::{Budget, Interrupted};
use crate::knowledge::KnowledgeBase;
use crate::scene::ObjectIndex;

/// The least set of objects from which the target follows.
pub fn least(base: &KnowledgeBase, target: ObjectIndex, restriction: &Restriction, budget: &Budget<'_>) -> Outcome {
    let problem = match reduce(base, target, restriction, budget) {
        Ok(Some(problem)) => problem,
        Ok(None) => return Outcome::Underivable,
        Err(Interrupted) => return Outcome::Interrupted(None),
    };
    let mut required = Vec::new();
    for &object in &restriction.required {
        // What the target does not depend on is in no least set.
        let Some(node) = problem.node(object) else { return Outcome::Underivable };
        required.push(node);
    }
    let Ok(mut search) = Search::new(&problem, required, budget) else { return Outcome::Interrupted(None) };
    match search.run(budget) {
        Ok(()) => Outcome::Least(search.known()),
        Err(Interrupted) => Outcome::Interrupted(Some(search.known())),
    }
}

struct Search<'p> {
    problem: &'p Problem,
    chain: Chain<'p>,
    /// Required objects stand here as landmarks with one member.
    landmarks: Vec<Vec<Node>>,
    required: Vec<Node>,
    best: Vec<Node>,
    bound: usize,
}

impl<'p> Search<'p> {
    fn new(problem: &'p Problem, required: Vec<Node>, budget: &Budget<'_>) -> Result<Self, Interrupted> {
        let landmarks = required.iter().map(|&node| vec![node]).collect();
        let mut search =
            Self { problem, chain: Chain::new(problem), landmarks, bound: required.len(), required, best: Vec::new() };
        search.best = search.minimal(&incumbent::greedy(problem, budget)?, budget);
        Ok(search)
    }

    fn run(&mut self, budget: &Budget<'_>) -> Result<(), Interrupted> {
        let required = self.required.clone();
        let first = self.learn(&required, budget);
        // So far all are disjoint.
        self.bound = self.landmarks.len();
        first?;
        // Cheap sets first: each that fails teaches more landmarks.
        loop {
            if self.best.len() <= self.bound {
                return Ok(());
            }
            let candidate = hitting_set::greedy(&self.landmarks);
            if !self.learn(&candidate, budget)? {
                break;
            }
        }
        loop {
            let hit = self.least_hitting_set(budget)?;
            if self.best.len() <= self.bound || !self.learn(&hit, budget)? {
                return Ok(());
            }
        }
    }

    fn least_hitting_set(&mut self, budget: &Budget<'_>) -> Result<Vec<Node>, Interrupted> {
        match hitting_set::least(&self.landmarks, budget) {
            Ok(hit) => {
                self.bound = self.bound.max(hit.len());
                Ok(hit)
            }
            Err(reached) => {
                self.bound = self.bound.max(reached);
                Err(Interrupted)
            }
        }
    }

    /// Chain with only `candidate` movable. While the target does not follow, learn a landmark that none of what may be
    /// moved meets, and let all its members be moved. True if anything was learnt.
    fn learn(&mut self, candidate: &[Node], budget: &Budget<'_>) -> Result<bool, Interrupted> {
        let start = self.chain.mark();
        candidate.iter().for_each(|&node| self.chain.allow(node));
        let known = self.landmarks.len();
        let result = loop {
            if self.chain.reaches_target() {
                break Ok(());
            }
            match landmark::extract(self.problem, &mut self.chain, budget) {
                Ok(landmark) => {
                    landmark.iter().for_each(|&node| self.chain.allow(node));
                    self.landmarks.push(landmark);
                }
                Err(Interrupted) => break Err(Interrupted),
            }
        };
        if result.is_ok() {
            // What was learnt in one go is disjoint from the candidate and from each other.
            let candidates: Vec<Node> = (0..self.problem.target()).filter(|&n| self.chain.is_allowed(n)).collect();
            let minimal = self.minimal(&candidates, budget);
            if minimal.len() < self.best.len() {
                self.best = minimal;
            }
        }
        self.chain.undo(start);
        result.map(|()| self.landmarks.len() > known)
    }

    /// A minimal derivation within the set, plus what is required.
    fn minimal(&self, set: &[Node], budget: &Budget<'_>) -> Vec<Node> {
        let with_required: Vec<Node> = set.iter().chain(&self.required).copied().collect();
        let mut order =
            incumbent::derivation(self.problem, &with_required, budget).unwrap_or_else(|| with_required.clone());
        let missing: Vec<Node> = self.required.iter().copied().filter(|node| !order.contains(node)).collect();
        order.extend(missing);
        order
    }

    fn known(&self) -> LeastSet {
        let objects = |nodes: &[Node]| nodes.iter().map(|&node| self.problem.object(node)).collect::<Vec<_>>();
        let mut landmarks: Vec<Vec<ObjectIndex>> = self.landmarks.iter().map(|landmark| objects(landmark)).collect();
        landmarks.iter_mut().for_each(|landmark| landmark.sort_unstable());
        landmarks.sort_unstable_by(|a, b| a.len().cmp(&b.len()).then_with(|| a.cmp(b)));
        let landmarks = proof::concise(landmarks, self.bound);
        LeastSet { derivation: Derivation { order: objects(&self.best) }, bound: self.bound, landmarks }
    }
}
