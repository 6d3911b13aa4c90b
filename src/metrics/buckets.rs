//! The bounds of histograms, s. Steps of about three: a shift shows, and a series stays short.

use core::iter::once;

use prometheus_client::metrics::histogram::Histogram;

/// From 0.1 ms: the smallest scenes take as long, over the wire too.
const SUB_SECOND: [f64; 8] = [0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3];

/// Up to the longest time limit there is by default, 60 s.
pub(super) fn planning() -> Histogram {
    Histogram::new(SUB_SECOND.into_iter().chain([1.0, 3.0, 10.0, 30.0, 60.0]))
}

/// A client waits no longer than its time limit, a job for as long as it is kept: an hour by default.
pub(super) fn queue_wait() -> Histogram {
    Histogram::new(SUB_SECOND.into_iter().chain([1.0, 3.0, 10.0, 30.0, 60.0, 300.0, 1000.0, 3600.0]))
}

/// A call that takes more than 5 s counts as failed wherever it is made.
pub(super) fn store() -> Histogram {
    Histogram::new(SUB_SECOND.into_iter().chain([1.0, 5.0]))
}

/// A job is begun three times at the most.
pub(super) fn attempts() -> Histogram {
    Histogram::new(once(1.0).chain([2.0, 3.0]))
}
