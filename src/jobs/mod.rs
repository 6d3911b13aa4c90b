//! Jobs that are never lost: what was accepted is on disk, runs on whatever server has room, and ends once.
//!
//! A [`Store`], which [`open`] gives, keeps them; a runner claims them, one lease at a time, and plans; whoever watches a
//! job is woken by [`Hints`] and reads it from the store. Time comes in as an argument everywhere below the runner.

mod body;
mod callback;
mod held;
mod hints;
mod job;
mod log;
mod pause;
mod runner;
mod settings;
mod sql;
mod store;
mod sweeper;
mod timestamp;
mod work;

pub use body::message;
pub use callback::{
    CallbackAllow, CallbackDelivery, CallbackFault, CallbackSecret, CallbackUrl, client_builder, trusted_roots,
};
pub(crate) use callback::{client_builder_with, innermost};
pub use hints::{Hints, Watcher};
pub use job::{End, Event, EventKind, Job, JobId, JobState, NewJob, Owner};
pub use log::job_ended;
pub use runner::Runner;
pub use settings::JobSettings;
pub use sql::{OpenError, open};
pub use store::{
    Callback, Cancellation, Claim, Claimed, Counts, Delivery, MAX_ATTEMPTS, MAX_INCUMBENT_EVENTS, Page, Removal,
    Renewal, Store, StoreError, SubmitError, Swept,
};
pub use timestamp::{Timestamp, WallClock};
