//! What the log says of a job.

use core::time::Duration;
use std::sync::Arc;
use std::time::Instant;

use singulate::api::Engine;
use singulate::jobs::{JobId, JobSettings, JobState, NewJob, Owner, Runner, Store, Timestamp, open};
use singulate::wire::{PlanRequest, RequestLimits};
use singulate::workers::Draining;
use singulate_planner::budget::Budget;
use singulate_planner::paper::Judged;
use singulate_planner::plan::{Answer, PlanError, Statistics};
use singulate_planner::search::Progress;
use singulate_planner::statement::Statement;
use tokio::time::sleep;
use tokio_util::sync::CancellationToken;

use crate::{Pages, field};

/// Long enough for any machine.
const PATIENCE: Duration = Duration::from_secs(60);

const SCENE: &str = r#"{"scene_id": "cell-4/17", "table": {"x_min": 0, "y_min": 0, "x_max": 1, "y_max": 1},
    "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
    "objects": [{"id": "a", "x": 0.5, "y": 0.5, "radius": 0.1}], "target": "a"}"#;

fn owner() -> Owner {
    Owner::named("cell-4")
}

struct Jobs {
    store: Arc<dyn Store>,
    settings: JobSettings,
    pages: Pages,
}

impl Jobs {
    async fn start() -> Self {
        let pages = Pages::open();
        let url = "sqlite::memory:".to_owned();
        let settings = JobSettings { url, threads: 1, lease: Duration::from_secs(60), ..JobSettings::default() };
        Self { store: open(&settings, Arc::default()).await.unwrap(), settings, pages }
    }

    async fn submit(&self, body: &str) -> JobId {
        self.submit_at(body, Timestamp::now()).await
    }

    async fn submit_at(&self, body: &str, now: Timestamp) -> JobId {
        let id = JobId::new();
        let job = NewJob {
            id,
            owner: owner(),
            key: None,
            request_sha256: String::new(),
            scene_id: None,
            scene_sha256: String::new(),
            body: body.as_bytes().to_vec(),
            priority: 0,
            callback_url: None,
        };
        self.store.submit(&[job], now).await.unwrap();
        id
    }

    /// Work on jobs until this one is in this state; what still runs then is handed back.
    async fn work_until(&self, engine: Engine, id: JobId, state: JobState) {
        let (store, limits) = (Arc::clone(&self.store), RequestLimits::default());
        let runner = Arc::new(Runner::new(store, Arc::default(), &self.settings, engine, limits).unwrap());
        let (draining, over) = (Draining::default(), CancellationToken::new());
        let running = tokio::spawn(runner.run(draining.clone(), over.clone()));
        let started = Instant::now();
        while self.store.get(&owner(), id).await.unwrap().unwrap().state != state {
            assert!(started.elapsed() < PATIENCE, "it never is {state:?}");
            sleep(Duration::from_millis(1)).await;
        }
        draining.begin();
        over.cancel();
        running.await.unwrap();
    }

    /// The lines about this job since the last time.
    fn lines(&self, id: JobId) -> Vec<String> {
        let text = self.pages.take();
        text.lines().filter(|line| field(line, "job") == Some(&id.to_string())).map(str::to_owned).collect()
    }
}

/// Assert that the line says this, with these fields.
#[track_caller]
fn says(line: &str, what: &str, fields: &[(&str, Option<&str>)]) {
    assert!(line.contains(what), "no '{what}' in {line}");
    for (name, value) in fields {
        assert_eq!(field(line, name), *value, "{name} in {line}");
    }
}

const OURS: [(&str, Option<&str>); 2] = [("owner", Some("cell-4")), ("scene_id", Some("cell-4/17"))];

#[tokio::test]
async fn a_jobs_start_and_its_end_leave_a_line_each() {
    let jobs = Jobs::start().await;
    let id = jobs.submit(SCENE).await;
    jobs.work_until(Engine::default(), id, JobState::Succeeded).await;
    let lines = jobs.lines(id);
    let [start, end] = &lines[..] else { panic!("{lines:?}") };
    says(start, "INFO singulate::jobs", &OURS);
    says(start, "job started", &[("attempt", Some("1"))]);
    says(end, "job ended", &OURS);
    says(end, "INFO", &[("state", Some("succeeded")), ("verdict", Some("graspable")), ("problem", None)]);
    for (line, time) in [(start, "age_ms"), (end, "ms")] {
        let ms = field(line, time).unwrap();
        assert!(ms.parse::<f64>().is_ok() && ms.split_once('.').is_none_or(|(_, rest)| rest.len() <= 2), "{line}");
    }
}

#[tokio::test]
async fn a_job_that_fails_says_why_in_its_line() {
    let jobs = Jobs::start().await;
    // As if another version had accepted it.
    let id = jobs.submit(&SCENE.replace("0.1}", "-1}")).await;
    jobs.work_until(Engine::default(), id, JobState::Failed).await;
    let lines = jobs.lines(id);
    let problem = Some("urn:singulate:problem:invalid_request");
    let fields = [("state", Some("failed")), ("verdict", None), ("problem", problem), ("code", Some("out_of_range"))];
    says(lines.last().unwrap(), "job ended", &fields);
}

/// A planner that goes on until its budget ends.
fn endless() -> Engine {
    fn plan(_: &PlanRequest, budget: &Budget<'_>, _: Progress<'_>) -> Result<Judged, PlanError> {
        while budget.check().is_ok() {
            std::thread::sleep(Duration::from_millis(1));
        }
        Ok(Answer { statement: Statement::timed_out(), statistics: Statistics::default() }.into())
    }
    Engine { plan, ..Engine::default() }
}

#[tokio::test]
async fn a_job_that_a_server_hands_back_is_resumed_by_the_next() {
    let jobs = Jobs::start().await;
    let id = jobs.submit(&SCENE.replacen('{', r#"{"settings": {"time_limit_ms": 60000}, "#, 1)).await;
    jobs.work_until(endless(), id, JobState::Running).await;
    let lines = jobs.lines(id);
    let [start, back] = &lines[..] else { panic!("{lines:?}") };
    says(start, "job started", &OURS);
    says(back, "job handed back", &[]);
    jobs.work_until(Engine::default(), id, JobState::Succeeded).await;
    let lines = jobs.lines(id);
    says(&lines[0], "job resumed", &OURS);
    says(&lines[1], "job ended", &[("state", Some("succeeded"))]);
}

#[tokio::test]
async fn a_job_whose_worker_is_lost_says_so_and_is_resumed() {
    let jobs = Jobs::start().await;
    let id = jobs.submit(SCENE).await;
    // By a worker whose lease ended long ago.
    let long_ago = Timestamp::from_millis(0);
    assert_eq!(jobs.store.claim(&long_ago.into()).await.unwrap().unwrap().claim.id, id);
    jobs.work_until(Engine::default(), id, JobState::Succeeded).await;
    let lines = jobs.lines(id);
    let [lost, start, end] = &lines[..] else { panic!("{lines:?}") };
    says(lost, "WARN", &[]);
    says(lost, "job lost its worker", &[]);
    says(start, "job resumed", &[("attempt", Some("2"))]);
    says(end, "job ended", &OURS);
}

#[tokio::test]
async fn a_job_that_ends_without_a_worker_has_a_line_too() {
    let jobs = Jobs::start().await;
    let id = jobs.submit_at(SCENE, Timestamp::from_millis(0)).await;
    jobs.work_until(Engine::default(), id, JobState::Expired).await;
    let lines = jobs.lines(id);
    let [end] = &lines[..] else { panic!("{lines:?}") };
    says(end, "job ended", &[("state", Some("expired"))]);
}
