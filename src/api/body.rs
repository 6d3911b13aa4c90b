//! Receives a request's body: its declared type, its size, the time it takes.

use core::future::poll_fn;
use core::pin::Pin;

use axum::body::{Body, Bytes};
use axum::http::{HeaderMap, Request, header};
use hyper::body::Body as _;
use tokio::time::timeout;

use super::settings::ServerSettings;
use crate::wire::{Problem, ProblemKind};

/// The whole body of a request that declares JSON.
///
/// # Errors
/// A problem if the type is another one, or the body is too large, too slow or incomplete.
pub(super) async fn receive(request: Request<Body>, settings: &ServerSettings) -> Result<Vec<u8>, Problem> {
    check_type(request.headers())?;
    let max = settings.max_body_bytes;
    // Who asks before sending is told at once: the system's 100 goes out only when the body is waited for.
    if request.headers().contains_key(header::EXPECT) && request.body().size_hint().lower() > max as u64 {
        return Err(too_large(max));
    }
    let mut intake = Intake { received: Vec::new(), max, too_large: false };
    match timeout(settings.body_timeout, intake.take(request.into_body())).await {
        Ok(taken) => taken?,
        Err(_) if intake.too_large => {}
        Err(_) => {
            let seconds = settings.body_timeout.as_secs_f64();
            let detail = format!("the body was not complete after {seconds} s");
            return Err(Problem::new(ProblemKind::BodyTimeout, detail));
        }
    }
    if intake.too_large { Err(too_large(max)) } else { Ok(intake.received) }
}

fn too_large(max: usize) -> Problem {
    Problem::new(ProblemKind::BodyTooLarge, format!("a body has at most {max} bytes"))
}

/// What has been received so far.
struct Intake {
    received: Vec<u8>,
    max: usize,
    too_large: bool,
}

impl Intake {
    /// Take in all of the body. What is too large is not kept, but taken to its end all the same: many clients read the
    /// answer only once they have sent everything.
    async fn take(&mut self, mut body: Body) -> Result<(), Problem> {
        while let Some(piece) = next(&mut body).await? {
            self.too_large |= self.received.len() + piece.len() > self.max;
            if self.too_large {
                self.received = Vec::new();
            } else {
                self.received.extend_from_slice(&piece);
            }
        }
        Ok(())
    }
}

/// The next piece of data; trailers are passed over.
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
