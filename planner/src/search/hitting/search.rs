//! Depth-first search, with the open questions in a list of their own rather than on the stack.
//!
//! An instance takes memory, and a search may be as deep as there are elements. What goes past the limit is forgotten, the
//! oldest first: those are large and seldom come up again. When one does, all that led to it is looked at again.

use super::branch::{Question, Sight, look};
use super::fork::{Fork, Next, Parts};
use super::instance::{Decided, Instance};
use super::prices::{raise, share};
use super::reduce::reduce;
use super::{Cut, Found, Stop};
use crate::budget::Interrupted;
use crate::search::pace::Pace;
use crate::search::problem::Node;

/// Rounds for the prices of a part that begins without any.
const FIRST_ROUNDS: usize = 100;

/// How far a search may go.
#[derive(Debug, Clone, Copy)]
pub(in crate::search) struct Allowance {
    /// Choices, counted down.
    pub(in crate::search) choices: usize,
    /// Memory of the open questions, in words, but for the last one's.
    pub(in crate::search) words: usize,
}

/// A least set that meets every landmark, if it has fewer than `limit` members.
///
/// # Errors
/// [`Cut`] when the budget ends or the choices are spent.
pub(in crate::search) fn least(
    landmarks: &[Vec<Node>],
    limit: usize,
    allowance: &mut Allowance,
    pace: &mut Pace<'_>,
) -> Result<Found, Cut> {
    let root = Root::new(landmarks, limit, pace).map_err(|Interrupted| Cut { bound: 0, stop: Stop::Interrupted })?;
    let bound = root.bound();
    let Some(fork) = root.fork(limit) else { return Ok(None) };
    let mut search = Search { landmarks, limit, allowance, pace, open: Vec::new(), words: 0, forgotten: 0 };
    let found = search.run(fork).map_err(|stop| Cut { bound, stop })?;
    Ok(found.map(|mut found| {
        found.sort_unstable();
        found
    }))
}

/// No set of fewer members meets every landmark; found without any choice.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(in crate::search) fn bound(
    landmarks: &[Vec<Node>],
    limit: usize,
    pace: &mut Pace<'_>,
) -> Result<usize, Interrupted> {
    Ok(Root::new(landmarks, limit, pace)?.bound())
}

/// Where a search begins.
struct Root {
    decided: Decided,
    parts: Vec<Instance>,
    /// Per part how many elements it needs at least.
    bounds: Vec<usize>,
    /// True if the budget ended before the prices were raised.
    cut: bool,
}

impl Root {
    fn new(landmarks: &[Vec<Node>], limit: usize, pace: &mut Pace<'_>) -> Result<Self, Interrupted> {
        let (mut instance, mut decided) = (Instance::read(landmarks, pace)?, Decided::default());
        // No landmark is empty, so each can be met.
        reduce(&mut instance, &mut decided, pace)?;
        pace.step(instance.steps())?;
        let mut parts = instance.parts();
        let mut cut = false;
        let price = |part: &mut Instance| {
            share(part);
            let worth = raise(part, limit, FIRST_ROUNDS, pace);
            cut |= worth.is_err();
            worth.unwrap_or_else(|reached| reached).bound()
        };
        let bounds = parts.iter_mut().map(price).collect();
        Ok(Self { decided, parts, bounds, cut })
    }

    fn bound(&self) -> usize {
        self.decided.count() + self.bounds.iter().sum::<usize>()
    }

    /// `None` if what is decided is no fewer than `limit`.
    fn fork(self, limit: usize) -> Option<Box<Fork>> {
        let Self { decided, parts, bounds, .. } = self;
        (decided.count() < limit).then(|| Box::new(Fork::Parts(Parts::new(decided, parts, bounds, limit))))
    }
}

struct Search<'s, 'b> {
    landmarks: &'s [Vec<Node>],
    limit: usize,
    allowance: &'s mut Allowance,
    pace: &'s mut Pace<'b>,
    /// Each waits for the one after it.
    open: Vec<Waiting>,
    /// What all instances of these take.
    words: usize,
    /// So many of them, the oldest, have no instance left.
    forgotten: usize,
}

struct Waiting {
    fork: Box<Fork>,
    /// The limit with which it was asked.
    limit: usize,
}

impl Search<'_, '_> {
    fn run(&mut self, root: Box<Fork>) -> Result<Found, Stop> {
        let mut next = self.wait(root, self.limit);
        loop {
            next = match next {
                Next::Ask { limit } => {
                    let question = self.question(limit)?;
                    match look(question, &mut self.allowance.choices, self.pace)? {
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

    /// Bring back the instances of the last question by asking all before it again, with what is known of them now.
    fn recall(&mut self) -> Result<(), Stop> {
        let root = Root::new(self.landmarks, self.limit, self.pace)?;
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
            match look(question, &mut usize::MAX.clone(), self.pace)? {
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
