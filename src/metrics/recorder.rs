//! Records metrics and writes them as text.

use core::time::Duration;
use std::borrow::Cow;

use prometheus_client::encoding::text::encode;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::registry::Registry;

use super::families::{Families, Request};
use super::labels::{CallbackOutcome, Ended, Queue, Refusal, StoreOutcome, method};
use singulate_planner::plan::Answer;

/// The metrics of one server.
#[derive(Debug)]
pub struct Metrics {
    families: Families,
    registry: Registry,
}

/// Counts as open until it is dropped.
#[derive(Debug)]
pub struct Open(Gauge);

impl Drop for Open {
    fn drop(&mut self) {
        self.0.dec();
    }
}

impl Default for Metrics {
    /// Starts all counters of closed lists at 0, so that the first event already shows as a change.
    fn default() -> Self {
        let families = Families::new();
        for refusal in Refusal::ALL {
            families.refused.get_or_create(&[("reason", refusal.as_str())]).inc_by(0);
        }
        for ended in Ended::ALL {
            families.jobs_ended.get_or_create(&[("state", ended.as_str())]).inc_by(0);
        }
        for outcome in CallbackOutcome::ALL {
            families.callbacks.get_or_create(&[("outcome", outcome.as_str())]).inc_by(0);
        }
        let registry = families.registry();
        Self { families, registry }
    }
}

impl Metrics {
    /// A request on this route template took this long; without a status its client had hung up.
    pub fn request(&self, route: &str, verb: &str, status: Option<u16>, took: Duration) {
        let status = status.map_or(Cow::Borrowed("hung_up"), |status| Cow::Owned(status.to_string()));
        let labels = Request { route: route.to_owned(), method: method(verb), status };
        self.families.requests.get_or_create(&labels).observe(took.as_secs_f64());
    }

    /// A request was refused.
    pub fn refused(&self, refusal: Refusal) {
        self.families.refused.get_or_create(&[("reason", refusal.as_str())]).inc();
    }

    /// Queued work got its thread.
    pub fn waited(&self, queue: Queue, wait: Duration) {
        self.families.queue_wait.get_or_create(&[("kind", queue.as_str())]).observe(wait.as_secs_f64());
    }

    /// Planning has ended, with any verdict.
    pub fn planned(&self, answer: &Answer) {
        let phases = answer.statistics.phases();
        for (phase, took) in phases {
            self.families.phases.get_or_create(&[("phase", phase)]).observe(took.as_secs_f64());
        }
        let whole: Duration = phases.into_iter().map(|(_, took)| took).sum();
        let labels = [("verdict", answer.statement.verdict_name())];
        self.families.planning.get_or_create(&labels).observe(whole.as_secs_f64());
    }

    /// This many jobs are queued and running.
    pub fn set_jobs(&self, queued: u64, running: u64) {
        for (state, count) in [("queued", queued), ("running", running)] {
            self.families.jobs.get_or_create(&[("state", state)]).set(i64::try_from(count).unwrap_or(i64::MAX));
        }
    }

    /// A job ended.
    pub fn job_ended(&self, ended: Ended) {
        self.families.jobs_ended.get_or_create(&[("state", ended.as_str())]).inc();
    }

    /// An attempt at a job began; the first has number 1.
    pub fn attempt(&self, number: u32) {
        self.families.attempts.observe(f64::from(number));
    }

    /// A store call took this long. The operation is the store's method.
    pub fn store(&self, operation: &'static str, outcome: StoreOutcome, took: Duration) {
        let labels = [("operation", operation), ("outcome", outcome.as_str())];
        self.families.store.get_or_create(&labels).observe(took.as_secs_f64());
    }

    /// A callback was tried.
    pub fn callback(&self, outcome: CallbackOutcome) {
        self.families.callbacks.get_or_create(&[("outcome", outcome.as_str())]).inc();
    }

    /// A connection is open.
    pub fn connection(&self) -> Open {
        opened(&self.families.connections)
    }

    /// A stream of events is open.
    pub fn stream(&self) -> Open {
        opened(&self.families.streams)
    }

    /// This many threads of this queue are busy.
    pub fn set_busy(&self, queue: Queue, threads: usize) {
        let labels = [("kind", queue.as_str())];
        self.families.busy.get_or_create(&labels).set(i64::try_from(threads).unwrap_or(i64::MAX));
    }

    /// All metrics as OpenMetrics text.
    pub fn text(&self) -> String {
        let mut text = String::new();
        // Writing to a string can't fail.
        let _ = encode(&mut text, &self.registry);
        text
    }
}

fn opened(gauge: &Gauge) -> Open {
    gauge.inc();
    Open(gauge.clone())
}
