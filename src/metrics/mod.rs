//! What is measured, for whoever watches the service: counts and times, never ids, owners or anything else of which there
//! can be any number.
//!
//! Each server has [`Metrics`] of its own, so that several in one process don't mix. Whatever does the work records here;
//! `/metrics` writes it out.

mod buckets;
mod families;
mod labels;
mod milliseconds;
mod recorder;

pub use families::MEDIA_TYPE;
pub use labels::{CallbackOutcome, Ended, Queue, Refusal, StoreOutcome};
pub use milliseconds::milliseconds;
pub use recorder::{Metrics, Open};
