//! What a key may do, and how often: its scopes and its rate.

use core::fmt;
use core::str::FromStr;
use core::time::Duration;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// A scope.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// Plan now, check plans, survey, knowledge.
    Plan,
    /// All calls about jobs.
    Jobs,
    /// Read jobs.
    ReadOnly,
    /// Read metrics.
    Metrics,
}

impl Scope {
    /// Every scope.
    pub const ALL: [Self; 4] = [Self::Plan, Self::Jobs, Self::ReadOnly, Self::Metrics];

    /// Its name in files and logs.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Plan => "plan",
            Self::Jobs => "jobs",
            Self::ReadOnly => "read-only",
            Self::Metrics => "metrics",
        }
    }
}

/// The scopes of a key, at least one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Scopes(Vec<Scope>);

impl Scopes {
    /// The scopes with these names.
    ///
    /// # Errors
    /// The fault, without the names: one may be a misplaced key.
    pub fn read<'a>(words: impl IntoIterator<Item = &'a str>) -> Result<Self, String> {
        let read = |word: &str| Scope::ALL.into_iter().find(|scope| scope.as_str() == word);
        match words.into_iter().map(read).collect::<Option<Vec<Scope>>>() {
            Some(scopes) if !scopes.is_empty() => Ok(Self(scopes)),
            _ => {
                let known = Scope::ALL.map(Scope::as_str).join(", ");
                Err(format!("scopes are one or more of {known}"))
            }
        }
    }

    /// True if it has one of these scopes.
    pub fn any_of(&self, wanted: &[Scope]) -> bool {
        self.0.iter().any(|scope| wanted.contains(scope))
    }
}

impl FromStr for Scopes {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::read(text.split(','))
    }
}

impl fmt::Display for Scopes {
    /// As in the keys file: quoted, in brackets.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words: Vec<String> = self.0.iter().map(|scope| format!("\"{}\"", scope.as_str())).collect();
        write!(f, "[{}]", words.join(", "))
    }
}

/// From one request in some 17 minutes to more than any machine answers; anything else is a typing error.
const RANGE: core::ops::RangeInclusive<f64> = 0.001..=1e6;

/// Requests per second. The burst is one second's worth, at least one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rate(f64);

impl Rate {
    /// This many per second.
    ///
    /// # Errors
    /// If it is out of range: the range.
    pub fn new(per_second: f64) -> Result<Self, String> {
        if RANGE.contains(&per_second) {
            return Ok(Self(per_second));
        }
        Err(format!("a rate is a number of requests per second from {} to {}", RANGE.start(), RANGE.end()))
    }

    /// The time from one request to the next.
    fn pause(self) -> Duration {
        Duration::from_secs_f64(1.0 / self.0)
    }

    /// How long a full bucket takes to fill.
    fn whole(self) -> Duration {
        Duration::from_secs_f64(self.0.max(1.0) / self.0)
    }
}

impl FromStr for Rate {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        // No number is no rate either.
        Self::new(text.parse().unwrap_or(f64::NAN))
    }
}

impl fmt::Display for Rate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// The usage of a rate, as a token bucket of a few lines: a crate would bring a dozen dependencies for one comparison. It
/// holds the time at which the bucket is full again. The rate may change meanwhile.
#[derive(Debug, Default)]
pub(super) struct Spent(Mutex<Option<Instant>>);

impl Spent {
    /// Count one request.
    ///
    /// # Errors
    /// If the bucket is empty: the time until the next request.
    pub(super) fn take(&self, rate: Rate, now: Instant) -> Result<(), Duration> {
        // A panic can't break an invariant of a time.
        let mut full = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // At an earlier rate the bucket may have taken longer to fill.
        let owed = full.map_or(Duration::ZERO, |full| full.saturating_duration_since(now)).min(rate.whole());
        let room = rate.whole().saturating_sub(rate.pause());
        let taken = if owed > room { Err(owed - room) } else { Ok(rate.pause()) };
        *full = Some(now + owed + taken.unwrap_or_default());
        taken.map(drop)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scopes_are_read_as_they_are_written() {
        for scope in Scope::ALL {
            assert_eq!(scope.as_str().parse(), Ok(Scopes(vec![scope])));
        }
        let scopes: Scopes = "plan,read-only".parse().unwrap();
        assert_eq!(scopes.to_string(), r#"["plan", "read-only"]"#);
        assert!(scopes.any_of(&[Scope::Jobs, Scope::ReadOnly]) && !scopes.any_of(&[Scope::Jobs]));
        for wrong in ["", "plan,", "plan, jobs", "Plan", "all"] {
            assert!(wrong.parse::<Scopes>().is_err(), "{wrong}");
        }
    }

    fn rate(per_second: f64) -> Rate {
        Rate::new(per_second).unwrap()
    }

    #[test]
    fn one_seconds_worth_may_come_at_once_and_the_rest_in_step() {
        let (spent, now) = (Spent::default(), Instant::now());
        for _ in 0..4 {
            assert_eq!(spent.take(rate(4.0), now), Ok(()));
        }
        let pause = Duration::from_millis(250);
        assert_eq!(spent.take(rate(4.0), now), Err(pause));
        assert_eq!(spent.take(rate(4.0), now + pause / 2), Err(pause / 2));
        assert_eq!(spent.take(rate(4.0), now + pause), Ok(()));
        assert_eq!(spent.take(rate(4.0), now + pause), Err(pause));
        let later = now + 100 * pause;
        assert_eq!([(); 5].map(|()| spent.take(rate(4.0), later).is_ok()), [true, true, true, true, false]);
    }

    #[test]
    fn a_slow_rate_lets_one_through() {
        let (spent, now) = (Spent::default(), Instant::now());
        assert_eq!(spent.take(rate(0.1), now), Ok(()));
        assert_eq!(spent.take(rate(0.1), now), Err(Duration::from_secs(10)));
        assert_eq!(spent.take(rate(0.1), now + Duration::from_secs(10)), Ok(()));
    }

    #[test]
    fn a_new_rate_does_not_wait_for_the_old_one() {
        let (spent, now) = (Spent::default(), Instant::now());
        assert_eq!(spent.take(rate(0.001), now), Ok(()));
        assert_eq!(spent.take(rate(2.0), now), Err(Duration::from_millis(500)));
        assert_eq!(spent.take(rate(2.0), now + Duration::from_millis(500)), Ok(()));
    }

    #[test]
    fn a_rate_out_of_range_is_refused() {
        for text in ["", "0", "-1", "nan", "inf", "1e7", "fast"] {
            assert!(text.parse::<Rate>().is_err(), "{text}");
        }
        assert_eq!("50".parse::<Rate>().unwrap().to_string(), "50");
    }
}
