//! Receives request bodies: checks media type and size, limits time and memory.

use core::future::poll_fn;
use core::ops::Deref;
use core::pin::Pin;
use core::time::Duration;
use std::sync::Arc;

use axum::body::{Body, Bytes};
use axum::http::{HeaderMap, Request, header};
use hyper::body::Body as _;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::timeout;

use super::settings::ServerSettings;
use crate::metrics::{Metrics, Refusal};
use crate::wire::{Problem, ProblemKind};

/// The unit of body memory, bytes.
const PIECE: usize = 1024;
/// The memory for all bodies together, in units: 64 MB, by default sixteen of the largest. Each connection could hold
/// one.
const ROOM: usize = 64 * 1024;
/// Units that are not counted: most bodies have no more, and a connection itself takes about as much.
const FREE: usize = 16;

/// A body, and its share of the memory as long as it is kept.
pub(super) struct Received {
    bytes: Vec<u8>,
    _room: Option<OwnedSemaphorePermit>,
}

impl Deref for Received {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        &self.bytes
    }
}

/// Receives the bodies of all requests.
pub(super) struct Bodies {
    /// In units.
    room: Arc<Semaphore>,
    max_bytes: usize,
    time_limit: Duration,
    metrics: Arc<Metrics>,
}

impl Bodies {
    /// There is always room for one of the largest bodies.
    pub(super) fn new(settings: &ServerSettings, metrics: Arc<Metrics>) -> Self {
        let (max_bytes, time_limit) = (settings.max_body_bytes, settings.body_timeout);
        let room = Arc::new(Semaphore::new(ROOM.max(max_bytes.div_ceil(PIECE))));
        Self { room, max_bytes, time_limit, metrics }
    }

    /// The whole body of a request that declares JSON.
    ///
    /// # Errors
    /// A problem if the media type is another one, the body is too large, too slow or incomplete, or memory is short.
    pub(super) async fn receive(&self, request: Request<Body>) -> Result<Received, Problem> {
        check_type(request.headers())?;
        let max = self.max_bytes;
        // A declared length that is too large is refused at once. A client that waits for `100 Continue` then never
        // sends.
        if request.body().size_hint().lower() > max as u64 {
            return Err(too_large(max));
        }
        let mut intake = Intake { received: Vec::new(), bodies: &self.room, room: None };
        match timeout(self.time_limit, intake.take(request.into_body(), max)).await {
            Ok(Ok(())) => Ok(Received { bytes: intake.received, _room: intake.room }),
            Ok(Err(NotTaken::Broken(problem))) => Err(problem),
            Ok(Err(NotTaken::TooLarge)) => Err(too_large(max)),
            Ok(Err(NotTaken::NoRoom)) => {
                self.metrics.refused(Refusal::Limit);
                Err(Problem::new(ProblemKind::Overloaded, "too many large bodies are being received"))
            }
            Err(_) => {
                let seconds = self.time_limit.as_secs_f64();
                let detail = format!("the body was not complete after {seconds} s");
                Err(Problem::new(ProblemKind::BodyTimeout, detail))
            }
        }
    }
}

fn too_large(max: usize) -> Problem {
    Problem::new(ProblemKind::BodyTooLarge, format!("a body has at most {max} bytes"))
}

/// Why a body is not received completely.
enum NotTaken {
    TooLarge,
    NoRoom,
    Broken(Problem),
}

/// The part received so far.
struct Intake<'a> {
    received: Vec<u8>,
    bodies: &'a Arc<Semaphore>,
    room: Option<OwnedSemaphorePermit>,
}

impl Intake<'_> {
    /// Receive all of the body, at most `max` bytes.
    async fn take(&mut self, mut body: Body, max: usize) -> Result<(), NotTaken> {
        while let Some(piece) = next(&mut body).await.map_err(NotTaken::Broken)? {
            let length = self.received.len() + piece.len();
            if length > max {
                return Err(NotTaken::TooLarge);
            }
            if !self.make_room(length) {
                return Err(NotTaken::NoRoom);
            }
            self.received.extend_from_slice(&piece);
        }
        Ok(())
    }

    /// True if there is memory for this many bytes.
    fn make_room(&mut self, length: usize) -> bool {
        let held = self.room.as_ref().map_or(0, OwnedSemaphorePermit::num_permits);
        let more = length.div_ceil(PIECE).saturating_sub(FREE).saturating_sub(held);
        let Ok(more) = u32::try_from(more) else { return false };
        if more == 0 {
            return true;
        }
        let Ok(new) = Arc::clone(self.bodies).try_acquire_many_owned(more) else { return false };
        match &mut self.room {
            Some(room) => room.merge(new),
            None => self.room = Some(new),
        }
        true
    }
}

/// The next data frame; trailers are skipped.
async fn next(body: &mut Body) -> Result<Option<Bytes>, Problem> {
    loop {
        let Some(frame) = poll_fn(|context| Pin::new(&mut *body).poll_frame(context)).await else { return Ok(None) };
        let frame = frame.map_err(|error| Problem::new(ProblemKind::BrokenBody, error.to_string()))?;
        if let Ok(data) = frame.into_data() {
            return Ok(Some(data));
        }
    }
}

fn check_type(headers: &HeaderMap) -> Result<(), Problem> {
    let refuse = |detail: String| Err(Problem::new(ProblemKind::UnsupportedMediaType, detail));
    let text = |name| headers.get(name).map(|value| value.to_str().unwrap_or_default());
    if let Some(coding) = text(header::CONTENT_ENCODING).filter(|coding| !coding.eq_ignore_ascii_case("identity")) {
        return refuse(format!("the content encoding '{coding}' is not supported"));
    }
    match text(header::CONTENT_TYPE) {
        None => refuse("there is no Content-Type; send application/json".to_owned()),
        Some(value) if is_json(value) => Ok(()),
        Some(value) => refuse(format!("the Content-Type '{value}' is not application/json in UTF-8")),
    }
}

fn is_json(content_type: &str) -> bool {
    let mut parts = content_type.split(';').map(str::trim);
    let essence = parts.next().unwrap_or_default().to_ascii_lowercase();
    let charset = parts.filter_map(|part| part.split_once('=')).find(|(name, _)| name.eq_ignore_ascii_case("charset"));
    let utf_8 = charset.is_none_or(|(_, value)| value.trim_matches('"').eq_ignore_ascii_case("utf-8"));
    let subtype = essence.strip_prefix("application/").unwrap_or_default();
    utf_8 && (subtype == "json" || subtype.strip_suffix("+json").is_some_and(|name| !name.is_empty()))
}

#[cfg(test)]
mod tests {
    use super::is_json;

    #[test]
    fn json_has_many_names() {
        for name in
            ["application/json", "Application/JSON", "application/json; charset=\"UTF-8\"", "application/ld+json"]
        {
            assert!(is_json(name), "{name}");
        }
        for name in ["text/json", "application/jsonp", "application/json;charset=latin1", "application/+json", ""] {
            assert!(!is_json(name), "{name}");
        }
    }
}
