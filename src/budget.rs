//! How long a computation may go on. Time and cancellation come in as an argument, so that the core reads no clock.

use core::time::Duration;

/// What the edge lends to the core: the time since the request arrived, and whether anybody still wants the answer.
pub trait Clock {
    /// Time since the request arrived.
    fn elapsed(&self) -> Duration;
    /// True once the caller has gone.
    fn cancelled(&self) -> bool;
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

/// The computation was told to stop: its time is spent, or its caller has gone.
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
        if self.clock.elapsed() >= self.deadline || self.clock.cancelled() { Err(Interrupted) } else { Ok(()) }
    }

    /// Time since the request arrived.
    pub fn elapsed(&self) -> Duration {
        self.clock.elapsed()
    }

    /// Time left before the deadline.
    pub fn remaining(&self) -> Duration {
        self.deadline.saturating_sub(self.clock.elapsed())
    }

    /// The same clock with an earlier deadline: `share` (0 to 1) of the time that is left.
    #[must_use]
    pub fn share(&self, share: f64) -> Self {
        let left = self.remaining();
        if left > Duration::from_secs(1_000_000) {
            return *self;
        }
        Self { clock: self.clock, deadline: self.clock.elapsed() + left.mul_f64(share) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct At(u64, bool);

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
}
