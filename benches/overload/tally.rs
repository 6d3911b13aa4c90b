//! What was offered and what became of it.

use std::collections::BTreeMap;
use std::io;
use std::time::Duration;

use super::client::Reply;

/// Which request of the mix.
#[derive(Clone, Copy)]
pub(super) enum Order {
    Plan(usize),
    Job(usize),
}

/// All that was sent and answered.
#[derive(Default)]
pub(super) struct Tally {
    pub(super) plans: Kind,
    pub(super) jobs: Kind,
    /// For how long requests were sent.
    pub(super) sending: Duration,
    /// What was due while every connection waited.
    pub(super) unsent: usize,
    /// How long after its time limit each plan that was accepted was there.
    pub(super) lateness: Vec<Duration>,
    /// The places of the jobs that were accepted.
    pub(super) accepted: Vec<String>,
    /// Answers that should not be, each with its number.
    pub(super) faults: BTreeMap<String, usize>,
}

/// One kind of request.
#[derive(Default)]
pub(super) struct Kind {
    pub(super) sent: usize,
    pub(super) accepted: usize,
    pub(super) refused: usize,
    faulty: usize,
}

impl Kind {
    pub(super) fn unanswered(&self) -> usize {
        self.sent - self.accepted - self.refused - self.faulty
    }
}

impl Tally {
    pub(super) fn unanswered(&self) -> usize {
        self.plans.unanswered() + self.jobs.unanswered()
    }

    pub(super) fn sent(&mut self, order: Order) {
        self.kind(order).sent += 1;
    }

    pub(super) fn answered(&mut self, order: Order, late: Duration, reply: io::Result<Reply>) {
        let fault = match (order, reply) {
            (Order::Plan(_), Ok(reply)) if reply.status == 200 => {
                self.lateness.push(late);
                self.plans.accepted += 1;
                return;
            }
            (Order::Job(_), Ok(reply)) if reply.status == 202 => {
                self.accepted.extend(reply.header("location").map(str::to_owned));
                self.jobs.accepted += 1;
                return;
            }
            (_, Ok(reply)) if matches!(reply.status, 429 | 503) && reply.header("retry-after").is_some() => {
                self.kind(order).refused += 1;
                return;
            }
            (_, Ok(reply)) => format!("{}: {}", reply.status, String::from_utf8_lossy(&reply.body)),
            (_, Err(error)) => error.to_string(),
        };
        self.kind(order).faulty += 1;
        *self.faults.entry(fault).or_default() += 1;
    }

    pub(super) fn kind(&mut self, order: Order) -> &mut Kind {
        match order {
            Order::Plan(_) => &mut self.plans,
            Order::Job(_) => &mut self.jobs,
        }
    }
}
