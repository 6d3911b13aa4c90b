//! Durable jobs: an accepted job is on disk, runs on any server that has room, and ends once.
//!
//! A [`Store`], made by [`open`], keeps them. A runner claims them under leases and plans. Watchers are woken by
//! [`Hints`] and read the job from the store. Below the runner, time is an argument.

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
