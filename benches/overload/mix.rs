//! What is asked: plans to be waited for, with little time, and jobs, both of scenes that take some milliseconds.

use std::time::Duration;

use serde_json::json;
use singulate::wire::SceneBody;
use singulate_planner::budget::Budget;
use singulate_planner::plan::{Settings, plan};
use singulate_planner::scene::Scene;
use singulate_planner::search::SILENT;
use singulate_planner::statement::Verdict;

use super::client::post;
use super::paper::paper_50;

/// How much time plans have, in turn.
const LIMITS_MS: [u64; 4] = [50, 100, 200, 500];
/// Jobs have no deadline of their caller's; this is only to end a bad one.
const JOB_LIMIT_MS: u64 = 500;
const SCENES: usize = 12;

/// A plan to be waited for.
pub(super) struct PlanOrder {
    pub(super) request: Vec<u8>,
    pub(super) time_limit: Duration,
}

/// Requests as they go over the wire, to be sent again and again.
pub(super) struct Mix {
    pub(super) plans: Vec<PlanOrder>,
    pub(super) jobs: Vec<Vec<u8>>,
}

impl Mix {
    pub(super) fn new() -> Self {
        let scenes: Vec<Scene> = scenes().collect();
        let plan = |(scene, limit): (&Scene, u64)| PlanOrder {
            request: post("/v1/plans", &body(scene, limit)),
            time_limit: Duration::from_millis(limit),
        };
        let plans = scenes.iter().flat_map(|scene| LIMITS_MS.map(|limit| (scene, limit)));
        let jobs = scenes.iter().map(|scene| post("/v1/jobs", &body(scene, JOB_LIMIT_MS)));
        Self { plans: plans.map(plan).collect(), jobs: jobs.collect() }
    }
}

/// The paper's scenes where something has to move, with its own way to find a place: an image, with some milliseconds of
/// arithmetic.
fn scenes() -> impl Iterator<Item = Scene> {
    let moves = |scene: &Scene| {
        let answer = plan(scene, &Settings::default(), &Budget::unlimited(), SILENT).expect("checked");
        answer.statement.verdict == Some(Verdict::Relocate)
    };
    (0..).map(paper_50).filter(moves).take(SCENES)
}

fn body(scene: &Scene, limit: u64) -> Vec<u8> {
    let mut body = serde_json::to_value(SceneBody::new(scene, None)).expect("JSON");
    body["settings"] = json!({"time_limit_ms": limit, "placement": "raster"});
    body.to_string().into_bytes()
}
