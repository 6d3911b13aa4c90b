//! The bounds of histograms, s. Steps of about three show shifts and keep series short.

use core::iter::once;

use prometheus_client::metrics::histogram::Histogram;

/// From 0.1 ms: the smallest scenes take this long, over HTTP too.
const SUB_SECOND: [f64; 8] = [0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3];

/// Up to the longest default time limit, 60 s.
pub(super) fn planning() -> Histogram {
    Histogram::new(SUB_SECOND.into_iter().chain([1.0, 3.0, 10.0, 30.0, 60.0]))
}

/// A client waits at most its time limit, a job at most its retention: an hour by default.
pub(super) fn queue_wait() -> Histogram {
    Histogram::new(SUB_SECOND.into_iter().chain([1.0, 3.0, 10.0, 30.0, 60.0, 300.0, 1000.0, 3600.0]))
}

/// Store calls of more than 5 s count as failed everywhere.
pub(super) fn store() -> Histogram {
    Histogram::new(SUB_SECOND.into_iter().chain([1.0, 5.0]))
}

/// A job has at most three attempts.
pub(super) fn attempts() -> Histogram {
    Histogram::new(once(1.0).chain([2.0, 3.0]))
}
