//! Receivers that time out, so that callbacks to them don't hold up the others.

use core::time::Duration;
use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use crate::jobs::timestamp::Timestamp;

/// Receivers without a try for this many rests are forgotten.
const REMEMBERED: u32 = 10;

/// Receivers whose last try timed out. Each gets one try at a time until it answers.
#[derive(Debug)]
pub(super) struct SilentReceivers {
    /// The time between two tries to one receiver.
    rest: Duration,
    /// When the next try may go.
    until: Mutex<HashMap<String, Timestamp>>,
}

impl SilentReceivers {
    pub(super) fn new(rest: Duration) -> Self {
        Self { rest, until: Mutex::default() }
    }

    /// Admits a try to this receiver.
    ///
    /// # Errors
    /// The time of the next try.
    pub(super) fn admit(&self, receiver: &str, now: Timestamp) -> Result<(), Timestamp> {
        let mut until = self.until.lock().unwrap_or_else(PoisonError::into_inner);
        match until.get_mut(receiver) {
            Some(at) if now < *at => Err(*at),
            Some(at) => {
                *at = now.after(self.rest);
                Ok(())
            }
            None => Ok(()),
        }
    }

    /// Notes whether the receiver answered a try.
    pub(super) fn note(&self, receiver: &str, answered: bool, now: Timestamp) {
        let mut until = self.until.lock().unwrap_or_else(PoisonError::into_inner);
        if answered {
            until.remove(receiver);
        } else {
            until.retain(|_, at| now.since(*at) < REMEMBERED * self.rest);
            until.insert(receiver.to_owned(), now.after(self.rest));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REST: Duration = Duration::from_secs(10);

    fn second(seconds: i64) -> Timestamp {
        Timestamp::from_millis(seconds * 1000)
    }

    #[test]
    fn a_silent_receiver_gets_one_try_at_a_time_until_it_answers() {
        let silent = SilentReceivers::new(REST);
        assert_eq!([silent.admit("a:80", second(0)), silent.admit("a:80", second(0))], [Ok(()), Ok(())]);
        silent.note("a:80", false, second(1));
        assert_eq!(silent.admit("a:80", second(10)), Err(second(11)));
        assert_eq!(silent.admit("b:80", second(10)), Ok(()));
        assert_eq!([silent.admit("a:80", second(11)), silent.admit("a:80", second(11))], [Ok(()), Err(second(21))]);
        silent.note("a:80", true, second(12));
        assert_eq!([silent.admit("a:80", second(12)), silent.admit("a:80", second(12))], [Ok(()), Ok(())]);
    }

    #[test]
    fn a_receiver_is_no_longer_silent_after_a_while() {
        let silent = SilentReceivers::new(REST);
        silent.note("a:80", false, second(0));
        silent.note("b:80", false, second(60));
        silent.note("c:80", false, second(120));
        let until = silent.until.lock().unwrap();
        assert!(until.len() == 2 && !until.contains_key("a:80"));
    }
}
