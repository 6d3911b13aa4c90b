//! Faults as problem documents (RFC 9457).

use core::fmt;
use core::time::Duration;

use serde::Serialize;
use utoipa::ToSchema;

use super::code::{ERRORS_PAGE, ErrorCode};

/// One fault of a request.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct ErrorItem {
    /// The kind of fault, a word for programs.
    pub code: ErrorCode,
    /// The place in the request body, a JSON pointer (RFC 6901). Empty for the body as a whole.
    #[schema(example = "/objects/3/radius")]
    pub pointer: String,
    /// One sentence for people.
    #[schema(example = "-0.075 is not between 0.000001 and 1000")]
    pub detail: String,
    /// The place in the project's documentation that explains cause and cure.
    #[schema(example = "docs/errors.md#out_of_range")]
    see: String,
}

impl ErrorItem {
    /// A fault of this kind.
    pub fn new(code: ErrorCode, pointer: impl Into<String>, detail: impl Into<String>) -> Self {
        Self { code, pointer: pointer.into(), detail: detail.into(), see: code.entry() }
    }

    /// The page that explains cause and remedy.
    pub fn see(&self) -> &str {
        &self.see
    }
}

/// A warning about a scene or an answer, in the same form as a fault.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct WarningItem {
    /// The kind of warning, a word for programs. Later versions may add some. A client ignores a word that it does not
    /// know.
    #[schema(example = "overlap")]
    pub code: String,
    /// The place in the request body, a JSON pointer (RFC 6901). Empty for the body as a whole.
    #[schema(example = "/objects/2")]
    pub pointer: String,
    /// One sentence for people.
    #[schema(example = "overlaps 'plate-1' by 0.000400 m (tolerance 0.001 m)")]
    pub detail: String,
}

/// The kinds of problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[schema(example = "urn:singulate:problem:invalid_request")]
pub enum ProblemKind {
    /// The body is not JSON.
    #[serde(rename = "urn:singulate:problem:malformed_json")]
    MalformedJson,
    /// The body is JSON, but not a request that can be answered.
    #[serde(rename = "urn:singulate:problem:invalid_request")]
    InvalidRequest,
    /// No valid key or client certificate came with the request.
    #[serde(rename = "urn:singulate:problem:unauthorized")]
    Unauthorized,
    /// The key lacks the scope for this call.
    #[serde(rename = "urn:singulate:problem:forbidden")]
    Forbidden,
    /// The key was used more often than its rate allows.
    #[serde(rename = "urn:singulate:problem:rate_exceeded")]
    RateExceeded,
    /// Nothing lives at this path.
    #[serde(rename = "urn:singulate:problem:not_found")]
    NotFound,
    /// The path lives, but not with this method.
    #[serde(rename = "urn:singulate:problem:method_not_allowed")]
    MethodNotAllowed,
    /// No representation that the client accepts.
    #[serde(rename = "urn:singulate:problem:not_acceptable")]
    NotAcceptable,
    /// The body came too slowly.
    #[serde(rename = "urn:singulate:problem:body_timeout")]
    BodyTimeout,
    /// The body is too large.
    #[serde(rename = "urn:singulate:problem:body_too_large")]
    BodyTooLarge,
    /// The body is not declared to be JSON.
    #[serde(rename = "urn:singulate:problem:unsupported_media_type")]
    UnsupportedMediaType,
    /// The connection broke or the transfer was garbled before the body was complete.
    #[serde(rename = "urn:singulate:problem:broken_body")]
    BrokenBody,
    /// The head of the request is not HTTP/1.1.
    #[serde(rename = "urn:singulate:problem:malformed_http")]
    MalformedHttp,
    /// The request's path is too long.
    #[serde(rename = "urn:singulate:problem:uri_too_long")]
    UriTooLong,
    /// The head of the request is too large.
    #[serde(rename = "urn:singulate:problem:head_too_large")]
    HeadTooLarge,
    /// The idempotency key came with another request before.
    #[serde(rename = "urn:singulate:problem:key_reused")]
    KeyReused,
    /// The job has ended, so nothing is left to be cancelled.
    #[serde(rename = "urn:singulate:problem:job_finished")]
    JobFinished,
    /// The job has not ended, so it can't be forgotten.
    #[serde(rename = "urn:singulate:problem:job_unfinished")]
    JobUnfinished,
    /// The store of jobs can't be reached.
    #[serde(rename = "urn:singulate:problem:store_unavailable")]
    StoreUnavailable,
    /// Every thread is busy, and the queue is full or no thread would be free in time.
    #[serde(rename = "urn:singulate:problem:overloaded")]
    Overloaded,
    /// The service does not take requests now.
    #[serde(rename = "urn:singulate:problem:not_ready")]
    NotReady,
    /// The answer did not pass its own check and is withheld.
    #[serde(rename = "urn:singulate:problem:check_failed")]
    CheckFailed,
    /// The job ended three workers.
    #[serde(rename = "urn:singulate:problem:poison")]
    Poison,
    /// A defect of the service.
    #[serde(rename = "urn:singulate:problem:internal")]
    Internal,
}

impl ProblemKind {
    /// The entry that explains it.
    fn entry(self) -> String {
        let uri = self.to_string();
        format!("{ERRORS_PAGE}#problem-{}", uri.rsplit(':').next().unwrap_or_default())
    }

    /// The status code and the title.
    fn status_and_title(self) -> (u16, &'static str) {
        match self {
            Self::MalformedJson => (400, "The body is not JSON"),
            Self::BrokenBody => (400, "The body is incomplete"),
            Self::MalformedHttp => (400, "The request is not HTTP"),
            Self::Unauthorized => (401, "Not authorized"),
            Self::Forbidden => (403, "The key is not for this"),
            Self::RateExceeded => (429, "Too many requests"),
            Self::NotFound => (404, "Nothing lives at this path"),
            Self::MethodNotAllowed => (405, "The method is not allowed here"),
            Self::NotAcceptable => (406, "No acceptable representation"),
            Self::BodyTimeout => (408, "The body came too slowly"),
            Self::BodyTooLarge => (413, "The body is too large"),
            Self::UnsupportedMediaType => (415, "The body must be JSON"),
            Self::InvalidRequest => (422, "The request is invalid"),
            Self::KeyReused => (422, "The idempotency key belongs to another request"),
            Self::JobFinished => (409, "The job has ended"),
            Self::JobUnfinished => (409, "The job has not ended"),
            Self::UriTooLong => (414, "The path is too long"),
            Self::HeadTooLarge => (431, "The head is too large"),
            Self::CheckFailed => (500, "The answer did not pass its check"),
            Self::Poison => (500, "The job ended three workers"),
            Self::Internal => (500, "Internal error"),
            Self::StoreUnavailable => (503, "The store of jobs is unavailable"),
            Self::Overloaded => (503, "Overloaded"),
            Self::NotReady => (503, "Not ready"),
        }
    }
}

impl fmt::Display for ProblemKind {
    /// Its name in JSON.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// A problem for a log line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LoggedProblem {
    /// The kind of problem.
    pub problem: ProblemKind,
    /// The kind of the first fault, if the body has any.
    pub code: Option<ErrorCode>,
}

/// A problem document: why there is no answer.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct Problem {
    /// The kind of problem, a URI for programs.
    #[serde(rename = "type")]
    kind: ProblemKind,
    /// The kind of problem, for people.
    #[schema(example = "The request is invalid")]
    title: &'static str,
    /// The status code of the response.
    #[schema(example = 422, minimum = 400, maximum = 599)]
    status: u16,
    /// What happened this time.
    #[schema(example = "1 fault")]
    detail: String,
    /// The place in the project's documentation that explains cause and cure.
    #[schema(example = "docs/errors.md#problem-invalid_request")]
    see: String,
    /// Every fault that was found in the body, at most 1000. Empty if the body is not at fault.
    #[schema(max_items = 1000, example = json!([{
        "code": "out_of_range",
        "pointer": "/objects/3/radius",
        "detail": "-0.075 is not between 0.000001 and 1000",
        "see": "docs/errors.md#out_of_range"
    }]))]
    errors: Vec<ErrorItem>,
    /// When to come again, where that is known; goes out as a header.
    #[serde(skip)]
    #[schema(ignore)]
    retry_after: Option<Duration>,
}

impl Problem {
    /// A problem of this kind.
    pub fn new(kind: ProblemKind, detail: impl Into<String>) -> Self {
        let (status, title) = kind.status_and_title();
        Self { kind, title, status, detail: detail.into(), see: kind.entry(), errors: Vec::new(), retry_after: None }
    }

    /// A body with these faults.
    pub fn invalid(errors: Vec<ErrorItem>) -> Self {
        let detail = if errors.len() == 1 { "1 fault".to_owned() } else { format!("{} faults", errors.len()) };
        Self::new(ProblemKind::InvalidRequest, detail).with_errors(errors)
    }

    /// A valid scene that is too dense for the memory limits.
    pub fn too_dense(detail: String) -> Self {
        Self::invalid(vec![ErrorItem::new(ErrorCode::TooDense, "/objects", detail)])
    }

    /// The same problem with these faults.
    #[must_use]
    pub(super) fn with_errors(self, errors: Vec<ErrorItem>) -> Self {
        Self { errors, ..self }
    }

    /// The same problem under another title, if the kind's own title would mislead.
    #[must_use]
    pub fn with_title(self, title: &'static str) -> Self {
        Self { title, ..self }
    }

    /// The same problem with a `Retry-After`.
    #[must_use]
    pub fn with_retry_after(self, retry_after: Duration) -> Self {
        Self { retry_after: Some(retry_after), ..self }
    }

    /// The time for `Retry-After`, if known.
    pub fn retry_after(&self) -> Option<Duration> {
        self.retry_after
    }

    /// The kind.
    pub fn kind(&self) -> ProblemKind {
        self.kind
    }

    /// For a log line.
    pub fn cause(&self) -> LoggedProblem {
        LoggedProblem { problem: self.kind, code: self.errors.first().map(|error| error.code) }
    }

    /// The status code.
    pub fn status(&self) -> u16 {
        self.status
    }

    /// The details of this occurrence.
    pub fn detail(&self) -> &str {
        &self.detail
    }

    /// Every fault found in the body.
    pub fn errors(&self) -> &[ErrorItem] {
        &self.errors
    }
}

impl fmt::Display for Problem {
    /// The title and the detail, then one line per fault.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.title, self.detail)?;
        for ErrorItem { code, pointer, detail, .. } in self.errors.iter().filter(|error| !error.pointer.is_empty()) {
            write!(f, "\n  {pointer}: {detail} ({code})")?;
        }
        Ok(())
    }
}

impl core::error::Error for Problem {}
