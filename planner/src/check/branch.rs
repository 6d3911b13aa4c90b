//! Depth-first branch and bound over one component, with the open questions in a list rather than on the stack.
//!
//! The families of open questions take memory. Past the limit the oldest are forgotten; when their turn comes, they are
//! computed again from the component.

use crate::budget::{Interrupted, Ticker};

use super::family::{Family, Reduced};
use super::fork::{Fork, Next};
use super::multipliers::improve;

/// Subgradient rounds after each choice, which inherits the multipliers.
const ROUNDS: usize = 12;

/// How many elements hit the family, if fewer than `limit` do?
struct Question {
    family: Family,
    limit: usize,
    /// True for a single component that is fully reduced.
    reduced: bool,
}

/// The outcome of one look at a question.
enum Sight {
    /// The size of a least hitting set, or the limit if that is no larger.
    Answer(usize),
    /// Other questions must be answered first.
    Fork(Fork),
}

/// Reduces the family, bounds the rest, and fixes elements by reduced cost.
fn look(question: Question, ticker: &mut Ticker<'_>) -> Result<Sight, Interrupted> {
    let Question { mut family, limit, mut reduced } = question;
    let mut counted = 0;
    loop {
        if !core::mem::take(&mut reduced) {
            let Reduced { forced, rest } = family.reduce(ticker)?;
            counted += forced;
            ticker.step(rest.units())?;
            let mut components = rest.components();
            if components.len() != 1 {
                return Ok(Sight::Fork(Fork::components(components, counted, limit)));
            }
            family = components.swap_remove(0);
            if counted + family.packing() >= limit {
                return Ok(Sight::Answer(limit));
            }
        }
        ticker.step(family.units())?;
        let left = limit - counted;
        let lagrangian = improve(&mut family, left, ROUNDS, ticker).map_err(|_| Interrupted)?;
        if lagrangian.at_least() >= left {
            return Ok(Sight::Answer(limit));
        }
        let (refused, others): (Vec<usize>, Vec<usize>) =
            (0..family.width).partition(|element| lagrangian.with(*element) >= left);
        let taken: Vec<usize> = others.into_iter().filter(|element| lagrangian.without(*element) >= left).collect();
        if refused.is_empty() && taken.is_empty() {
            return Ok(match family.most_frequent() {
                Some(element) => Sight::Fork(Fork::choice(family, element, lagrangian.at_least(), counted, limit)),
                None => Sight::Answer(counted),
            });
        }
        counted += taken.len();
        match family.after(&taken, &refused) {
            Some(after) if counted < limit => family = after,
            _ => return Ok(Sight::Answer(limit)),
        }
    }
}

/// The search for the size of a least hitting set.
struct Search<'s, 'b> {
    /// The root, from which forgotten families are computed again.
    component: &'s Family,
    /// The most members in the families of all open questions but the last one.
    most_kept: usize,
    ticker: &'s mut Ticker<'b>,
    /// The open questions; each waits for the one after it.
    open: Vec<Fork>,
    /// The members in their families.
    kept: usize,
    /// The number of the oldest ones whose families were forgotten.
    forgotten: usize,
}

/// The size of a least hitting set of a reduced component, or `limit` if that is no larger. Open questions keep at most
/// `most_kept` members, and the last one its own.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(super) fn branch(
    component: &Family,
    limit: usize,
    most_kept: usize,
    ticker: &mut Ticker<'_>,
) -> Result<usize, Interrupted> {
    Search { component, most_kept, ticker, open: Vec::new(), kept: 0, forgotten: 0 }.run(limit)
}

impl Search<'_, '_> {
    fn run(&mut self, limit: usize) -> Result<usize, Interrupted> {
        let mut next = match look(self.first(limit), self.ticker)? {
            Sight::Answer(least) => return Ok(least),
            Sight::Fork(fork) => self.wait(fork),
        };
        loop {
            next = match next {
                Next::Ask { limit } => match look(self.question(limit)?, self.ticker)? {
                    Sight::Answer(least) => self.last().next(least),
                    Sight::Fork(fork) => self.wait(fork),
                },
                Next::Answer(least) => {
                    let answered = self.open.pop().expect("a question that waits");
                    self.kept -= answered.size;
                    self.forgotten = self.forgotten.min(self.open.len());
                    if self.open.is_empty() {
                        return Ok(least);
                    }
                    self.last().next(least)
                }
            };
        }
    }

    fn first(&self, limit: usize) -> Question {
        Question { family: self.component.clone(), limit, reduced: true }
    }

    fn last(&mut self) -> &mut Fork {
        self.open.last_mut().expect("a question that waits")
    }

    fn wait(&mut self, fork: Fork) -> Next {
        self.kept += fork.size;
        self.open.push(fork);
        while self.kept > self.most_kept && self.forgotten + 1 < self.open.len() {
            let oldest = &mut self.open[self.forgotten];
            self.kept -= oldest.size;
            oldest.forget();
            self.forgotten += 1;
        }
        debug_assert!(self.kept - self.last().size <= self.most_kept, "the oldest were forgotten");
        self.last().begin()
    }

    fn question(&mut self, limit: usize) -> Result<Question, Interrupted> {
        if self.forgotten == self.open.len() {
            self.recall()?;
        }
        let fork = self.last();
        let (before, reduced) = (fork.size, fork.is_reduced());
        let family = fork.family().expect("not forgotten");
        let given_back = before - fork.size;
        self.kept -= given_back;
        Ok(Question { family, limit, reduced })
    }

    /// Computes the families of the last question again, by replaying the path from the root to it.
    fn recall(&mut self) -> Result<(), Interrupted> {
        let mut question = self.first(self.open[0].limit);
        let last = self.open.len() - 1;
        for at in 0..last {
            let limit = self.open[at + 1].limit;
            let fork = &mut self.open[at];
            fork.recall(again(question, self.ticker)?);
            question = Question { family: fork.family().expect("just made"), limit, reduced: fork.is_reduced() };
            fork.forget();
        }
        self.open[last].recall(again(question, self.ticker)?);
        (self.kept, self.forgotten) = (self.open[last].size, last);
        Ok(())
    }
}

/// The fork of a question that forked before.
fn again(question: Question, ticker: &mut Ticker<'_>) -> Result<Fork, Interrupted> {
    match look(question, ticker)? {
        Sight::Fork(fork) => Ok(fork),
        Sight::Answer(_) => unreachable!("the same question forks again"),
    }
}
