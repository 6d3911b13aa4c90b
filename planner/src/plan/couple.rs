//! Alternates relocation sets with placement, cheapest first.

use super::attempt::{Question, attempt, for_steps};
use crate::budget::{Budget, Interrupted};
use crate::cost::Cost;
use crate::placement::{Arrangement, Effort};
use crate::search::{Alternatives, Derivation};

/// The effort for one answer, reached only where space is very short: half a second, or some seconds where a large disc
/// stands among thousands of small ones.
const MAX_EFFORT: u32 = 1_000_000;
/// The most relocations tried beyond the cost of the least set.
const MAX_EXTRA: u64 = 3;
/// The most sets tried.
const MAX_SETS: usize = 32;
/// The share of the time in which further sets are searched.
const SETS_SHARE: f64 = 0.5;

/// The cheapest arrangement found: least sets first, then larger ones and extra moves together. `None` once the effort
/// is spent or the candidates are exhausted.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(crate) fn arrange_least(
    question: &Question<'_>,
    first: Derivation,
    budget: &Budget<'_>,
) -> Result<Option<Arrangement>, Interrupted> {
    let cheapest = first.cost();
    let mut alternatives = Alternatives::new(question.base, question.goal, first);
    let more = |budget: &Budget<'_>| alternatives.next(budget);
    Coupling {
        question,
        budget,
        cheapest,
        more,
        next: None,
        tried: Vec::new(),
        effort: Effort::new(MAX_EFFORT.saturating_add(for_steps(cheapest))),
    }
    .arrange()
}

/// The sets so far, and how far they were tried.
struct Coupling<'q, M> {
    question: &'q Question<'q>,
    budget: &'q Budget<'q>,
    /// The cost of the least set.
    cheapest: Cost,
    /// The next set, no cheaper than any before. After an interruption it may be called again.
    more: M,
    /// A set kept for a later cost.
    next: Option<Derivation>,
    tried: Vec<Derivation>,
    effort: Effort,
}

/// The end of a round.
enum Round {
    Found(Arrangement),
    /// There are no more sets, or the effort is spent.
    Nothing,
    /// The time for sets ended.
    Cut,
}

impl<M: FnMut(&Budget<'_>) -> Result<Option<Derivation>, Interrupted>> Coupling<'_, M> {
    /// The next set may take long to find. So half of the time is for sets and the rest for extra moves on known sets;
    /// time left over is for more sets.
    fn arrange(mut self) -> Result<Option<Arrangement>, Interrupted> {
        for for_sets in [self.budget.share(SETS_SHARE), *self.budget] {
            match self.round(&for_sets)? {
                Round::Found(arrangement) => return Ok(Some(arrangement)),
                Round::Nothing => return Ok(None),
                Round::Cut => {}
            }
        }
        Err(Interrupted)
    }

    /// In order of cost: each new set as it is, then the earlier sets of this round with extra moves.
    fn round(&mut self, for_sets: &Budget<'_>) -> Result<Round, Interrupted> {
        let earlier = self.tried.len();
        let mut cut = self.next.is_none() && self.fetch(for_sets).is_err();
        for extra in 0..=MAX_EXTRA {
            let cost = self.cheapest + Cost::new(extra);
            let cheaper = self.tried.len();
            while self.tried.len() < MAX_SETS
                && let Some(derivation) = self.next.take_if(|derivation| derivation.cost() <= cost)
            {
                self.tried.push(derivation);
                if let Some(found) = self.attempt(self.tried.len() - 1, cost)? {
                    return Ok(Round::Found(found));
                }
                cut = self.fetch(for_sets).is_err();
            }
            for set in earlier..cheaper {
                if let Some(found) = self.attempt(set, cost)? {
                    return Ok(Round::Found(found));
                }
            }
            if self.effort.left() == 0 {
                return Ok(Round::Nothing);
            }
        }
        Ok(if cut { Round::Cut } else { Round::Nothing })
    }

    fn fetch(&mut self, budget: &Budget<'_>) -> Result<(), Interrupted> {
        self.next = (self.more)(budget)?;
        Ok(())
    }

    fn attempt(&mut self, set: usize, cost: Cost) -> Result<Option<Arrangement>, Interrupted> {
        attempt(self.question, &self.tried[set], cost, &mut self.effort, self.budget)
    }
}

/// One set without alternatives, for a search that ran out of time with a derivation.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(crate) fn arrange_one(
    question: &Question<'_>,
    set: &Derivation,
    budget: &Budget<'_>,
) -> Result<Option<Arrangement>, Interrupted> {
    let mut effort = Effort::new(MAX_EFFORT.saturating_add(for_steps(set.cost())));
    attempt(question, set, set.cost(), &mut effort, budget)
}

#[cfg(test)]
mod tests {
    use core::cell::Cell;
    use core::time::Duration;

    use super::*;
    use crate::budget::Clock;
    use crate::knowledge::{SweptFinger, complete};
    use crate::placement::Objective;
    use crate::scene::ObjectIndex;
    use crate::scene::scenes::TestScene;

    /// A clock that advances by 1 ms per look.
    #[derive(Default)]
    struct Ticking(Cell<u64>);

    impl Clock for Ticking {
        fn elapsed(&self) -> Duration {
            self.0.set(self.0.get() + 1);
            Duration::from_millis(self.0.get())
        }

        fn cancelled(&self) -> bool {
            false
        }
    }

    /// To grasp the cup, `east` or `west` must move, but either has a place only once the other has moved too. `coming`
    /// lists the sets; `None` stands for one that takes all the time for sets.
    fn arranged(coming: &[Option<&[usize]>]) -> Result<Option<Arrangement>, Interrupted> {
        let scene = TestScene::new(4)
            .table(0.135_162, 0.071_054)
            .finger(0.013, 0.035)
            .disc("cup", 0.065_575, 0.046_448, 0.021_03)
            .disc("east", 0.108_18, 0.030_045, 0.021_03)
            .disc("west", 0.022_59, 0.025_764, 0.021_03)
            .build("cup");
        let base = complete(&scene, &SweptFinger, &Budget::unlimited()).unwrap();
        let question = Question {
            scene: &scene,
            base: &base,
            goal: ObjectIndex::new(0),
            model: &SweptFinger,
            objective: Objective::default(),
        };
        let clock = Ticking::default();
        let budget = Budget::new(&clock, Duration::from_secs(100));
        let mut coming = coming.iter();
        let more = |budget: &Budget<'_>| match coming.next() {
            Some(Some(set)) => {
                Ok(Some(Derivation { order: set.iter().map(|object| ObjectIndex::new(*object)).collect() }))
            }
            Some(None) => {
                while budget.check().is_ok() {}
                Err(Interrupted)
            }
            None => Ok(None),
        };
        let effort = Effort::new(MAX_EFFORT);
        Coupling {
            question: &question,
            budget: &budget,
            cheapest: Cost::new(1),
            more,
            next: None,
            tried: Vec::new(),
            effort,
        }
        .arrange()
    }

    fn cost(arranged: Result<Option<Arrangement>, Interrupted>) -> Option<usize> {
        arranged.unwrap().map(|arrangement| arrangement.moves.len())
    }

    #[test]
    fn a_set_that_does_not_come_leaves_time_for_extra_moves() {
        assert_eq!(cost(arranged(&[Some(&[2])])), Some(2), "with one extra move");
        assert_eq!(cost(arranged(&[Some(&[2]), None])), Some(2));
    }

    #[test]
    fn time_that_extra_moves_leave_is_for_more_sets() {
        // Extra moves don't help a set without relocations.
        assert_eq!(cost(arranged(&[Some(&[])])), None);
        assert_eq!(cost(arranged(&[Some(&[]), None, Some(&[2, 1])])), Some(2));
        assert_eq!(arranged(&[Some(&[]), None, None]), Err(Interrupted));
    }
}
