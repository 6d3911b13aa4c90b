//! Reads bodies without holding up the threads that serve connections, nor any answer past its time.

use std::sync::OnceLock;

use tokio::task::spawn_blocking;

use super::problem::internal;
use crate::wire::{Glance, PlanRequest, Problem, RequestLimits};

/// Bodies up to this many bytes are read where they arrive: a millisecond or two. Larger ones are read by the planning
/// thread that answers them, so that its time limit covers the reading; until then a glance must do.
const SMALL_BODY: usize = 64 * 1024;

/// Reads a body.
pub(super) type Read<R> = fn(&[u8], &RequestLimits) -> Result<R, Problem>;

/// A body that has been read or will be.
pub(super) struct Reading<R> {
    body: Vec<u8>,
    read: Read<R>,
    limits: RequestLimits,
    glance: Glance,
    request: OnceLock<R>,
}

/// What is known of a request whose time is up.
pub(super) enum Known<'a, R> {
    /// All of it.
    Request(&'a R),
    /// It was too large to be read in time.
    Glance(&'a Glance),
}

impl<R: AsRef<PlanRequest> + Send + Sync + 'static> Reading<R> {
    /// Read a small body, glance at a large one.
    ///
    /// # Errors
    /// A problem with every fault of a small body.
    pub(super) async fn begin(body: Vec<u8>, read: Read<R>, limits: RequestLimits) -> Result<Self, Problem> {
        if body.len() > SMALL_BODY {
            let glance = move || {
                let glance = Glance::at(&body, &limits);
                Self { body, read, limits, glance, request: OnceLock::new() }
            };
            return spawn_blocking(glance).await.map_err(|_| internal());
        }
        let request = read(&body, &limits)?;
        let known = request.as_ref();
        let glance = Glance { scene_id: known.scene_id.clone(), target: None, time_limit: known.time_limit };
        Ok(Self { body: Vec::new(), read, limits, glance, request: OnceLock::from(request) })
    }

    /// What can be told at once.
    pub(super) fn glance(&self) -> &Glance {
        &self.glance
    }

    /// The request, read now if it has not been.
    ///
    /// # Errors
    /// A problem with every fault of the body.
    pub(super) fn request(&self) -> Result<&R, Problem> {
        if let Some(request) = self.request.get() {
            return Ok(request);
        }
        let request = (self.read)(&self.body, &self.limits)?;
        Ok(self.request.get_or_init(|| request))
    }

    /// As much as is known by now.
    pub(super) fn known(&self) -> Known<'_, R> {
        self.request.get().map_or(Known::Glance(&self.glance), Known::Request)
    }
}
