//! Depth-first branch and bound, with the open questions in a list rather than on the stack.
//!
//! Instances take memory, and a search may be as deep as there are elements. Past the memory limit the oldest instances
//! are forgotten: they are large and their turn seldom comes. When it does, they are computed again from the root.

use super::branch::{Question, Sight, look};
use super::fork::{Fork, Next, Parts};
use super::instance::{Decided, Instance};
use super::multipliers::{initialise, raise};
use super::reduce::reduce;
use super::{Cut, Solution};
use crate::budget::{Interrupted, Stop, Ticker};
use crate::search::problem::Node;

/// Subgradient rounds for a part at the root, which inherits no multipliers.
const FIRST_ROUNDS: usize = 100;

/// The limits of one search.
#[derive(Debug, Clone, Copy)]
pub(in crate::search) struct Allowance {
    /// Choices left; counted down.
    pub(in crate::search) choices: usize,
    /// Memory of the open questions without the last one, in 64-bit words.
    pub(in crate::search) words: usize,
}

/// A least hitting set of all landmarks, if it has fewer than `limit` members.
///
/// # Errors
/// [`Cut`] when the budget ends or the choices are spent.
pub(in crate::search) fn least(
    landmarks: &[Vec<Node>],
    limit: usize,
    allowance: &mut Allowance,
    ticker: &mut Ticker<'_>,
) -> Result<Solution, Cut> {
    let root = Root::new(landmarks, limit, ticker).map_err(|Interrupted| Cut { bound: 0, stop: Stop::Interrupted })?;
    let bound = root.bound();
    let Some(fork) = root.fork(limit) else { return Ok(None) };
    let mut search = BranchAndBound { landmarks, limit, allowance, ticker, open: Vec::new(), words: 0, forgotten: 0 };
    let found = search.run(fork).map_err(|stop| Cut { bound, stop })?;
    Ok(found.map(|mut found| {
        found.sort_unstable();
        found
    }))
}

/// A lower bound on the size of a hitting set, found without branching.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(in crate::search) fn bound(
    landmarks: &[Vec<Node>],
    limit: usize,
    ticker: &mut Ticker<'_>,
) -> Result<usize, Interrupted> {
    Ok(Root::new(landmarks, limit, ticker)?.bound())
}

/// The root: reduced, split into parts and bounded.
struct Root {
    decided: Decided,
    parts: Vec<Instance>,
    /// Per part a lower bound.
    bounds: Vec<usize>,
    /// True if the budget ended before the multipliers were raised.
    cut: bool,
}

impl Root {
    fn new(landmarks: &[Vec<Node>], limit: usize, ticker: &mut Ticker<'_>) -> Result<Self, Interrupted> {
        let (mut instance, mut decided) = (Instance::read(landmarks, ticker)?, Decided::default());
        // No landmark is empty, so `reduce` never fails here.
        reduce(&mut instance, &mut decided, ticker)?;
        ticker.step(instance.steps())?;
        let mut parts = instance.parts();
        let mut cut = false;
        let bound = |part: &mut Instance| {
            initialise(part);
            let lagrangian = raise(part, limit, FIRST_ROUNDS, ticker);
            cut |= lagrangian.is_err();
            lagrangian.unwrap_or_else(|reached| reached).bound()
        };
        let bounds = parts.iter_mut().map(bound).collect();
        Ok(Self { decided, parts, bounds, cut })
    }

    fn bound(&self) -> usize {
        self.decided.count() + self.bounds.iter().sum::<usize>()
    }

    /// `None` if `limit` or more elements are decided.
    fn fork(self, limit: usize) -> Option<Box<Fork>> {
        let Self { decided, parts, bounds, .. } = self;
        (decided.count() < limit).then(|| Box::new(Fork::Parts(Parts::new(decided, parts, bounds, limit))))
    }
}

struct BranchAndBound<'s, 'b> {
    landmarks: &'s [Vec<Node>],
    limit: usize,
    allowance: &'s mut Allowance,
    ticker: &'s mut Ticker<'b>,
    /// The open questions; each waits for the one after it.
    open: Vec<Waiting>,
    /// Memory of their instances.
    words: usize,
    /// The number of the oldest ones whose instances were forgotten.
    forgotten: usize,
}

struct Waiting {
    fork: Box<Fork>,
    /// The limit with which it was asked.
    limit: usize,
}

impl BranchAndBound<'_, '_> {
    fn run(&mut self, root: Box<Fork>) -> Result<Solution, Stop> {
        let mut next = self.wait(root, self.limit);
        loop {
            next = match next {
                Next::Ask { limit } => {
                    let question = self.question(limit)?;
                    match look(question, &mut self.allowance.choices, self.ticker)? {
                        Sight::Answer(found) => self.last().next(found),
                        Sight::Fork(fork) => self.wait(fork, limit),
                    }
                }
                Next::Answer(found) => {
                    let answered = self.open.pop().expect("a question that waits");
                    self.words -= answered.fork.words();
                    self.forgotten = self.forgotten.min(self.open.len());
                    if self.open.is_empty() {
                        return Ok(found);
                    }
                    self.last().next(found)
                }
            };
        }
    }

    fn last(&mut self) -> &mut Fork {
        &mut self.open.last_mut().expect("a question that waits").fork
    }

    fn wait(&mut self, fork: Box<Fork>, limit: usize) -> Next {
        self.words += fork.words();
        self.open.push(Waiting { fork, limit });
        while self.words > self.allowance.words && self.forgotten + 1 < self.open.len() {
            let oldest = &mut self.open[self.forgotten].fork;
            self.words -= oldest.words();
            oldest.forget();
            self.forgotten += 1;
        }
        debug_assert!(self.words - self.last().words() <= self.allowance.words, "the oldest were forgotten");
        self.last().begin()
    }

    fn question(&mut self, limit: usize) -> Result<Question, Stop> {
        if self.forgotten == self.open.len() {
            self.recall()?;
        }
        let fork = self.last();
        let (reduced, kept) = (fork.is_reduced(), fork.asks_again());
        let instance = fork.instance().expect("not forgotten");
        self.words -= if kept { 0 } else { instance.words() };
        Ok(Question { instance, limit, reduced })
    }

    /// Computes the instances of the last question again, by replaying the path from the root to it.
    fn recall(&mut self) -> Result<(), Stop> {
        let root = Root::new(self.landmarks, self.limit, self.ticker)?;
        if root.cut {
            return Err(Stop::Interrupted);
        }
        let mut again = root.fork(self.limit).expect("there was a question");
        for at in 1..self.open.len() {
            let limit = self.open[at].limit;
            let before = &mut self.open[at - 1].fork;
            before.recall(*again);
            let reduced = before.is_reduced();
            let instance = before.instance().expect("just recalled");
            before.forget();
            let question = Question { instance, limit, reduced };
            // Its choices have been counted.
            match look(question, &mut usize::MAX.clone(), self.ticker)? {
                Sight::Fork(fork) => again = fork,
                Sight::Answer(_) => unreachable!("a question that waited waits again"),
            }
        }
        let last = self.last();
        last.recall(*again);
        self.words += last.words();
        self.forgotten = self.open.len() - 1;
        Ok(())
    }
}
