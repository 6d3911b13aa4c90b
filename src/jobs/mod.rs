//! Jobs that are never lost: what was accepted is on disk, runs on whatever server has room, and ends once.
//!
//! A [`Store`], which [`open`] gives, keeps them; a runner claims them, one lease at a time, and plans; whoever watches a
//! job is woken by [`Hints`] and reads it from the store. Time comes in as an argument everywhere below the runner.

mod body;
mod callback;
mod end;
mod held;
mod hints;
mod job;
mod runner;
mod settings;
mod sql;
mod store;
mod timestamp;
mod upkeep;
mod work;

pub use body::message;
pub use callback::{
    CallbackAllow, CallbackDelivery, CallbackFault, CallbackSecret, CallbackUrl, client_builder, trusted_roots,
};
pub(crate) use callback::{client_builder_with, innermost};
pub use end::{End, job_ended};
pub use hints::{Hints, Watcher};
pub use job::{Event, EventKind, Job, JobId, JobState, MAX_ATTEMPTS, NewJob, Owner};
pub use runner::Runner;
pub use settings::JobSettings;
pub use sql::{OpenError, open};
pub use store::{
    Callback, Cancellation, Claim, Claimed, Counts, Delivery, MAX_INCUMBENT_EVENTS, Page, Removal, Renewal, Store,
    StoreError, SubmitError, Swept,
};
pub use timestamp::{Timestamp, WallClock};
