//! Metrics: counts and times, never ids, owners or other labels of unbounded number.
//!
//! Each server has its own [`Metrics`], so that several in one process don't mix. The parts of the service record here;
//! `/metrics` writes the text.

use core::time::Duration;

mod families;
mod labels;
mod recorder;

pub use families::MEDIA_TYPE;
pub use labels::{CallbackOutcome, Ended, Queue, Refusal, StoreOutcome};
pub use recorder::{Metrics, Open};

/// A time as log lines tell it: in milliseconds with two decimals.
pub fn milliseconds(duration: Duration) -> f64 {
    (duration.as_secs_f64() * 1e5).round() / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn milliseconds_have_two_decimals() {
        let shown = |nanos| milliseconds(Duration::from_nanos(nanos)).to_string();
        assert_eq!([0, 4_999, 5_000, 123_456, 1_000_000].map(shown), ["0", "0", "0.01", "0.12", "1"]);
        assert_eq!(shown(12_345_678_901), "12345.68");
    }
}
