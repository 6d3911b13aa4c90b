//! What browsers are told: header fields of every answer, and which pages may call.

use serde_json::json;
use singulate::api::{Engine, ServerSettings};
use singulate::keys::{FreshKey, append};

use crate::host::{Host, Reply, scene};

const DATA_POLICY: &str = "default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

#[track_caller]
fn guarded_by(reply: &Reply, policy: &str) {
    for (name, value) in [
        ("x-content-type-options", "nosniff"),
        ("x-frame-options", "DENY"),
        ("referrer-policy", "no-referrer"),
        ("content-security-policy", policy),
    ] {
        assert_eq!(reply.header(name), value, "{name} {reply:?}");
    }
}

#[tokio::test]
async fn every_answer_says_what_it_may_do_in_a_browser() {
    let host = Host::start().await;
    let svg = [("content-type", "application/json"), ("accept", "image/svg+xml")];
    let drawing = host.post_with("/v1/plans", &svg, scene(1000).to_string()).await;
    assert_eq!(drawing.header("content-type"), "image/svg+xml");
    assert!(!drawing.text.contains("style") && !drawing.text.contains("<script"), "{}", drawing.text);
    let job = host.post("/v1/jobs", &scene(1000)).await;
    let events = host.get(&format!("{}/events", job.header("location"))).await;
    assert_eq!(events.header("content-type"), "text/event-stream");
    for reply in [
        drawing,
        host.post("/v1/plans", &json!({})).await,
        job,
        events,
        host.get("/metrics").await,
        host.get("/version").await,
    ] {
        guarded_by(&reply, DATA_POLICY);
        assert_eq!(reply.header("cache-control"), "no-store", "{reply:?}");
    }
    for path in ["/livez", "/openapi.json", "/nowhere", "/v1"] {
        let reply = host.get(path).await;
        guarded_by(&reply, DATA_POLICY);
        assert_eq!(reply.header("cache-control"), "", "{path}");
    }
    let refused = host.ask("no http\r\n\r\n").await;
    for line in
        ["x-content-type-options: nosniff", "x-frame-options: DENY", &format!("content-security-policy: {DATA_POLICY}")]
    {
        assert!(refused.contains(&format!("\r\n{line}\r\n")), "{line}: {refused}");
    }
}

#[tokio::test]
async fn the_page_may_load_its_own_files_and_needs_no_more() {
    let host = Host::start().await;
    let page = host.get("/docs/").await;
    let policy = page.header("content-security-policy").to_owned();
    guarded_by(&page, &policy);
    assert!(policy.contains("default-src 'none'; script-src 'self'; ") && !policy.contains("eval"), "{policy}");
    // Every script is a file, and no element listens to events by itself.
    for script in page.text.split("<script").skip(1) {
        let (tag, rest) = script.split_once('>').unwrap();
        assert!(tag.contains(" src=\"./") && rest.trim_start().starts_with("</script>"), "{script}");
    }
    assert!(!page.text.contains(" onload=") && !page.text.contains("<style"), "{}", page.text);
    guarded_by(&host.get("/docs/swagger-ui.css").await, &policy);
}

#[tokio::test]
async fn only_pages_of_listed_origins_may_call_and_they_ask_without_a_key() {
    let key = FreshKey::new("page", "plan".parse().unwrap(), "1000".parse().unwrap()).unwrap();
    let file = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("cors-{}.toml", std::process::id()));
    append(&key, &file).unwrap();
    let cors_origins = "https://cell.example.com,http://localhost:3000".parse().unwrap();
    let settings = ServerSettings { cors_origins, api_keys_file: Some(file.clone()), ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    let ask = async |verb: &str, origin: &str, extra: &[(&str, &str)]| {
        let mut request = host.client.request(verb.parse().unwrap(), host.url("/v1/plans")).header("origin", origin);
        for (name, value) in extra {
            request = request.header(*name, *value);
        }
        Reply::of(request.body(scene(1000).to_string()).send().await.unwrap()).await
    };
    let beforehand =
        [("access-control-request-method", "POST"), ("access-control-request-headers", "authorization,content-type")];
    let allowed = ask("OPTIONS", "https://cell.example.com", &beforehand).await;
    assert_eq!((allowed.status, allowed.header("access-control-allow-origin")), (200, "https://cell.example.com"));
    assert!(allowed.header("access-control-allow-headers").contains("authorization"));
    assert!(allowed.header("access-control-allow-methods").contains("POST"));
    assert_eq!(allowed.header("access-control-allow-credentials"), "");
    let bearer = format!("Bearer {}", key.text());
    let called = [("content-type", "application/json"), ("authorization", bearer.as_str())];
    let reply = ask("POST", "http://localhost:3000", &called).await;
    assert_eq!((reply.status, reply.header("access-control-allow-origin")), (200, "http://localhost:3000"));
    assert_eq!(reply.header("access-control-expose-headers"), "location,retry-after,x-request-id");
    // A page learns why it was refused, too.
    let reply = ask("POST", "http://localhost:3000", &[]).await;
    assert_eq!((reply.status, reply.header("access-control-allow-origin")), (401, "http://localhost:3000"));
    for other in ["https://cell.example.com.evil.example", "http://localhost:3001", "null", "https://cell.example.com/"]
    {
        for (verb, extra) in [("OPTIONS", &beforehand), ("POST", &called)] {
            assert_eq!(ask(verb, other, extra).await.header("access-control-allow-origin"), "", "{verb} {other}");
        }
    }
    std::fs::remove_file(file).unwrap();
}

#[tokio::test]
async fn no_page_may_call_where_nobody_listed_any() {
    let host = Host::start().await;
    let headers = [("origin", "https://cell.example.com"), ("content-type", "application/json")];
    let reply = host.post_with("/v1/plans", &headers, scene(1000).to_string()).await;
    assert_eq!((reply.status, reply.header("access-control-allow-origin")), (200, ""));
    let request = host.client.request("OPTIONS".parse().unwrap(), host.url("/v1/plans"));
    Reply::of(request.send().await.unwrap()).await.is_problem(405, "method_not_allowed");
}
