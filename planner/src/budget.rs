//! The time budget of a computation. The caller passes in the clock, so that the planner itself reads none.

use core::time::Duration;

/// The caller's clock: the time since the request arrived, and whether the caller still waits.
pub trait Clock {
    /// Time since the request arrived.
    fn elapsed(&self) -> Duration;
    /// True once the caller has gone.
    fn cancelled(&self) -> bool;
    /// Time that the caller took back. The deadline comes earlier by so much; the best answer so far is still wanted.
    fn withdrawn(&self) -> Duration {
        Duration::ZERO
    }
}

/// A clock that stands still: nothing is ever interrupted. For tests, benches and callers without a limit.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unlimited;

impl Clock for Unlimited {
    fn elapsed(&self) -> Duration {
        Duration::ZERO
    }

    fn cancelled(&self) -> bool {
        false
    }
}

/// The computation must stop: its time is spent, or its caller has gone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("interrupted")]
pub struct Interrupted;

/// A clock with a deadline. Loops ask it at least every few hundred microseconds.
#[derive(Clone, Copy)]
pub struct Budget<'a> {
    clock: &'a dyn Clock,
    deadline: Duration,
}

impl<'a> Budget<'a> {
    /// `deadline` counts from the same instant as the clock: the arrival of the request.
    pub fn new(clock: &'a dyn Clock, deadline: Duration) -> Self {
        Self { clock, deadline }
    }

    /// A budget that never ends.
    pub fn unlimited() -> Budget<'static> {
        Budget { clock: &Unlimited, deadline: Duration::MAX }
    }

    /// # Errors
    /// [`Interrupted`] once the deadline has passed or the caller has gone.
    pub fn check(&self) -> Result<(), Interrupted> {
        if self.spent() >= self.deadline || self.clock.cancelled() { Err(Interrupted) } else { Ok(()) }
    }

    /// Time since the request arrived.
    pub fn elapsed(&self) -> Duration {
        self.clock.elapsed()
    }

    /// Time left before the deadline.
    pub fn remaining(&self) -> Duration {
        self.deadline.saturating_sub(self.spent())
    }

    /// The same clock with an earlier deadline: `share` (0 to 1) of the time that is left.
    #[must_use]
    pub fn share(&self, share: f64) -> Self {
        let left = self.remaining();
        if left > Duration::from_secs(1_000_000) {
            return *self;
        }
        Self { deadline: self.spent() + left.mul_f64(share), ..*self }
    }

    fn spent(&self) -> Duration {
        self.clock.elapsed().saturating_add(self.clock.withdrawn())
    }
}

/// Why work with a limit of its own stopped early.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// Its own limit is reached: choices, or places tried.
    Spent,
    /// The budget ended.
    Interrupted,
}

impl From<Interrupted> for Stop {
    fn from(Interrupted: Interrupted) -> Self {
        Self::Interrupted
    }
}

/// Counts steps and looks at the budget once in a while, since reading a clock costs as much as several steps.
pub struct Ticker<'a> {
    budget: &'a Budget<'a>,
    /// Steps between two looks.
    beat: usize,
    left: usize,
}

/// Steps between two looks where nothing else is said, some 50 µs.
const BEAT: usize = 100;

impl<'a> Ticker<'a> {
    /// A ticker that looks at the budget at its first step.
    pub fn new(budget: &'a Budget<'a>) -> Self {
        Self { budget, beat: BEAT, left: 0 }
    }

    /// A ticker that looks every `beat` steps, first after `beat`.
    pub fn every(beat: usize, budget: &'a Budget<'a>) -> Self {
        Self { budget, beat, left: beat }
    }

    /// A ticker that looks every `beat` steps, first after `patience`, whatever the budget says until then.
    pub fn patient(patience: usize, beat: usize, budget: &'a Budget<'a>) -> Self {
        Self { budget, beat, left: patience }
    }

    /// Another ticker on the same budget.
    #[must_use]
    pub fn another(&self) -> Self {
        Self { left: 0, ..*self }
    }

    /// Counts `steps`, of half a microsecond to one each.
    ///
    /// # Errors
    /// [`Interrupted`] if a look was due and the budget has ended.
    pub fn step(&mut self, steps: usize) -> Result<(), Interrupted> {
        match self.left.checked_sub(steps) {
            Some(left) => {
                self.left = left;
                Ok(())
            }
            None => self.look(),
        }
    }

    /// Looks at the budget now.
    ///
    /// # Errors
    /// [`Interrupted`] if it has ended.
    pub fn look(&mut self) -> Result<(), Interrupted> {
        self.left = self.beat;
        self.budget.check()
    }
}

#[cfg(test)]
pub(crate) mod clocks;

#[cfg(test)]
mod tests {
    use super::*;

    /// The ms passed, and whether the caller has gone.
    struct At(u64, bool);

    /// The ms passed, and the ms taken back.
    struct Less(u64, u64);

    impl Clock for Less {
        fn elapsed(&self) -> Duration {
            Duration::from_millis(self.0)
        }

        fn cancelled(&self) -> bool {
            false
        }

        fn withdrawn(&self) -> Duration {
            Duration::from_millis(self.1)
        }
    }

    impl Clock for At {
        fn elapsed(&self) -> Duration {
            Duration::from_millis(self.0)
        }

        fn cancelled(&self) -> bool {
            self.1
        }
    }

    #[test]
    fn a_budget_ends_at_its_deadline_or_when_the_caller_goes() {
        let deadline = Duration::from_millis(10);
        assert_eq!(Budget::new(&At(9, false), deadline).check(), Ok(()));
        assert_eq!(Budget::new(&At(10, false), deadline).check(), Err(Interrupted));
        assert_eq!(Budget::new(&At(0, true), deadline).check(), Err(Interrupted));
        assert_eq!(Budget::unlimited().check(), Ok(()));
    }

    #[test]
    fn a_share_ends_before_the_whole() {
        let whole = Budget::new(&At(4, false), Duration::from_millis(10));
        assert_eq!(whole.share(0.5).remaining(), Duration::from_millis(3));
        assert_eq!(Budget::unlimited().share(0.5).check(), Ok(()));
    }

    #[test]
    fn withdrawn_time_shortens_the_budget_but_has_not_elapsed() {
        let clock = Less(4, 5);
        let budget = Budget::new(&clock, Duration::from_millis(10));
        assert_eq!((budget.check(), budget.remaining()), (Ok(()), Duration::from_millis(1)));
        assert_eq!(budget.elapsed(), Duration::from_millis(4));
        assert_eq!(budget.share(0.5).remaining(), Duration::from_micros(500));
        assert_eq!(Budget::new(&clock, Duration::from_millis(9)).check(), Err(Interrupted));
    }
}
