//! The metric families: names, help, labels, and the bounds of histograms.

use core::iter::once;
use std::borrow::Cow;

use prometheus_client::encoding::EncodeLabelSet;
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::metrics::histogram::Histogram;
use prometheus_client::registry::{Metric, Registry, Unit};

/// The media type of [`super::Metrics::text`].
pub const MEDIA_TYPE: &str = "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// The labels of a family with one label: name and value.
pub(super) type One = [(&'static str, &'static str); 1];

/// The labels of a request.
#[derive(Debug, Clone, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct Request {
    /// The route's template, such as `/v1/jobs/{id}`.
    pub(super) route: String,
    pub(super) method: &'static str,
    /// The status code, or a word for a client that hung up.
    pub(super) status: Cow<'static, str>,
}

/// Every family.
#[derive(Debug)]
pub(super) struct Families {
    pub(super) requests: Family<Request, Histogram>,
    pub(super) refused: Family<One, Counter>,
    pub(super) queue_wait: Family<One, Histogram>,
    pub(super) phases: Family<One, Histogram>,
    pub(super) planning: Family<One, Histogram>,
    pub(super) jobs: Family<One, Gauge>,
    pub(super) jobs_ended: Family<One, Counter>,
    pub(super) attempts: Histogram,
    pub(super) store: Family<[(&'static str, &'static str); 2], Histogram>,
    pub(super) callbacks: Family<One, Counter>,
    pub(super) connections: Gauge,
    pub(super) streams: Gauge,
    pub(super) busy: Family<One, Gauge>,
}

impl Families {
    pub(super) fn new() -> Self {
        Self {
            requests: Family::new_with_constructor(planning_times),
            refused: Family::default(),
            queue_wait: Family::new_with_constructor(waiting_times),
            phases: Family::new_with_constructor(planning_times),
            planning: Family::new_with_constructor(planning_times),
            jobs: Family::default(),
            jobs_ended: Family::default(),
            attempts: attempts(),
            store: Family::new_with_constructor(store_times),
            callbacks: Family::default(),
            connections: Gauge::default(),
            streams: Gauge::default(),
            busy: Family::default(),
        }
    }

    /// All families under their names. A counter's name gets `_total`, a time's `_seconds`.
    pub(super) fn registry(&self) -> Registry {
        let mut registry = Registry::with_prefix("singulate");
        time(&mut registry, "http_request", "From a request's head to its answer's", &self.requests);
        time(&mut registry, "queue_wait", "How long work waited for a thread", &self.queue_wait);
        time(&mut registry, "planning_phase", "The parts of planning", &self.phases);
        time(&mut registry, "planning", "Planning as a whole, by its verdict", &self.planning);
        time(&mut registry, "store", "Calls of the store of jobs", &self.store);
        registry.register(
            "requests_refused",
            "Requests that were turned away, whatever they asked for",
            self.refused.clone(),
        );
        registry.register("jobs", "Jobs that have not ended, in the whole store", self.jobs.clone());
        registry.register("jobs_ended", "Jobs that this server saw end", self.jobs_ended.clone());
        registry.register("job_attempts", "The number of each attempt at a job, from 1", self.attempts.clone());
        registry.register("callbacks", "Tries to deliver a callback", self.callbacks.clone());
        registry.register("connections_open", "Connections of clients", self.connections.clone());
        registry.register("streams_open", "Streams of events", self.streams.clone());
        registry.register("threads_busy", "Threads that compute", self.busy.clone());
        registry
    }
}

fn time<M: Metric + Clone>(registry: &mut Registry, name: &str, help: &str, family: &M) {
    registry.register_with_unit(name, help, Unit::Seconds, family.clone());
}

/// Bounds of histograms, s, in steps of about three: they show shifts and keep series short. From 0.1 ms, which the smallest
/// scenes take, over HTTP too.
const SUB_SECOND: [f64; 8] = [0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3];

/// Up to the longest default time limit, 60 s.
fn planning_times() -> Histogram {
    Histogram::new(SUB_SECOND.into_iter().chain([1.0, 3.0, 10.0, 30.0, 60.0]))
}

/// A client waits at most its time limit, a job at most its retention: an hour by default.
fn waiting_times() -> Histogram {
    Histogram::new(SUB_SECOND.into_iter().chain([1.0, 3.0, 10.0, 30.0, 60.0, 300.0, 1000.0, 3600.0]))
}

/// Store calls of more than 5 s count as failed everywhere.
fn store_times() -> Histogram {
    Histogram::new(SUB_SECOND.into_iter().chain([1.0, 5.0]))
}

/// A job has at most three attempts.
fn attempts() -> Histogram {
    Histogram::new(once(1.0).chain([2.0, 3.0]))
}
