//! Access control. Each operation states next to its route which scope it needs; without it neither handler nor body is
//! reached.

use core::future::pending;
use core::time::Duration;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use axum::body::Body;
use axum::extract::{FromRequestParts, State};
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderValue, Request, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use tracing::Span;

use super::problem::CHALLENGE;
use crate::computation::internal;
use crate::jobs::Owner;
use crate::keys::{FoundKey, Keys, KeysError, Scope};
use crate::metrics::{Metrics, Refusal};
use crate::wire::{Problem, ProblemKind};

/// The access that an operation needs.
#[derive(Debug, Clone, Copy)]
pub(super) enum Need {
    /// No key.
    Nothing,
    /// Any valid key.
    AnyKey,
    /// A key with one of these scopes, the least first.
    OneOf(&'static [Scope]),
}

/// The caller of a request.
#[derive(Clone)]
pub(super) struct Caller {
    /// The owner of the caller's jobs, for fair queuing too.
    pub(super) owner: Owner,
    key: Option<FoundKey>,
}

impl Caller {
    /// Done once the caller's key is no longer in force.
    pub(super) async fn locked_out(&self) {
        match &self.key {
            Some(key) => key.gone().cancelled().await,
            None => pending().await,
        }
    }
}

impl<S: Sync> FromRequestParts<S> for Caller {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Problem> {
        // Fails on a route without `guard`.
        parts.extensions.get().cloned().ok_or_else(internal)
    }
}

/// Checks the keys of callers.
pub(super) struct Gate {
    /// Without keys, access is open.
    keys: Option<Keys>,
    metrics: Arc<Metrics>,
}

impl Gate {
    /// Read the keys file, if there is one.
    ///
    /// # Errors
    /// If it is invalid.
    pub(super) fn open(keys: Option<&Path>, metrics: Arc<Metrics>) -> Result<Self, KeysError> {
        Ok(Self { keys: keys.map(Keys::open).transpose()?, metrics })
    }

    /// Reload the keys whenever the file changes.
    pub(super) async fn watch(&self) {
        if let Some(keys) = &self.keys {
            keys.watch().await;
        }
    }

    fn admit(&self, need: Need, headers: &HeaderMap) -> Result<Caller, NotAdmitted> {
        match &self.keys {
            Some(keys) => admit(keys, need, headers),
            None => Ok(Caller { owner: Owner::anonymous(), key: None }),
        }
    }
}

/// The middleware of an operation that needs a key.
pub(super) async fn guard(
    State((gate, need)): State<(Arc<Gate>, Need)>,
    mut request: Request<Body>,
    next: Next,
) -> Response {
    let caller = gate.admit(need, request.headers());
    match caller {
        Ok(caller) => {
            request.extensions_mut().insert(caller);
            next.run(request).await
        }
        Err(refused) => {
            gate.metrics.refused(refused.refusal());
            refused.into_response()
        }
    }
}

/// Why a caller is refused.
pub(super) enum NotAdmitted {
    NoKey,
    WrongKey,
    /// It is for none of these.
    Scope(&'static [Scope]),
    /// Until it may be used again.
    Rate(Duration),
}

fn admit(keys: &Keys, need: Need, headers: &HeaderMap) -> Result<Caller, NotAdmitted> {
    let key = keys.find(presented(headers)?).ok_or(NotAdmitted::WrongKey)?;
    // For the log.
    Span::current().record("key", key.name());
    // A refused operation counts too, or it could be tried without limit.
    key.spend(Instant::now()).map_err(NotAdmitted::Rate)?;
    match need {
        Need::OneOf(scopes) if !key.is_for(scopes) => Err(NotAdmitted::Scope(scopes)),
        _ => Ok(Caller { owner: Owner::named(key.name()), key: Some(key) }),
    }
}

/// The key in the request.
fn presented(headers: &HeaderMap) -> Result<&[u8], NotAdmitted> {
    let mut fields = headers.get_all(header::AUTHORIZATION).iter();
    let Some(field) = fields.next() else { return Err(NotAdmitted::NoKey) };
    if fields.next().is_some() {
        return Err(NotAdmitted::WrongKey);
    }
    let mut parts = field.as_bytes().splitn(2, |byte| *byte == b' ');
    if !parts.next().unwrap_or_default().eq_ignore_ascii_case(b"bearer") {
        return Err(NotAdmitted::NoKey);
    }
    Ok(parts.next().unwrap_or_default().trim_ascii())
}

impl NotAdmitted {
    fn refusal(&self) -> Refusal {
        match self {
            Self::NoKey | Self::WrongKey => Refusal::Unauthorized,
            Self::Scope(_) => Refusal::Forbidden,
            Self::Rate(_) => Refusal::RateExceeded,
        }
    }

    pub(super) fn problem(&self) -> Problem {
        match self {
            Self::NoKey => {
                Problem::new(ProblemKind::Unauthorized, "send the header Authorization: Bearer and your key")
            }
            Self::WrongKey => Problem::new(ProblemKind::Unauthorized, "the key is unknown or no longer valid"),
            Self::Scope(scopes) => {
                let words: Vec<&str> = scopes.iter().map(|scope| scope.as_str()).collect();
                Problem::new(ProblemKind::Forbidden, format!("this needs a key for {}", words.join(" or ")))
            }
            Self::Rate(after) => {
                let problem =
                    Problem::new(ProblemKind::RateExceeded, "the key was used more often than its rate allows");
                problem.with_retry_after(*after)
            }
        }
    }

    /// The parameters of the challenge besides the scheme (RFC 6750, section 3).
    fn challenge(&self) -> Option<String> {
        match self {
            Self::WrongKey => Some(format!("{CHALLENGE}, error=\"invalid_token\"")),
            Self::Scope(scopes) => {
                let least = scopes.first().map_or("", |scope| scope.as_str());
                Some(format!("{CHALLENGE}, error=\"insufficient_scope\", scope=\"{least}\""))
            }
            Self::NoKey | Self::Rate(_) => None,
        }
    }
}

impl IntoResponse for NotAdmitted {
    fn into_response(self) -> Response {
        let mut response = self.problem().into_response();
        if let Some(challenge) = self.challenge().and_then(|text| HeaderValue::try_from(text).ok()) {
            response.headers_mut().insert(header::WWW_AUTHENTICATE, challenge);
        }
        response
    }
}
