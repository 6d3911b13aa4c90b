//! Which representation comes back, and the small routes.

use crate::host::{Host, scene};

async fn accepting(host: &Host, path: &str, accept: &str) -> crate::host::Reply {
    let headers = [("content-type", "application/json"), ("accept", accept)];
    host.post_with(path, &headers, scene(1000).to_string()).await
}

#[tokio::test]
async fn an_answer_is_json_unless_the_client_likes_a_drawing_better() {
    let host = Host::start().await;
    for accept in ["*/*", "application/json", "text/html, */*;q=0.8", "image/svg+xml;q=0.1, application/json"] {
        let reply = accepting(&host, "/v1/plans", accept).await;
        assert_eq!((reply.status, reply.header("content-type")), (200, "application/json"), "{accept}");
        let body = reply.json();
        assert!(body["verdict"].is_string());
        assert_eq!((&body["scene_id"], &body["target"]), (&"cell-4/17".into(), &"plate-1".into()));
    }
    for accept in ["image/svg+xml", "image/*", "image/svg+xml, */*"] {
        let reply = accepting(&host, "/v1/plans", accept).await;
        assert_eq!((reply.status, reply.header("content-type")), (200, "image/svg+xml"), "{accept}");
        assert!(reply.text.contains("<svg"));
    }
}

#[tokio::test]
async fn an_accept_without_any_available_format_is_a_406() {
    let host = Host::start().await;
    accepting(&host, "/v1/plans", "text/html").await.is_problem(406, "not_acceptable");
    accepting(&host, "/v1/survey", "image/svg+xml").await.is_problem(406, "not_acceptable");
    accepting(&host, "/v1/plans/verify", "image/svg+xml").await.is_problem(406, "not_acceptable");
}

#[tokio::test]
async fn probes_and_version_answer() {
    let host = Host::start().await;
    for path in ["/livez", "/readyz"] {
        let reply = host.get(path).await;
        assert_eq!((reply.status, reply.text.as_str()), (200, r#"{"status":"ok"}"#));
        let head = host.client.head(host.url(path)).send().await.unwrap();
        assert_eq!(head.status(), 200);
    }
    let version = host.get("/version").await.json();
    assert_eq!(version, serde_json::json!({"name": "singulate", "version": env!("CARGO_PKG_VERSION")}));
}

#[tokio::test]
async fn every_response_has_a_request_id() {
    let host = Host::start().await;
    let (first, second) = (host.get("/livez").await, host.get("/nowhere").await);
    assert_ne!(first.header("x-request-id"), "");
    assert_ne!(first.header("x-request-id"), second.header("x-request-id"));
    let request = host.client.get(host.url("/livez")).header("x-request-id", "robot-7");
    assert_eq!(request.send().await.unwrap().headers()["x-request-id"], "robot-7");
}
