//! The service as its client sees it: two questions, asked again where that can help.

use core::error::Error;
use core::time::Duration;

use reqwest::header::RETRY_AFTER;
use reqwest::redirect::Policy;
use reqwest::{Client, Response, StatusCode};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::answer::{Answer, Plan, read_replan};
use crate::scene::Scene;

const TRIES: u32 = 5;
/// Before a lost connection is tried again; each pause is twice the last.
const FIRST_PAUSE: Duration = Duration::from_millis(200);
const LONGEST_WAIT: Duration = Duration::from_secs(60);
/// How much longer a call may take than the planning that it asks for.
const BEYOND_THE_TIME_LIMIT: Duration = Duration::from_secs(5);

/// Why there is no answer.
pub(crate) enum Failure {
    /// The scene is not in order.
    Invalid(Vec<Fault>),
    /// The key is missing, wrong, or not meant for this.
    Forbidden(String),
    Other(String),
}

/// An answer that is not understood.
impl From<serde_json::Error> for Failure {
    fn from(error: serde_json::Error) -> Self {
        Self::Other(format!("refused: {error}"))
    }
}

#[derive(Deserialize)]
pub(crate) struct Fault {
    pub(crate) code: String,
    pub(crate) pointer: String,
    pub(crate) detail: String,
}

/// What went wrong, in the service's words. Something else may have answered: then there is nothing in it.
#[derive(Deserialize, Default)]
#[serde(default)]
struct Problem {
    title: Option<String>,
    errors: Vec<Fault>,
}

/// How one try ended without an answer that counts.
enum Setback {
    Again { reason: String, pause: Duration },
    ForGood(Failure),
}

pub(crate) struct Service {
    client: Client,
    url: String,
    key: Option<String>,
}

impl Service {
    pub(crate) fn new(url: &str, key: Option<String>) -> Result<Self, Failure> {
        // The features of reqwest that are at hand leave the choice of cryptography to us. Only a second one is refused.
        let _ = rustls::crypto::ring::default_provider().install_default();
        // The key is for this address alone.
        let client =
            Client::builder().redirect(Policy::none()).build().map_err(|error| Failure::Other(innermost(&error)))?;
        Ok(Self { client, url: url.trim_end_matches('/').to_owned(), key })
    }

    pub(crate) async fn plan(&self, scene: &Scene) -> Result<Answer, Failure> {
        Ok(Answer::read(&self.ask("/v1/plans", &scene.0, scene.limit_ms()).await?)?)
    }

    /// Whether what is left of a plan can't be carried out any more on the table as it is now.
    pub(crate) async fn replan(&self, scene: &Scene, left: &Plan, tolerance: f64) -> Result<bool, Failure> {
        let body = json!({"scene": scene.0, "plan": left.body, "partial": true, "position_tolerance": tolerance});
        Ok(read_replan(&self.ask("/v1/plans/verify", &body, scene.limit_ms()).await?)?)
    }

    /// Ask until there is an answer. Neither question changes anything on the server, so asking again is safe.
    async fn ask(&self, path: &str, body: &Value, limit_ms: u64) -> Result<String, Failure> {
        let limit = Duration::from_millis(limit_ms) + BEYOND_THE_TIME_LIMIT;
        for tried in 1.. {
            match self.once(path, body, limit, FIRST_PAUSE * 2_u32.pow(tried - 1)).await {
                Ok(answer) => return Ok(answer),
                Err(Setback::ForGood(failure)) => return Err(failure),
                Err(Setback::Again { reason, .. }) if tried == TRIES => {
                    return Err(Failure::Other(format!("gave up: {reason}")));
                }
                Err(Setback::Again { reason, pause }) => {
                    eprintln!("{reason}: again in {} s", pause.as_secs_f64());
                    tokio::time::sleep(pause).await;
                }
            }
        }
        unreachable!("the last try has returned")
    }

    async fn once(&self, path: &str, body: &Value, limit: Duration, pause: Duration) -> Result<String, Setback> {
        let lost = |error: reqwest::Error| {
            if error.is_builder() || is_of_certificate(&error) {
                return Setback::ForGood(Failure::Other(innermost(&error)));
            }
            let what = if error.is_timeout() { "no answer in time".to_owned() } else { innermost(&error) };
            Setback::Again { reason: format!("connection lost: {what}"), pause }
        };
        let request =
            self.client.post(self.url.clone() + path).header("content-type", "application/json").timeout(limit);
        let request = match &self.key {
            Some(key) => request.bearer_auth(key),
            None => request,
        };
        let response = request.body(body.to_string()).send().await.map_err(lost)?;
        let (status, wait) = (response.status(), retry_after(&response));
        let answer = response.text().await.map_err(lost)?;
        if status == StatusCode::OK {
            return Ok(answer);
        }
        let problem: Problem = serde_json::from_str(&answer).unwrap_or_default();
        let title = problem.title.unwrap_or_else(|| format!("status {status}"));
        Err(match status {
            StatusCode::REQUEST_TIMEOUT
            | StatusCode::TOO_MANY_REQUESTS
            | StatusCode::BAD_GATEWAY
            | StatusCode::SERVICE_UNAVAILABLE
            | StatusCode::GATEWAY_TIMEOUT => Setback::Again { reason: title, pause: wait },
            StatusCode::UNPROCESSABLE_ENTITY => Setback::ForGood(Failure::Invalid(problem.errors)),
            StatusCode::UNAUTHORIZED | StatusCode::FORBIDDEN => Setback::ForGood(Failure::Forbidden(title)),
            _ => Setback::ForGood(Failure::Other(title)),
        })
    }
}

/// A date, which the header may hold too, is one that the service does not send.
fn retry_after(response: &Response) -> Duration {
    let text = response.headers().get(RETRY_AFTER).and_then(|value| value.to_str().ok());
    text.and_then(|text| text.parse().ok()).map_or(Duration::from_secs(1), Duration::from_secs).min(LONGEST_WAIT)
}

/// Whether the service's certificate is not trusted: asking again does not change that.
fn is_of_certificate(error: &(dyn Error + 'static)) -> bool {
    if let Some(inner) = error.downcast_ref().and_then(std::io::Error::get_ref) {
        return is_of_certificate(inner);
    }
    matches!(error.downcast_ref(), Some(rustls::Error::InvalidCertificate(_)))
        || error.source().is_some_and(is_of_certificate)
}

/// The cause that says something, without the URL that the others repeat.
fn innermost(error: &dyn Error) -> String {
    match error.source() {
        Some(cause) => innermost(cause),
        None => error.to_string(),
    }
}
