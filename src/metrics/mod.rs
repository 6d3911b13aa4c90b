//! Metrics: counts and times, never ids, owners or other labels of unbounded number.
//!
//! Each server has its own [`Metrics`], so that several in one process don't mix. The parts of the service record here;
//! `/metrics` writes the text.

mod buckets;
mod families;
mod labels;
mod milliseconds;
mod recorder;

pub use families::MEDIA_TYPE;
pub use labels::{CallbackOutcome, Ended, Queue, Refusal, StoreOutcome};
pub use milliseconds::milliseconds;
pub use recorder::{Metrics, Open};
