//! `/v1/jobs`: asynchronous planning.

mod calls;
mod collection;
mod events;
mod one;
mod problems;
mod query;
mod submission;

pub(super) use calls::JobCalls;
pub(super) use collection::{__path_batch, __path_list, __path_submit, batch, list, submit};
pub(super) use events::{__path_events, events};
pub(super) use one::{__path_cancel, __path_forget, __path_show, cancel, forget, show};
