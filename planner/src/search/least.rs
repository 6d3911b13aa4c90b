//! Implicit hitting set search: least hitting set → forward chaining → new landmark.

use super::clauses::{Facts, MaxSat};
use super::forward_chaining::ForwardChaining;
use super::hitting::Allowance;
use super::outcome::{Derivation, Incumbent, LeastSet, Memory, Progress, Restriction, SILENT, SearchOutcome};
use super::preprocessing::{Preprocessed, preprocess};
use super::problem::{HornRules, Node};
use super::{hitting, incumbent, landmark, proof};
use crate::budget::{Budget, Interrupted, Stop, Ticker};
use crate::cost::Cost;
use crate::knowledge::KnowledgeBase;
use crate::scene::ObjectIndex;

/// Landmarks per node after which greedy hitting sets give way to least ones. Easy bases have far fewer.
const LANDMARKS_A_NODE: usize = 4;
/// The first turns of least hitting sets (choices) and of MaxSAT (conflicts), some tenths of a second each. Problems
/// that suit hitting sets take fewer choices.
const FIRST_TURN: (usize, u64) = (500, 50_000);

/// The least set of objects from which the target follows.
pub fn least(
    base: &KnowledgeBase,
    target: ObjectIndex,
    restriction: &Restriction,
    budget: &Budget<'_>,
) -> SearchOutcome {
    least_within(&Memory::default(), base, target, restriction, budget, SILENT)
}

/// [`least`] with other limits of memory, and telling of each incumbent.
pub fn least_within(
    memory: &Memory,
    base: &KnowledgeBase,
    target: ObjectIndex,
    restriction: &Restriction,
    budget: &Budget<'_>,
    progress: Progress<'_>,
) -> SearchOutcome {
    let mut ticker = Ticker::new(budget);
    let Preprocessed { problem, fact_landmarks } = match preprocess(base, target, restriction, &mut ticker) {
        Ok(Some(reduced)) => reduced,
        Ok(None) => return SearchOutcome::Underivable,
        Err(Interrupted) => return SearchOutcome::Interrupted(None),
    };
    let (mut forced, mut underived_required) = (fact_landmarks, Vec::new());
    for object in &restriction.required {
        // No least set holds an object on which the target does not depend.
        if ticker.step(1 + (problem.movable() + forced.len()) / 256).is_err() {
            return SearchOutcome::Interrupted(None);
        }
        let Some(node) = problem.node(*object) else { return SearchOutcome::Underivable };
        if !forced.contains(&node) {
            forced.push(node);
            underived_required.push(node);
        }
    }
    let Ok(mut search) = HittingSetSearch::new(&problem, forced, underived_required, memory, progress, &mut ticker)
    else {
        return SearchOutcome::Interrupted(None);
    };
    match search.run(&mut ticker) {
        Ok(()) => SearchOutcome::Least(search.known(&mut ticker)),
        Err(Interrupted) => SearchOutcome::Interrupted(Some(search.known(&mut ticker))),
    }
}

struct HittingSetSearch<'p> {
    problem: &'p HornRules,
    memory: &'p Memory,
    progress: Progress<'p>,
    /// Between two calls only the `forced` nodes are allowed.
    chain: ForwardChaining<'p>,
    /// The nodes in every set: required ones, and landmarks with a single member.
    forced: Vec<Node>,
    /// Forced nodes that a restriction requires: counted even if no rule derives them.
    underived_required: Vec<Node>,
    /// The landmarks with several members.
    landmarks: Vec<Vec<Node>>,
    /// The best set known, in an order in which it can be moved.
    best: Vec<Node>,
    /// No set has fewer nodes.
    bound: usize,
    /// The part of the bound that the landmarks prove.
    proven: usize,
}

impl<'p> HittingSetSearch<'p> {
    fn new(
        problem: &'p HornRules,
        forced: Vec<Node>,
        underived_required: Vec<Node>,
        memory: &'p Memory,
        progress: Progress<'p>,
        ticker: &mut Ticker<'_>,
    ) -> Result<Self, Interrupted> {
        let mut chain = ForwardChaining::new(problem);
        forced.iter().for_each(|&node| chain.allow(node));
        let best = incumbent::h_add(problem, ticker)?;
        let best = incumbent::derivation(&mut chain, &best, ticker).unwrap_or(best);
        let bound = forced.len();
        let (landmarks, proven) = (Vec::new(), bound);
        let mut search = Self {
            problem,
            memory,
            progress,
            chain,
            forced,
            underived_required,
            landmarks,
            best: Vec::new(),
            bound,
            proven,
        };
        search.best = search.with_forced(best);
        Ok(search)
    }

    fn report(&self) {
        let (cost, lower_bound) = (Cost::of_each(self.best.len()), Cost::of_each(self.bound));
        (self.progress)(Incumbent { cost, lower_bound });
    }

    fn run(&mut self, ticker: &mut Ticker<'_>) -> Result<(), Interrupted> {
        if self.best.len() <= self.bound {
            return Ok(());
        }
        let first = self.learn(&[], ticker);
        // The first landmarks are disjoint, so each counts.
        self.prove(self.forced.len() + self.landmarks.len());
        first?;
        self.learn_one_of_each(ticker)?;
        // Greedy hitting sets first: they are cheap, and each that fails gives new landmarks.
        let mut bounded_at = self.landmarks.len();
        loop {
            self.report();
            if self.best.len() <= self.bound {
                return Ok(());
            }
            if self.landmarks.len() > 2 * bounded_at {
                bounded_at = self.landmarks.len();
                self.raise_bound(ticker)?;
                continue;
            }
            if self.landmarks.len() > LANDMARKS_A_NODE * self.problem.movable() {
                break;
            }
            let candidate = hitting::greedy(&self.landmarks, ticker)?;
            if !self.learn(&candidate, ticker)? {
                break;
            }
        }
        self.settle(FIRST_TURN, ticker)
    }

    /// Least hitting sets and MaxSAT in turn. Each turn is twice as long as the last, since either of the two may be
    /// the one that ends.
    fn settle(&mut self, first: (usize, u64), ticker: &mut Ticker<'_>) -> Result<(), Interrupted> {
        let (mut choices, mut conflicts) = first;
        let mut max_sat = None;
        loop {
            if self.settle_by_hitting(choices, ticker)? {
                return Ok(());
            }
            let mut by_clauses = match max_sat.take() {
                Some(by_clauses) => by_clauses,
                None => self.max_sat_search(ticker)?,
            };
            let raised = by_clauses.raise(conflicts, self.best.len(), &mut |set| self.adopt(set, ticker));
            self.bound = self.bound.max(by_clauses.bound());
            self.report();
            if self.best.len() <= self.bound {
                return Ok(());
            }
            raised?;
            max_sat = Some(by_clauses);
            (choices, conflicts) = (choices.saturating_mul(2), conflicts.saturating_mul(2));
        }
    }

    /// The MaxSAT search, given the landmarks known so far.
    fn max_sat_search<'b>(&self, ticker: &mut Ticker<'b>) -> Result<MaxSat<'p, 'b>, Interrupted> {
        let facts = Facts {
            problem: self.problem,
            forced: &self.forced,
            underived_required: &self.underived_required,
            landmarks: &self.landmarks,
        };
        MaxSat::new(&facts, self.memory.literals, ticker)
    }

    /// Runs the main loop with at most so many choices. True if bound and best set meet.
    fn settle_by_hitting(&mut self, choices: usize, ticker: &mut Ticker<'_>) -> Result<bool, Interrupted> {
        let mut allowance = Allowance { choices, words: self.memory.words };
        while self.best.len() > self.bound {
            self.report();
            match self.least_hitting_set(&mut allowance, ticker) {
                Ok(Some(hit)) => self.learn(&hit, ticker)?,
                Ok(None) => return Ok(true),
                Err(Stop::Spent) => return Ok(false),
                Err(Stop::Interrupted) => return Err(Interrupted),
            };
        }
        Ok(true)
    }

    /// Raises the bound to one that the landmarks prove.
    fn prove(&mut self, bound: usize) {
        self.proven = self.proven.max(bound);
        self.bound = self.bound.max(bound);
    }

    /// Takes over `set`, made inclusion-minimal, if it is better than the best set. Returns the size of the best set.
    fn adopt(&mut self, set: &[Node], ticker: &mut Ticker<'_>) -> usize {
        if let Some(order) = incumbent::derivation(&mut self.chain, set, ticker)
            && order.len() < self.best.len()
        {
            let order = self.with_forced(order);
            if order.len() < self.best.len() {
                self.best = order;
            }
        }
        self.best.len()
    }

    fn raise_bound(&mut self, ticker: &mut Ticker<'_>) -> Result<(), Interrupted> {
        let forced = self.forced.len();
        let bound = forced + hitting::bound(&self.landmarks, self.best.len() - forced, ticker)?;
        self.prove(bound);
        Ok(())
    }

    /// A least hitting set of the landmarks, without the forced nodes; `None` if with them it is no smaller than the
    /// best set.
    fn least_hitting_set(
        &mut self,
        allowance: &mut Allowance,
        ticker: &mut Ticker<'_>,
    ) -> Result<Option<Vec<Node>>, Stop> {
        let forced = self.forced.len();
        let found = hitting::least(&self.landmarks, self.best.len() - forced, allowance, ticker);
        let reached = match &found {
            Ok(Some(hit)) => forced + hit.len(),
            Ok(None) => self.best.len(),
            Err(cut) => forced + cut.bound,
        };
        self.prove(reached);
        found.map_err(|cut| cut.stop)
    }

    /// Adds landmarks that need no chaining, around the target and the forced nodes, which every derivation grasps.
    fn learn_one_of_each(&mut self, ticker: &mut Ticker<'_>) -> Result<(), Interrupted> {
        let is_forced = self.members(&self.forced);
        for &object in self.forced.iter().chain(&[self.problem.target()]) {
            ticker.step(1 + self.problem.rules_of(object).len() / 64 + self.landmarks.len() / 64)?;
            if let Some(landmark) = landmark::one_of_each(self.problem, object, |node| is_forced[node as usize])
                && !self.landmarks.contains(&landmark)
            {
                self.landmarks.push(landmark);
            }
        }
        Ok(())
    }

    /// Per node whether it is one of `nodes`.
    fn members(&self, nodes: &[Node]) -> Vec<bool> {
        let mut members = vec![false; self.problem.movable() + 1];
        nodes.iter().for_each(|&node| members[node as usize] = true);
        members
    }

    /// Chains with only `candidate` and the forced nodes allowed. While the target does not follow, learns a landmark
    /// that no allowed node hits, and allows its members. True if it learnt any.
    fn learn(&mut self, candidate: &[Node], ticker: &mut Ticker<'_>) -> Result<bool, Interrupted> {
        ticker.step(1 + self.problem.movable() / 64)?;
        let start = self.chain.mark();
        candidate.iter().for_each(|&node| self.chain.allow(node));
        let (known, forced) = (self.landmarks.len(), self.forced.len());
        let mut result = Ok(());
        while result.is_ok() && !self.chain.reaches_target() {
            result = self.learn_one(ticker);
        }
        if result.is_ok() {
            let allowed = (0..self.problem.target()).filter(|&node| self.chain.is_allowed(node)).collect::<Vec<_>>();
            self.chain.undo(start);
            self.forced[forced..].iter().for_each(|&node| self.chain.allow(node));
            self.adopt(&allowed, ticker);
        } else {
            self.chain.undo(start);
        }
        result.map(|()| self.landmarks.len() + self.forced.len() > known + forced)
    }

    fn learn_one(&mut self, ticker: &mut Ticker<'_>) -> Result<(), Interrupted> {
        let landmark = landmark::extract(self.problem, &mut self.chain, self.problem.target(), ticker)?;
        landmark.iter().for_each(|&node| self.chain.allow(node));
        if let [node] = landmark[..] {
            self.forced.push(node);
        } else {
            self.landmarks.push(landmark);
        }
        Ok(())
    }

    /// Adds the forced nodes that are missing: a required node counts even if nothing in the set derives it.
    fn with_forced(&self, mut order: Vec<Node>) -> Vec<Node> {
        let is_there = self.members(&order);
        let missing: Vec<Node> = self.forced.iter().copied().filter(|&node| !is_there[node as usize]).collect();
        order.extend(missing);
        order
    }

    fn known(&self, ticker: &mut Ticker<'_>) -> LeastSet {
        let objects = |nodes: &[Node]| nodes.iter().map(|&node| self.problem.object(node)).collect::<Vec<_>>();
        let landmarks = self.forced.iter().map(|&node| vec![node]).chain(self.landmarks.iter().cloned()).collect();
        let mut landmarks: Vec<Vec<ObjectIndex>> =
            proof::concise(landmarks, self.proven, ticker).iter().map(|landmark| objects(landmark)).collect();
        landmarks.iter_mut().for_each(|landmark| landmark.sort_unstable());
        landmarks.sort_unstable_by(|a, b| a.len().cmp(&b.len()).then_with(|| a.cmp(b)));
        LeastSet {
            derivation: Derivation { order: objects(&self.best) },
            bound: Cost::of_each(self.bound),
            proven: Cost::of_each(self.proven),
            landmarks,
        }
    }
}
