//! A client that does not give up: what it asks for, it asks again until there is an answer.

use core::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use reqwest::{Error, RequestBuilder};
use serde_json::Value;
use singulate::jobs::{client_builder, trusted_roots};
use tokio::time::{Instant, sleep};

use crate::events::{Message, Messages};
use crate::scenes::Request;
use crate::{LOOK_AGAIN, PATIENCE};

/// Knows where servers are, and asks one after the other.
pub(crate) struct Client {
    urls: Mutex<Vec<String>>,
    turn: AtomicUsize,
    http: reqwest::Client,
}

/// What came back.
#[derive(Debug)]
pub(crate) struct Reply {
    pub(crate) status: u16,
    pub(crate) retry_after: Option<String>,
    text: String,
}

impl Reply {
    async fn to(request: RequestBuilder) -> Result<Self, Error> {
        let response = request.send().await?;
        let status = response.status().as_u16();
        let retry_after = response.headers().get("retry-after").map(|value| value.to_str().unwrap().to_owned());
        Ok(Self { status, retry_after, text: response.text().await? })
    }

    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.text).unwrap_or_else(|_| panic!("not JSON: {self:?}"))
    }
}

pub(crate) fn id(job: &Value) -> String {
    job["id"].as_str().unwrap().to_owned()
}

impl Client {
    pub(crate) fn of(urls: &[&str]) -> Self {
        let client = Self {
            urls: Mutex::default(),
            turn: AtomicUsize::new(0),
            http: client_builder(trusted_roots()).build().unwrap(),
        };
        client.servers_are(urls);
        client
    }

    /// Servers have come or gone.
    pub(crate) fn servers_are(&self, urls: &[&str]) {
        // A test that has failed elsewhere leaves nothing half done here.
        *self.urls.lock().unwrap_or_else(PoisonError::into_inner) = urls.iter().map(|url| (*url).to_owned()).collect();
    }

    /// The server whose turn it is.
    fn next(&self) -> String {
        let urls = self.urls.lock().unwrap_or_else(PoisonError::into_inner);
        urls[self.turn.fetch_add(1, Ordering::Relaxed) % urls.len()].clone()
    }

    fn submission(&self, request: &Request) -> RequestBuilder {
        let post = self.http.post(self.next() + "/v1/jobs").header("content-type", "application/json");
        post.header("idempotency-key", &request.key).body(request.body.clone())
    }

    fn question(&self, path: &str) -> RequestBuilder {
        self.http.get(self.next() + path)
    }

    /// Ask for a job, once.
    pub(crate) async fn try_submit(&self, request: &Request) -> Result<Reply, Error> {
        Reply::to(self.submission(request)).await
    }

    /// Ask once.
    pub(crate) async fn try_get(&self, path: &str) -> Result<Reply, Error> {
        Reply::to(self.question(path)).await
    }

    /// Ask until the job is accepted.
    pub(crate) async fn submit(&self, request: &Request) -> Value {
        let reply = answer(|| self.submission(request)).await;
        assert_eq!(reply.status, 202, "{reply:?}");
        reply.json()
    }

    /// Ask until there is an answer.
    pub(crate) async fn get(&self, path: &str) -> Value {
        let reply = answer(|| self.question(path)).await;
        assert_eq!(reply.status, 200, "{path}: {reply:?}");
        reply.json()
    }

    /// Its time may be over already.
    pub(crate) async fn cancel(&self, id: &str) {
        let path = format!("/v1/jobs/{id}/cancel");
        let reply = answer(|| self.http.post(self.next() + &path)).await;
        assert!([202, 409].contains(&reply.status), "{reply:?}");
    }

    pub(crate) async fn job(&self, id: &str) -> Value {
        self.get(&format!("/v1/jobs/{id}")).await
    }

    /// The job once it is so.
    pub(crate) async fn job_when(&self, id: &str, condition: impl Fn(&Value) -> bool) -> Value {
        let begin = Instant::now();
        loop {
            let job = self.job(id).await;
            if condition(&job) {
                return job;
            }
            assert!(begin.elapsed() < PATIENCE, "it is not yet so with {job}");
            sleep(LOOK_AGAIN).await;
        }
    }

    /// The ids of all jobs, or of those in one state.
    pub(crate) async fn list(&self, state: Option<&str>) -> Vec<String> {
        let (mut ids, mut cursor) = (Vec::new(), String::new());
        let state = state.map(|state| format!("&state={state}")).unwrap_or_default();
        loop {
            let page = self.get(&format!("/v1/jobs?limit=100{state}{cursor}")).await;
            ids.extend(page["jobs"].as_array().unwrap().iter().map(id));
            match page["next_cursor"].as_str() {
                Some(next) => cursor = format!("&cursor={next}"),
                None => return ids,
            }
        }
    }

    /// Listen to a job from after the event that was seen last.
    pub(crate) async fn listen(&self, id: &str, seen: Option<&str>) -> Result<Messages, Error> {
        let mut get = self.question(&format!("/v1/jobs/{id}/events"));
        if let Some(seen) = seen {
            get = get.header("last-event-id", seen);
        }
        let response = get.send().await?.error_for_status()?;
        assert_eq!(response.headers()["content-type"], "text/event-stream");
        Ok(Messages::of(response))
    }

    /// All that happens to a job, however often its stream breaks, and from whatever server it comes.
    pub(crate) async fn follow(&self, id: &str) -> Vec<Message> {
        let (begin, mut all) = (Instant::now(), Vec::<Message>::new());
        loop {
            let seen = all.last().map(|message| message.id.clone());
            if let Ok(mut messages) = self.listen(id, seen.as_deref()).await {
                while let Ok(Some(message)) = messages.next().await {
                    if message.name != "draining" {
                        all.push(message);
                    }
                }
            }
            if all.last().is_some_and(|message| message.name == "finished") {
                return all;
            }
            assert!(begin.elapsed() < 2 * PATIENCE, "{id} does not finish: {all:?}");
            sleep(LOOK_AGAIN).await;
        }
    }
}

/// Servers may be away, or full, or without their database: then they say when to ask again.
async fn answer(request: impl Fn() -> RequestBuilder) -> Reply {
    let begin = Instant::now();
    loop {
        match Reply::to(request()).await {
            Ok(reply) if reply.status != 503 => return reply,
            Ok(reply) => assert!(reply.retry_after.is_some(), "{reply:?}"),
            Err(_) => {}
        }
        assert!(begin.elapsed() < PATIENCE, "nobody answers");
        sleep(LOOK_AGAIN).await;
    }
}
