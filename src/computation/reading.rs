//! Reads bodies without blocking the threads that serve connections, and without delaying an answer past its time.

use core::ops::Deref;
use std::sync::OnceLock;

use super::Computation;
use super::engine::panicked;
use super::problem::internal;
use crate::wire::{Glance, Problem, RequestLimits};

/// Bodies up to this many bytes (about 250 objects) are read on the connection's thread. Larger ones are read on the pool,
/// within the time limit; until then only the glance is known.
pub(super) const SMALL_BODY: usize = 16 * 1024;

/// A body, read now or later.
pub(super) struct Reading<C: Computation, B> {
    /// A large body, kept until the answer is there.
    body: Option<B>,
    limits: RequestLimits,
    glance: Glance,
    request: OnceLock<C::Request>,
}

/// The known part of a request at its time-out.
pub enum KnownRequest<'a, R> {
    /// The whole request.
    Request(&'a R),
    /// The body was too large to be read in time.
    Glance(&'a Glance),
}

impl<C: Computation, B: Deref<Target = [u8]>> Reading<C, B> {
    /// Read a small body; glance at a large one, unless that was done before.
    ///
    /// # Errors
    /// A problem with every fault of a small body.
    pub(super) fn begin(body: B, glance: Option<Glance>, limits: RequestLimits) -> Result<Self, Problem> {
        if body.len() > SMALL_BODY {
            let glance = glance.unwrap_or_else(|| Glance::at(&body, &limits));
            return Ok(Self { body: Some(body), limits, glance, request: OnceLock::new() });
        }
        let request = C::read(&body, &limits)?;
        let known = request.as_ref();
        let glance = Glance { scene_id: known.scene_id.clone(), target: None, time_limit: known.time_limit };
        Ok(Self { body: None, limits, glance, request: OnceLock::from(request) })
    }

    fn bytes(&self) -> &[u8] {
        self.body.as_deref().unwrap_or_default()
    }

    /// The glance, available at once.
    pub(super) fn glance(&self) -> &Glance {
        &self.glance
    }

    /// The request; reads the body on the first call.
    ///
    /// # Errors
    /// A problem with every fault of the body.
    pub(super) fn request(&self) -> Result<&C::Request, Problem> {
        if let Some(request) = self.request.get() {
            return Ok(request);
        }
        let request = C::read(self.bytes(), &self.limits)?;
        Ok(self.request.get_or_init(|| request))
    }

    /// The computation panicked: logs all that is needed to reproduce it.
    pub(super) fn panicked(&self) -> Problem {
        match self.request.get() {
            Some(request) => panicked(request.as_ref()),
            None => {
                tracing::error!(body = %String::from_utf8_lossy(self.bytes()), "reading a body panicked");
                internal()
            }
        }
    }

    /// The known part of the request now.
    pub(super) fn known(&self) -> KnownRequest<'_, C::Request> {
        self.request.get().map_or(KnownRequest::Glance(&self.glance), KnownRequest::Request)
    }
}
