//! Lists, and requests that make no sense.

use serde_json::Value;

use super::{crowded, ended, path, submit};
use crate::host::Host;

#[tokio::test]
async fn a_list_comes_in_pages_the_latest_first() {
    let host = Host::start().await;
    let mut ids = Vec::new();
    for _ in 0..5 {
        let job = submit(&host, &crowded()).await;
        ended(&host, &job).await;
        ids.insert(0, job["id"].clone());
    }
    let mut listed = Vec::new();
    let mut query = "limit=2".to_owned();
    loop {
        let page = host.get(&format!("/v1/jobs?{query}")).await.json();
        let jobs = page["jobs"].as_array().unwrap();
        assert!(jobs.len() <= 2 && jobs.iter().all(|job| job["result"].is_null() && job["state"] == "succeeded"));
        listed.extend(jobs.iter().map(|job| job["id"].clone()));
        let Some(cursor) = page["next_cursor"].as_str() else { break };
        query = format!("limit=2&cursor={cursor}");
    }
    assert_eq!(listed, ids);
    let count =
        async |state: &str| host.get(&format!("/v1/jobs?state={state}")).await.json()["jobs"].as_array().unwrap().len();
    assert_eq!((count("succeeded").await, count("failed").await), (5, 0));
}

#[tokio::test]
async fn parameters_that_make_no_sense_are_named() {
    let host = Host::start().await;
    let job = submit(&host, &crowded()).await;
    let job = path(&job);
    for (query, part) in [
        ("/v1/jobs?limit=0", "'limit'"),
        ("/v1/jobs?limit=101", "from 1 to 100"),
        ("/v1/jobs?state=done", "queued, running"),
        ("/v1/jobs?cursor=5", "'cursor'"),
        ("/v1/jobs?order=up", "'order'"),
        ("/v1/jobs?limit=5&limit=6", "repeated"),
        (&format!("{job}?wait_ms=60001"), "'wait_ms'"),
        (&format!("{job}?wait_ms=-1"), "'wait_ms'"),
        (&format!("{job}?wait=5"), "'wait'"),
    ] {
        let reply = host.get(query).await;
        reply.is_problem(422, "invalid_request");
        assert!(reply.text.contains(part), "{query}: {reply:?}");
    }
}

#[tokio::test]
async fn a_job_that_is_not_there_is_a_404_whatever_is_asked_of_it() {
    let host = Host::start().await;
    for id in ["019a8b2c-7d1e-7f00-8000-3c5f2a1b4d6e", "5", "%00", "..%2f..%2fetc"] {
        let path = format!("/v1/jobs/{id}");
        let reply = host.get(&path).await;
        reply.is_problem(404, "not_found");
        assert_eq!(reply.json()["title"], "There is no such job");
        host.get(&format!("{path}?wait_ms=50")).await.is_problem(404, "not_found");
        host.get(&format!("{path}/events")).await.is_problem(404, "not_found");
        host.post(&format!("{path}/cancel"), &Value::Null).await.is_problem(404, "not_found");
        assert_eq!(host.client.delete(host.url(&path)).send().await.unwrap().status(), 404);
    }
    assert_eq!(host.get("/v1/job").await.json()["title"], "Nothing lives at this path");
    let reply = host.client.put(host.url("/v1/jobs")).body("{}").send();
    assert_eq!(reply.await.unwrap().status(), 405);
}
