//! What is measured, as Prometheus reads it.

use core::time::Duration;
use std::collections::{BTreeMap, BTreeSet};

use serde_json::json;
use singulate::api::{Engine, ServerSettings};
use singulate::jobs::JobSettings;
use singulate::metrics::{CallbackOutcome, Ended, Metrics, Queue, Refusal, StoreOutcome};
use singulate_planner::plan::{Answer, Statistics};
use singulate_planner::statement::Statement;
use tokio::time::timeout;

use crate::host::{Host, PATIENCE, raw_post, scene};

/// A family: its kind and its series, each with its value.
#[derive(Debug, Default)]
struct Family {
    kind: String,
    series: BTreeMap<String, f64>,
}

/// Read an exposition as strictly as its specification asks.
fn parse(text: &str) -> BTreeMap<String, Family> {
    let body = text.strip_suffix("# EOF\n").expect("an end");
    let mut families: BTreeMap<String, Family> = BTreeMap::new();
    let mut current = String::new();
    let mut helped = BTreeSet::new();
    for line in body.lines() {
        if let Some(rest) = line.strip_prefix("# ") {
            let [word, name, value] = rest.splitn(3, ' ').collect::<Vec<_>>().try_into().unwrap();
            assert!(name.starts_with("singulate_") && !value.is_empty(), "{line}");
            match word {
                "HELP" => assert!(helped.insert(name.to_owned()), "{line} comes twice"),
                "TYPE" => {
                    let family = Family { kind: value.to_owned(), ..Family::default() };
                    assert!(helped.contains(name) && families.insert(name.to_owned(), family).is_none(), "{line}");
                    current = name.to_owned();
                }
                "UNIT" => assert!(current == name && name.ends_with(&format!("_{value}")), "{line}"),
                _ => panic!("{line}"),
            }
            continue;
        }
        let (series, value) = line.rsplit_once(' ').unwrap();
        let (name, labels) =
            series.split_once('{').map_or((series, ""), |(name, rest)| (name, rest.strip_suffix('}').unwrap()));
        let family = families.get_mut(&current).expect("a family that was named");
        let suffix = name.strip_prefix(current.as_str()).unwrap();
        let allowed: &[&str] = match family.kind.as_str() {
            "counter" => &["_total"],
            "gauge" => &[""],
            "histogram" => &["_bucket", "_sum", "_count"],
            other => panic!("{other}"),
        };
        assert!(allowed.contains(&suffix), "{line}");
        for label in labels.split(',').filter(|label| !label.is_empty()) {
            let (key, word) = label.split_once("=\"").unwrap();
            assert!(key.bytes().all(|byte| byte == b'_' || byte.is_ascii_lowercase()) && word.ends_with('"'), "{line}");
        }
        assert!(family.series.insert(format!("{suffix}{{{labels}}}"), value.parse().unwrap()).is_none(), "{line}");
    }
    families
}

/// How often something was timed, over all series whose labels hold all of these.
fn count(families: &BTreeMap<String, Family>, family: &str, labels: &[&str]) -> f64 {
    let series = families.get(family).into_iter().flat_map(|family| &family.series);
    let wanted = |key: &str| {
        !key.starts_with("_bucket") && !key.starts_with("_sum") && labels.iter().all(|label| key.contains(label))
    };
    series.filter(|(key, _)| wanted(key)).map(|(_, value)| value).sum()
}

/// Everything that can be recorded, once.
fn everything() -> Metrics {
    let (metrics, moment) = (Metrics::default(), Duration::from_millis(2));
    metrics.request("/v1/jobs/{id}", "GET", Some(200), moment);
    metrics.request("/v1/plans", "BREW", None, moment);
    Refusal::ALL.iter().for_each(|refusal| metrics.refused(*refusal));
    Ended::ALL.iter().for_each(|ended| metrics.job_ended(*ended));
    CallbackOutcome::ALL.iter().for_each(|outcome| metrics.callback(*outcome));
    StoreOutcome::ALL.iter().for_each(|outcome| metrics.store("claim", *outcome, moment));
    for queue in Queue::ALL {
        metrics.waited(*queue, moment);
        metrics.set_busy(*queue, 2);
    }
    let statistics = Statistics { search: moment, check: moment, ..Statistics::default() };
    metrics.planned(&Answer { statement: Statement::timed_out(), statistics });
    metrics.set_jobs(3, 1);
    metrics.attempt(1);
    metrics.attempt(2);
    metrics
}

#[test]
fn every_family_is_described_and_counts_what_is_recorded() {
    let metrics = everything();
    let open = (metrics.connection(), metrics.stream(), metrics.stream());
    let families = parse(&metrics.text());
    let page = include_str!("../../docs/operating.md");
    for (name, Family { kind, .. }) in &families {
        let shown = if kind == "counter" { format!("{name}_total") } else { name.clone() };
        assert!(page.contains(&format!("| `{shown}` | {kind} |")), "{shown} is not in docs/operating.md");
    }
    assert_eq!(families.len(), 13);
    let one = |family: &str, label: &str| count(&families, &format!("singulate_{family}"), &[label]);
    for (family, label, expected) in [
        ("http_request_seconds", "status=\"hung_up\"", 1.0),
        ("http_request_seconds", "route=\"/v1/jobs/{id}\"", 1.0),
        ("http_request_seconds", "method=\"other\"", 1.0),
        ("requests_refused", "reason=", 8.0),
        ("queue_wait_seconds", "kind=", 2.0),
        ("planning_phase_seconds", "phase=", 4.0),
        ("planning_seconds", "verdict=\"timed_out\"", 1.0),
        ("jobs", "state=\"queued\"", 3.0),
        ("jobs_ended", "state=\"expired\"", 1.0),
        ("job_attempts", "", 2.0),
        ("store_seconds", "outcome=\"failed\"", 1.0),
        ("callbacks", "outcome=", 4.0),
        ("connections_open", "", 1.0),
        ("streams_open", "", 2.0),
        ("threads_busy", "kind=\"job\"", 2.0),
    ] {
        assert_eq!(one(family, label).to_bits(), f64::to_bits(expected), "{family} {label}");
    }
    let whole = families["singulate_planning_seconds"].series["_sum{verdict=\"timed_out\"}"];
    assert!((whole - 0.004).abs() < 1e-9, "{whole}");
    drop(open);
    let after = parse(&metrics.text());
    assert!(count(&after, "singulate_connections_open", &[]) + count(&after, "singulate_streams_open", &[]) < 0.5);
}

#[test]
fn buckets_grow_and_end_with_everything() {
    for (name, Family { kind, series }) in parse(&everything().text()) {
        for (key, total) in series.iter().filter(|(key, _)| kind == "histogram" && key.starts_with("_count")) {
            let labels = key.trim_start_matches("_count{").trim_end_matches('}');
            let mut buckets: Vec<(f64, f64)> = Vec::new();
            for (bucket, count) in
                series.iter().filter(|(bucket, _)| bucket.starts_with("_bucket") && bucket.contains(labels))
            {
                let (_, bound) = bucket.split_once("le=\"").unwrap();
                let bound = bound.split('"').next().unwrap().replace("+Inf", "inf");
                buckets.push((bound.parse().unwrap(), *count));
            }
            buckets.sort_by(|a, b| a.0.total_cmp(&b.0));
            assert!(
                buckets.windows(2).all(|pair| pair[0].0 < pair[1].0 && pair[0].1 <= pair[1].1),
                "{name}: {buckets:?}"
            );
            assert_eq!(buckets.last().unwrap().1.to_bits(), total.to_bits(), "{name}");
        }
    }
}

#[tokio::test]
async fn a_server_measures_its_own_requests_and_no_other_servers() {
    let (host, other) = (Host::start().await, Host::start().await);
    for limit in [10_000, 20_000] {
        assert_eq!(host.post("/v1/plans", &scene(limit)).await.status, 200);
    }
    // A thread is done a little after its answer has left.
    let busy = async || count(&parse(&host.get("/metrics").await.text), "singulate_threads_busy", &["kind=\"plan\""]);
    while busy().await > 0.5 {
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
    let reply = host.get("/metrics").await;
    assert_eq!((reply.status, reply.header("content-type")), (200, singulate::metrics::MEDIA_TYPE));
    let families = parse(&reply.text);
    for (family, labels, expected) in [
        ("http_request_seconds", &["route=\"/v1/plans\"", "method=\"POST\"", "status=\"200\""][..], 2.0),
        ("queue_wait_seconds", &["kind=\"plan\""], 2.0),
        ("planning_seconds", &["verdict=\"graspable\""], 2.0),
        ("planning_phase_seconds", &["phase=\"check\""], 2.0),
        ("requests_refused", &[], 0.0),
    ] {
        assert_eq!(
            count(&families, &format!("singulate_{family}"), labels).to_bits(),
            f64::to_bits(expected),
            "{family}"
        );
    }
    assert!(count(&families, "singulate_connections_open", &[]) > 0.5);
    let families = parse(&other.get("/metrics").await.text);
    assert!(count(&families, "singulate_planning_seconds", &[]) < 0.5);
}

#[tokio::test]
async fn no_label_holds_text_that_a_client_chooses() {
    let host = Host::start().await;
    for name in ["one", "two", "three"] {
        assert_eq!(host.get(&format!("/docs/{name}")).await.status, 404);
        assert_eq!(host.get(&format!("/{name}")).await.status, 404);
        let mut named = scene(10_000);
        named["scene_id"] = json!(name);
        host.post_with("/v1/plans", &[("content-type", "application/json"), ("x-request-id", name)], named.to_string())
            .await;
        let method = reqwest::Method::from_bytes(name.to_uppercase().as_bytes()).unwrap();
        host.client.request(method, host.url("/version")).send().await.unwrap();
    }
    let text = host.get("/metrics").await.text;
    let families = parse(&text);
    for name in ["one", "two", "three", "ONE", "plate-1", "anonymous"] {
        assert!(!text.contains(&format!("\"{name}\"")) && !text.contains(&format!("/{name}")), "{name} in {text}");
    }
    let requests = &families["singulate_http_request_seconds"].series;
    let series: Vec<&String> = requests.keys().filter(|key| key.starts_with("_count")).collect();
    assert_eq!(series.len(), 4, "{series:?}");
    assert!(
        requests.iter().all(|(key, value)| !key.starts_with("_count") || (value - 3.0).abs() < 0.5),
        "{requests:?}"
    );
}

/// Ask until it is so.
async fn until(host: &Host, condition: impl Fn(&BTreeMap<String, Family>) -> bool) {
    let asking = async { while !condition(&parse(&host.get("/metrics").await.text)) {} };
    timeout(PATIENCE, asking).await.expect("it happens in time");
}

#[tokio::test]
async fn refused_requests_and_hang_ups_are_counted() {
    let settings = ServerSettings { threads: 1, queue: 0, ..ServerSettings::default() };
    let engine = Engine {
        survey: |_, budget| {
            while budget.check().is_ok() {
                std::thread::sleep(Duration::from_millis(1));
            }
            Ok(Vec::new())
        },
        ..Engine::default()
    };
    let host = Host::with(settings, engine).await;
    let held = host.raw(&raw_post("/v1/survey", &scene(60_000)));
    until(&host, |families| count(families, "singulate_threads_busy", &["kind=\"plan\""]) > 0.5).await;
    assert_eq!(host.post("/v1/plans", &scene(10_000)).await.status, 503);
    until(&host, |families| count(families, "singulate_requests_refused", &["reason=\"full\""]) > 0.5).await;
    drop(held);
    let gone = ["route=\"/v1/survey\"", "status=\"hung_up\""];
    until(&host, |families| count(families, "singulate_http_request_seconds", &gone) > 0.5).await;
}

#[tokio::test]
async fn a_job_that_is_not_accepted_is_counted() {
    let jobs = JobSettings { max_queued: 0, ..JobSettings::default() };
    let host = Host::with(ServerSettings { jobs, ..ServerSettings::default() }, Engine::default()).await;
    host.post("/v1/jobs", &scene(10_000)).await.is_problem(503, "overloaded");
    until(&host, |families| count(families, "singulate_requests_refused", &["reason=\"full\""]) > 0.5).await;
}
