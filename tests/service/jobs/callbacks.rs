//! Callers who are told.

use std::io::{Read, Write};
use std::net::TcpListener;

use hmac::{Hmac, KeyInit, Mac};
use serde_json::{Value, json};
use sha2::Sha256;
use singulate::api::{Engine, ServerSettings};
use singulate::jobs::JobSettings;

use super::{crowded, ended, path, submit};
use crate::host::Host;

const SECRET: &str = "a secret of some length";

async fn host(allow: &str) -> Host {
    let (callback_allow, callback_secret) = (allow.parse().unwrap(), Some(SECRET.parse().unwrap()));
    let jobs = JobSettings { callback_allow, callback_secret, ..JobSettings::default() };
    Host::with(ServerSettings { jobs, ..ServerSettings::default() }, Engine::default()).await
}

fn with_callback(url: &str) -> Value {
    let mut body = crowded();
    body["callback_url"] = json!(url);
    body
}

/// The head and the body of the first request that comes.
fn receive(listener: &TcpListener) -> (String, String) {
    let (mut stream, _) = listener.accept().unwrap();
    let mut text = String::new();
    let mut piece = [0; 4096];
    loop {
        let count = stream.read(&mut piece).unwrap();
        text.push_str(core::str::from_utf8(&piece[..count]).unwrap());
        if let Some((head, body)) = text.split_once("\r\n\r\n") {
            let length = head.lines().find_map(|line| line.strip_prefix("content-length: ")).unwrap();
            if body.len() == length.parse::<usize>().unwrap() {
                stream.write_all(b"HTTP/1.1 204 No Content\r\n\r\n").unwrap();
                return (head.to_owned(), body.to_owned());
            }
        }
    }
}

#[tokio::test]
async fn the_end_of_a_job_is_called_back_with_a_valid_signature() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let url = format!("http://{}/told?by=us", listener.local_addr().unwrap());
    let host = host("127.0.0.1").await;
    let job = submit(&host, &with_callback(&url)).await;
    let (head, body) = tokio::task::spawn_blocking(move || receive(&listener)).await.unwrap();
    assert!(head.starts_with("POST /told?by=us HTTP/1.1\r\n") && head.contains("content-type: application/json"));
    let told: Value = serde_json::from_str(&body).unwrap();
    assert_eq!(told, ended(&host, &job).await);
    assert_eq!(told["result"]["verdict"], "relocate");
    let field = |name: &str| head.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(": ")).unwrap();
    let mut mac = Hmac::<Sha256>::new_from_slice(SECRET.as_bytes()).unwrap();
    mac.update(format!("{}.{body}", field("singulate-timestamp")).as_bytes());
    let signature: String = mac.finalize().into_bytes().iter().map(|byte| format!("{byte:02x}")).collect();
    assert_eq!(field("singulate-signature"), format!("sha256={signature}"));
}

#[tokio::test]
async fn a_job_with_a_forbidden_callback_is_refused() {
    let host = host("10.0.0.0/8,robots.example").await;
    for (url, code) in [
        ("http://127.0.0.1:1/", "callback_not_allowed"),
        ("http://robots.example.org/", "callback_not_allowed"),
        ("ftp://robots.example/", "bad_callback_url"),
        ("robots.example", "bad_callback_url"),
    ] {
        let reply = host.post("/v1/jobs", &with_callback(url)).await;
        reply.is_problem(422, "invalid_request");
        assert_eq!(
            (reply.pointers(), &reply.json()["errors"][0]["code"]),
            (vec!["/callback_url".to_owned()], &json!(code))
        );
    }
    let scenes = json!({"scenes": [with_callback("http://robots.example/"), with_callback("http://127.0.0.1/")]});
    let reply = host.post("/v1/jobs/batch", &scenes).await;
    reply.is_problem(422, "invalid_request");
    assert_eq!(reply.pointers(), ["/scenes/1/callback_url"]);
    // Callbacks are off unless somebody is listed.
    let host = Host::start().await;
    let reply = host.post("/v1/jobs", &with_callback("http://robots.example/")).await;
    assert_eq!(reply.pointers(), ["/callback_url"]);
    let job = submit(&host, &crowded()).await;
    assert_eq!(host.get(&path(&job)).await.status, 200);
}
