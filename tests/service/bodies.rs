//! What is refused, and with which words.

use core::time::Duration;

use serde_json::{Value, json};
use singulate::api::{Engine, ServerSettings};

use crate::host::{Host, PATIENCE, read_to_end, scene};

#[tokio::test]
async fn every_fault_of_a_scene_is_told_at_once() {
    let host = Host::start().await;
    let mut body = scene(1000);
    body["objects"][0]["radius"] = json!(-1);
    body["gripper"]["fingers"] = json!("three");
    body["colour"] = json!("red");
    for path in ["/v1/plans", "/v1/survey", "/v1/knowledge"] {
        let reply = host.post(path, &body).await;
        reply.is_problem(422, "invalid_request");
        assert_eq!(reply.pointers(), ["/colour", "/gripper/fingers", "/objects/0/radius"]);
    }
    let reply = host.post("/v1/plans/verify", &json!({"scene": body, "plan": {"action": "push"}})).await;
    reply.is_problem(422, "invalid_request");
    assert_eq!(
        reply.pointers(),
        [
            "/scene/colour",
            "/scene/gripper/fingers",
            "/scene/objects/0/radius",
            "/plan/action",
            "/plan/relocations",
            "/plan/target_grasp"
        ]
    );
}

#[tokio::test]
async fn a_number_beyond_every_double_is_out_of_range() {
    let host = Host::start().await;
    let body = scene(1000).to_string().replacen("0.075", "1e999", 1);
    let reply = host.post_with("/v1/plans", &[("content-type", "application/json")], body).await;
    reply.is_problem(422, "invalid_request");
    assert_eq!(reply.json()["errors"][0]["code"], "out_of_range");
    assert_eq!(reply.pointers(), ["/objects/0/radius"]);
}

#[tokio::test]
async fn malformed_json_is_a_400_with_its_place() {
    let host = Host::start().await;
    let reply = host.post_with("/v1/plans", &[("content-type", "application/json")], "{\n\"a\": }".to_owned()).await;
    reply.is_problem(400, "malformed_json");
    assert!(reply.json()["detail"].as_str().unwrap().contains("line 2 column 6"), "{reply:?}");
}

#[tokio::test]
async fn a_large_body_is_read_all_the_same() {
    let host = Host::start().await;
    let mut body = scene(1000);
    let objects: Vec<Value> =
        (0..2000).map(|n| json!({"id": format!("o{n}"), "x": 0.1, "y": 0.1, "radius": 0})).collect();
    body["objects"] = json!(objects);
    body["target"] = json!("o7");
    let reply = host.post("/v1/plans", &body).await;
    reply.is_problem(422, "invalid_request");
    assert_eq!(reply.pointers().len(), 1000);
}

#[tokio::test]
async fn other_content_types_are_a_415() {
    let host = Host::start().await;
    let body = scene(1000).to_string();
    for headers in [
        &[][..],
        &[("content-type", "text/plain")],
        &[("content-type", "application/json; charset=latin1")],
        &[("content-type", "application/json"), ("content-encoding", "gzip")],
    ] {
        host.post_with("/v1/plans", headers, body.clone()).await.is_problem(415, "unsupported_media_type");
    }
    for content_type in ["application/json; charset=UTF-8", "application/scene+json"] {
        let reply = host.post_with("/v1/plans", &[("content-type", content_type)], body.clone()).await;
        assert_eq!(reply.status, 200, "{content_type}");
    }
}

#[tokio::test]
async fn a_body_above_the_limit_is_a_413() {
    let settings = ServerSettings { max_body_bytes: 1000, ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    let body = " ".repeat(1001);
    host.post_with("/v1/plans", &[("content-type", "application/json")], body).await.is_problem(413, "body_too_large");
    let body = format!("{:1000}", scene(1000));
    let reply = host.post_with("/v1/plans", &[("content-type", "application/json")], body).await;
    assert_eq!(reply.status, 200);
}

#[tokio::test]
async fn a_body_above_the_limit_is_a_413_in_chunks_too() {
    let settings = ServerSettings { max_body_bytes: 1000, ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    let head = "POST /v1/plans HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\ntransfer-encoding: chunked";
    let chunk = format!("1f4\r\n{}\r\n", " ".repeat(500));
    let stream = host.raw(&format!("{head}\r\n\r\n{chunk}{chunk}{chunk}0\r\n\r\n"));
    let text = read_to_end(stream).await;
    assert!(text.starts_with("HTTP/1.1 413 ") && text.contains("application/problem+json"), "{text}");
}

#[tokio::test]
async fn a_body_far_above_the_limit_is_a_413_all_the_same() {
    let host = Host::start().await;
    // The client writes everything before it reads.
    let body = " ".repeat(30_000_000);
    host.post_with("/v1/plans", &[("content-type", "application/json")], body).await.is_problem(413, "body_too_large");
}

#[tokio::test]
async fn a_body_above_the_limit_that_never_ends_is_a_413_in_the_end() {
    let body_timeout = Duration::from_millis(50);
    let settings = ServerSettings { max_body_bytes: 1000, body_timeout, ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    let head = "POST /v1/plans HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\ncontent-length: 9999";
    let text = read_to_end(host.raw(&format!("{head}\r\n\r\n{}", " ".repeat(2000)))).await;
    assert!(text.starts_with("HTTP/1.1 413 "), "{text}");
}

#[tokio::test]
async fn a_client_that_asks_before_it_sends_learns_what_is_wrong_at_once() {
    let host = Host::start().await;
    let head = "POST /v1/plans HTTP/1.1\r\nhost: x\r\nexpect: 100-continue\r\nconnection: close\r\n";
    for (fields, status) in [
        ("content-type: application/json\r\ncontent-length: 4000001", "413"),
        ("content-type: text/plain\r\ncontent-length: 10", "415"),
    ] {
        let text = read_to_end(host.raw(&format!("{head}{fields}\r\n\r\n"))).await;
        assert!(text.starts_with(&format!("HTTP/1.1 {status} ")), "{text}");
    }
    let body = scene(1000).to_string();
    let fields = format!("content-type: application/json\r\ncontent-length: {}", body.len());
    let text = read_to_end(host.raw(&format!("{head}{fields}\r\n\r\n{body}"))).await;
    assert!(text.starts_with("HTTP/1.1 100 ") && text.contains("HTTP/1.1 200 OK"), "{text}");
}

#[tokio::test]
async fn an_empty_body_and_a_byte_order_mark_are_named() {
    let host = Host::start().await;
    for (body, word) in [("", "empty"), (" \n", "empty"), ("\u{feff}{}", "byte order mark")] {
        let reply = host.post_with("/v1/plans", &[("content-type", "application/json")], body.to_owned()).await;
        reply.is_problem(400, "malformed_json");
        assert!(reply.json()["detail"].as_str().unwrap().contains(word), "{reply:?}");
    }
}

#[tokio::test]
async fn an_unknown_path_is_a_404() {
    let host = Host::start().await;
    for path in ["/v1", "/v1/plans/", "/v2/plans", "/docs/nothing.js", "/docs/%ff", "/livez/x"] {
        host.get(path).await.is_problem(404, "not_found");
    }
    host.post("/v1/nothing", &json!({})).await.is_problem(404, "not_found");
}

#[tokio::test]
async fn another_method_is_a_405_that_says_which_are_allowed() {
    let host = Host::start().await;
    for path in ["/v1/plans", "/v1/plans/verify", "/v1/survey", "/v1/knowledge"] {
        let reply = host.get(path).await;
        reply.is_problem(405, "method_not_allowed");
        assert_eq!(reply.header("allow"), "POST");
    }
    for path in ["/livez", "/readyz", "/version", "/openapi.json", "/", "/docs", "/docs/"] {
        let reply = host.post(path, &json!({})).await;
        reply.is_problem(405, "method_not_allowed");
        assert_eq!(reply.header("allow"), "GET,HEAD");
    }
}

// The client writes megabytes without waiting for anything: on another thread than the server.
#[tokio::test(flavor = "multi_thread")]
async fn there_is_room_for_so_many_large_bodies_and_always_for_small_ones() {
    let settings = ServerSettings { body_timeout: PATIENCE, ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    let length = 4_000_000;
    let head = format!(
        "POST /v1/plans HTTP/1.1\r\nhost: x\r\nconnection: close\r\ncontent-type: application/json\r\ncontent-length: {length}\r\n\r\n"
    );
    let begun = format!("{head}{}", " ".repeat(length - 1));
    let mut holders: Vec<_> = (0..16).map(|_| host.raw(&begun)).collect();
    let large = || async { host.ask(&format!("{begun}x")).await };
    let started = std::time::Instant::now();
    loop {
        let answer = large().await;
        if answer.starts_with("HTTP/1.1 503 ") {
            assert!(answer.contains("retry-after: 1") && answer.contains("overloaded"), "{answer}");
            break;
        }
        assert!(answer.starts_with("HTTP/1.1 400 ") && started.elapsed() < PATIENCE, "{answer}");
        // This one was quicker than a holder, which was refused for it.
        holders.push(host.raw(&begun));
    }
    assert_eq!(host.post("/v1/plans", &scene(10_000)).await.status, 200);
    drop(holders);
    while !large().await.starts_with("HTTP/1.1 400 ") {
        assert!(started.elapsed() < PATIENCE);
    }
}
