//! Keys: who is let in, what for, how often, and who sees which jobs.

use core::time::Duration;
use std::io::Write;
use std::net::TcpStream;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use singulate::api::{Engine, ServerSettings};
use singulate::jobs::JobSettings;
use singulate::keys::{FreshKey, append};
use tokio::task::spawn_blocking;
use tokio::time::{sleep, timeout};

use crate::host::{Host, PATIENCE, Reply, endless, read_to_end, scene};

/// More than any test asks.
const OFTEN: &str = "1000000";

/// A server with a keys file of its own.
struct Guarded {
    host: Host,
    file: PathBuf,
}

impl Drop for Guarded {
    fn drop(&mut self) {
        std::fs::remove_file(&self.file).unwrap();
    }
}

fn key(name: &str, scopes: &str, rate: &str) -> FreshKey {
    FreshKey::new(name, scopes.parse().unwrap(), rate.parse().unwrap()).unwrap()
}

impl Guarded {
    async fn with(name: &str, keys: &[&FreshKey], engine: Engine) -> Self {
        let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}.toml", std::process::id()));
        keys.iter().for_each(|key| append(key, &file).unwrap());
        let jobs = JobSettings { threads: 1, ..JobSettings::default() };
        let settings = ServerSettings { api_keys_file: Some(file.clone()), jobs, ..ServerSettings::default() };
        Self { host: Host::with(settings, engine).await, file }
    }

    async fn start(name: &str, keys: &[&FreshKey]) -> Self {
        Self::with(name, keys, Engine::default()).await
    }

    async fn ask(&self, verb: &str, path: &str, authorization: &[&[u8]], body: Option<&Value>) -> Reply {
        let mut request = self.host.client.request(verb.parse().unwrap(), self.host.url(path));
        for value in authorization {
            request = request.header("authorization", *value);
        }
        if let Some(body) = body {
            request = request.header("content-type", "application/json").body(body.to_string());
        }
        Reply::of(request.send().await.unwrap()).await
    }

    async fn call(&self, key: &FreshKey, verb: &str, path: &str, body: Option<&Value>) -> Reply {
        self.ask(verb, path, &[format!("Bearer {}", key.text()).as_bytes()], body).await
    }

    async fn get(&self, key: &FreshKey, path: &str) -> Reply {
        self.call(key, "GET", path, None).await
    }

    /// The path of a new job.
    async fn submit(&self, key: &FreshKey) -> String {
        let reply = self.call(key, "POST", "/v1/jobs", Some(&scene(60_000))).await;
        assert_eq!(reply.status, 202, "{reply:?}");
        reply.header("location").to_owned()
    }
}

/// Every operation of the interface document: its verb, its path with a name in place of `{id}`, and what a key must be
/// for where there are keys.
fn operations() -> Vec<(String, String, Option<Vec<String>>)> {
    let document: Value = serde_json::from_str(include_str!("../../openapi/openapi.json")).unwrap();
    let mut operations = Vec::new();
    for (path, item) in document["paths"].as_object().unwrap() {
        for (verb, operation) in item.as_object().unwrap() {
            let scopes = operation["security"].as_array().map(|list| {
                assert_eq!(list[0], json!({}), "a service without keys asks for none");
                let words = list[1..].iter().flat_map(|one| one["bearer"].as_array().unwrap());
                words.map(|word| word.as_str().unwrap().to_owned()).collect()
            });
            let path = path.replace("{id}", "00000000-0000-7000-8000-000000000000");
            operations.push((verb.to_uppercase(), path, scopes));
        }
    }
    operations
}

/// What each operation needs of a key, as was agreed on.
const NEEDS: [(&str, &str, &[&str]); 13] = [
    ("POST", "/v1/plans", &["plan"]),
    ("POST", "/v1/plans/verify", &["plan"]),
    ("POST", "/v1/survey", &["plan"]),
    ("POST", "/v1/knowledge", &["plan"]),
    ("POST", "/v1/jobs", &["jobs"]),
    ("GET", "/v1/jobs", &["read-only", "jobs"]),
    ("POST", "/v1/jobs/batch", &["jobs"]),
    ("GET", "/v1/jobs/{id}", &["read-only", "jobs"]),
    ("DELETE", "/v1/jobs/{id}", &["jobs"]),
    ("GET", "/v1/jobs/{id}/events", &["read-only", "jobs"]),
    ("POST", "/v1/jobs/{id}/cancel", &["jobs"]),
    ("GET", "/version", &[]),
    ("GET", "/metrics", &["metrics"]),
];

#[test]
fn the_document_says_what_was_agreed_on() {
    let mut agreed = NEEDS.map(|(verb, path, scopes)| {
        let path = path.replace("{id}", "00000000-0000-7000-8000-000000000000");
        (verb.to_owned(), path, scopes.iter().map(|scope| (*scope).to_owned()).collect::<Vec<_>>())
    });
    agreed.sort();
    let mut said: Vec<_> =
        operations().into_iter().filter_map(|(verb, path, needs)| Some((verb, path, needs?))).collect();
    said.sort();
    assert_eq!(said, agreed);
}

#[tokio::test]
async fn without_a_key_no_operation_is_reached_but_the_open_ones() {
    let guarded = Guarded::start("without", &[&key("a", "plan", OFTEN)]).await;
    let mut open = Vec::new();
    for (verb, path, scopes) in operations() {
        let reply = guarded.ask(&verb, &path, &[], None).await;
        if scopes.is_none() {
            assert_eq!(reply.status, 200, "{verb} {path}");
            open.push(path);
            continue;
        }
        reply.is_problem(401, "unauthorized");
        assert_eq!(reply.header("www-authenticate"), "Bearer realm=\"singulate\"");
    }
    assert_eq!(open, ["/livez", "/readyz", "/openapi.json"]);
    assert_eq!(guarded.host.get("/docs/").await.status, 200);
    assert_eq!(guarded.ask("HEAD", "/version", &[], None).await.status, 401);
    guarded.ask("GET", "/v1/plans", &[], None).await.is_problem(405, "method_not_allowed");
}

#[tokio::test]
async fn each_scope_opens_what_the_document_says_and_nothing_else() {
    let scopes = ["plan", "jobs", "read-only", "metrics"];
    let keys = scopes.map(|scope| key(scope, scope, OFTEN));
    let guarded = Guarded::start("scopes", &keys.each_ref()).await;
    for (verb, path, needed) in operations() {
        let Some(needed) = needed else { continue };
        for (scope, key) in scopes.iter().zip(&keys) {
            let reply = guarded.call(key, &verb, &path, None).await;
            if needed.is_empty() || needed.iter().any(|word| word == scope) {
                assert!(![401, 403, 429].contains(&reply.status), "{scope} {verb} {path} {reply:?}");
                continue;
            }
            reply.is_problem(403, "forbidden");
            let challenge = reply.header("www-authenticate").to_owned();
            assert!(
                challenge.ends_with(&format!("error=\"insufficient_scope\", scope=\"{}\"", needed[0])),
                "{challenge}"
            );
        }
    }
    let metrics = guarded.get(&keys[3], "/metrics").await.text;
    assert!(!metrics.contains("singulate_requests_refused_total{reason=\"forbidden\"} 0"), "{metrics}");
}

#[tokio::test]
async fn every_wrong_key_gets_the_same_refusal() {
    let right = key("a", "plan", OFTEN);
    let guarded = Guarded::start("wrong", &[&right]).await;
    let bearer = |text: &str| format!("Bearer {text}");
    let (whole, other) = (bearer(right.text()), bearer(key("a", "plan", OFTEN).text()));
    for scheme in ["bearer ", "BEARER  "] {
        let value = format!("{scheme}{}", right.text());
        assert_eq!(guarded.ask("GET", "/version", &[value.as_bytes()], None).await.status, 200, "{scheme}");
    }
    let once: [&[u8]; 7] = [
        other.as_bytes(),
        &[b"Bearer", whole[6..].to_lowercase().as_bytes()].concat(),
        &whole.as_bytes()[..whole.len() - 1],
        &[b"Bearer ", "k".repeat(300).as_bytes()].concat(),
        b"Bearer",
        b"Bearer \xff\xfe",
        &[whole.as_bytes(), b", ", whole.as_bytes()].concat(),
    ];
    let twice: &[&[u8]] = &[whole.as_bytes(), whole.as_bytes()];
    for values in once.iter().map(core::slice::from_ref).chain([twice]) {
        let reply = guarded.ask("GET", "/version", values, None).await;
        reply.is_problem(401, "unauthorized");
        assert_eq!(
            reply.header("www-authenticate"),
            "Bearer realm=\"singulate\", error=\"invalid_token\"",
            "{values:?}"
        );
        assert!(!reply.text.contains(right.text()));
    }
    for value in [format!("Basic {}", right.text()), right.text().to_owned(), String::new()] {
        let reply = guarded.ask("GET", "/version", &[value.as_bytes()], None).await;
        reply.is_problem(401, "unauthorized");
        assert_eq!(reply.header("www-authenticate"), "Bearer realm=\"singulate\"", "{value}");
    }
}

#[tokio::test]
async fn a_refused_caller_learns_it_before_and_after_a_large_body() {
    let guarded = Guarded::start("unread", &[&key("a", "plan", OFTEN)]).await;
    // Nothing of the body has come.
    let head = "POST /v1/plans HTTP/1.1\r\nhost: x\r\nconnection: close\r\ncontent-type: application/json";
    let said = guarded.host.ask(&format!("{head}\r\nexpect: 100-continue\r\ncontent-length: 9\r\n\r\n")).await;
    assert!(said.starts_with("HTTP/1.1 401 "), "{said}");
    // A client that reads its answer only once it has sent everything.
    let body = "x".repeat(20_000_000);
    let whole = format!("{head}\r\ncontent-length: {}\r\n\r\n{body}", body.len());
    let address = guarded.host.address;
    let sent = spawn_blocking(move || {
        let mut stream = TcpStream::connect(address).unwrap();
        stream.write_all(whole.as_bytes()).unwrap();
        stream
    });
    let said = read_to_end(timeout(PATIENCE, sent).await.unwrap().unwrap()).await;
    assert!(said.starts_with("HTTP/1.1 401 "), "{said}");
}

#[tokio::test]
async fn anothers_job_is_no_job() {
    let [own, same, other] = [("a", "jobs"), ("a", "read-only"), ("b", "jobs")].map(|(n, s)| key(n, s, OFTEN));
    let guarded = Guarded::start("owners", &[&own, &same, &other]).await;
    let job = guarded.submit(&own).await;
    for (verb, path) in [
        ("GET", job.clone()),
        ("GET", format!("{job}?wait_ms=60000")),
        ("GET", format!("{job}/events")),
        ("POST", format!("{job}/cancel")),
        ("DELETE", job.clone()),
    ] {
        guarded.call(&other, verb, &path, None).await.is_problem(404, "not_found");
    }
    let count = async |key: &FreshKey| guarded.get(key, "/v1/jobs").await.json()["jobs"].as_array().unwrap().len();
    assert_eq!((count(&own).await, count(&same).await, count(&other).await), (1, 1, 0));
    let ended = guarded.get(&same, &format!("{job}?wait_ms=60000")).await;
    assert_eq!(ended.json()["state"], "succeeded");
    guarded.call(&same, "DELETE", &job, None).await.is_problem(403, "forbidden");
    assert!(guarded.get(&same, &format!("{job}/events")).await.text.contains("event: finished"));
    assert_eq!(guarded.call(&own, "DELETE", &job, None).await.status, 204);
}

#[tokio::test]
async fn an_idempotency_key_is_its_owners() {
    let [own, same, other] = ["a", "a", "b"].map(|name| key(name, "jobs", OFTEN));
    let guarded = Guarded::start("idempotency", &[&own, &same, &other]).await;
    let submit = async |key: &FreshKey, body: Value| {
        let request = guarded.host.client.post(guarded.host.url("/v1/jobs")).bearer_auth(key.text());
        let request = request.header("content-type", "application/json").header("idempotency-key", "once");
        Reply::of(request.body(body.to_string()).send().await.unwrap()).await
    };
    let first = submit(&own, scene(1000)).await.json()["id"].clone();
    assert_eq!(submit(&same, scene(1000)).await.json()["id"], first);
    submit(&same, scene(2000)).await.is_problem(422, "key_reused");
    let others = submit(&other, scene(2000)).await;
    assert!(others.status == 202 && others.json()["id"] != first, "{others:?}");
}

#[tokio::test]
async fn a_caller_who_asks_too_often_is_told_when_to_come_again() {
    let [slow, quick] = [key("slow", "plan", "0.5"), key("quick", "plan", OFTEN)];
    let guarded = Guarded::start("rate", &[&slow, &quick]).await;
    // Where two requests are further apart than the rate asks for, the next two may not be.
    let refused = async {
        loop {
            let reply = guarded.get(&slow, "/version").await;
            if reply.status != 200 {
                return reply;
            }
        }
    };
    let refused = timeout(PATIENCE, refused).await.expect("one is too many");
    refused.is_problem(429, "rate_exceeded");
    let after: u64 = refused.header("retry-after").parse().unwrap();
    assert!((1..=2).contains(&after), "{after}");
    assert_eq!(guarded.get(&quick, "/version").await.status, 200);
    sleep(Duration::from_secs(after)).await;
    assert_eq!(guarded.get(&slow, "/version").await.status, 200);
}

#[tokio::test]
async fn a_replaced_file_admits_new_keys_and_refuses_removed_ones() {
    let [stays, goes, comes] = ["a", "b", "c"].map(|name| key(name, "plan", OFTEN));
    let guarded = Guarded::start("replaced", &[&stays, &goes]).await;
    let until = async |key: &FreshKey, status: u16| {
        let seen = async {
            while guarded.get(key, "/version").await.status != status {
                sleep(Duration::from_millis(20)).await
            }
        };
        timeout(PATIENCE, seen).await.expect("the file is read again");
    };
    until(&goes, 200).await;
    let sound = [stays.entry(), comes.entry()].concat();
    std::fs::write(&guarded.file, &sound).unwrap();
    until(&comes, 200).await;
    until(&goes, 401).await;
    std::fs::write(&guarded.file, goes.entry()).unwrap();
    until(&goes, 200).await;
    until(&stays, 401).await;
}

#[tokio::test]
async fn a_key_that_is_gone_ends_its_streams_and_waits() {
    let [stays, goes] = ["a", "a"].map(|name| key(name, "jobs", OFTEN));
    let guarded = Guarded::with("gone", &[&stays, &goes], endless()).await;
    let job = guarded.submit(&goes).await;
    let events = guarded.host.client.get(guarded.host.url(&format!("{job}/events"))).bearer_auth(goes.text());
    let events = events.send().await.unwrap();
    assert_eq!(events.status(), 200);
    let wait = format!("{job}?wait_ms=60000");
    let over = async {
        tokio::join!(guarded.get(&goes, &wait), events.text(), async {
            std::fs::write(&guarded.file, stays.entry()).unwrap();
        })
    };
    // The wait alone would take as long.
    let (waited, streamed, ()) = timeout(PATIENCE / 2, over).await.expect("they end");
    assert!([200, 401].contains(&waited.status), "{waited:?}");
    assert!(!streamed.unwrap().contains("event: finished"));
    let state = guarded.get(&stays, &job).await.json()["state"].clone();
    assert!(state == "queued" || state == "running", "{state}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_caller_who_guesses_keys_gets_nowhere_and_holds_up_nobody() {
    let good = key("good", "plan", OFTEN);
    let guarded = Guarded::start("guesses", &[&good]).await;
    let guesses = async {
        for number in 0..1000 {
            // Nearly right, and wrong all the same.
            let guess = format!("Bearer {}{number}", &good.text()[..40]);
            let reply = guarded.ask("POST", "/v1/plans", &[guess.as_bytes()], Some(&scene(1000))).await;
            reply.is_problem(401, "unauthorized");
        }
    };
    let plans = async {
        for _ in 0..50 {
            assert_eq!(guarded.call(&good, "POST", "/v1/plans", Some(&scene(1000))).await.status, 200);
        }
    };
    tokio::join!(guesses, plans);
    assert_eq!(guarded.call(&good, "POST", "/v1/plans", Some(&scene(1000))).await.status, 200);
}
