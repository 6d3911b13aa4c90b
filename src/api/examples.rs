//! The examples of the interface document. Answers are computed from the example requests, so that they match; only
//! statistics, times and job ids are made up.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::{Value, json};
use utoipa::openapi::path::Operation;
use utoipa::openapi::{OpenApi, RefOr, Schema};

use crate::computation::Engine;
use crate::wire::{
    AnswerBody, KnowledgeBody, RequestLimits, StatisticsBody, SurveyBody, VerificationBody, queued_job, read_scene,
    read_verify,
};
use singulate_planner::budget::Budget;
use singulate_planner::knowledge::known;
use singulate_planner::search::SILENT;

/// Give every body of the document its example; `SceneBody` has one already.
pub(super) fn add(document: &mut OpenApi) {
    let schemas = &mut document.components.get_or_insert_default().schemas;
    let scene = scene(schemas);
    let Answers { plan, survey, knowledge, verify, verification } = Answers::to(&scene);
    let queued = queued_job();
    let end = json!({"finished_at": ENDED, "expires_at": FORGOTTEN, "queue_position": null});
    let ended = with(&queued, end);
    let cancelled = with(&ended, json!({"state": "cancelled"}));
    let incumbent = json!({"cost": plan["cost"], "lower_bound": plan["lower_bound"]});
    let begun = json!({"state": "succeeded", "started_at": BEGUN, "attempts": 1, "incumbent": incumbent});
    let succeeded = with(&with(&ended, begun), json!({"result": plan}));
    let job = with(&scene, json!({"priority": 0}));
    for (name, example) in [
        ("AnswerBody", plan),
        ("SurveyBody", survey),
        ("KnowledgeBody", knowledge),
        ("VerifyBody", verify),
        ("VerificationBody", verification),
        ("BatchBody", json!({"scenes": [job]})),
        ("JobSceneBody", job),
        ("JobsBody", json!({"jobs": [queued]})),
        ("JobListBody", json!({"jobs": [with(&succeeded, json!({"result": null}))], "next_cursor": null})),
        ("JobBody", succeeded),
    ] {
        if let Some(RefOr::T(Schema::Object(object))) = schemas.get_mut(name) {
            object.example = Some(example);
        }
    }
    // These answer with a job without a result.
    for (path, job) in [("/v1/jobs", queued), ("/v1/jobs/{id}/cancel", cancelled)] {
        let operation = document.paths.paths.get_mut(path).and_then(|item| item.post.as_mut());
        if let Some(content) = operation.and_then(accepted) {
            *content = Some(job);
        }
    }
}

/// When the example job began, ended, and expires.
const BEGUN: &str = "2026-01-05T09:30:00.004Z";
const ENDED: &str = "2026-01-05T09:30:00.012Z";
const FORGOTTEN: &str = "2026-01-05T10:30:00.012Z";

/// The answers to one scene.
struct Answers {
    plan: Value,
    survey: Value,
    knowledge: Value,
    /// The scene with its plan.
    verify: Value,
    verification: Value,
}

impl Answers {
    fn to(scene: &Value) -> Self {
        let (engine, budget, limits) = (Engine::default(), Budget::unlimited(), RequestLimits::default());
        let request = read_scene(scene.to_string().as_bytes(), &limits).expect("the example is a scene");
        let judged = (engine.plan)(&request, &budget, SILENT);
        let judged = judged.expect("the example is planned");
        let statistics = StatisticsBody { knowledge_ms: 0.04, search_ms: 0.01, placement_ms: 0.2, check_ms: 0.02 };
        let plan = value(&AnswerBody { statistics, ..AnswerBody::new(&request, &judged) });
        let survey = (engine.survey)(&request.scene, &budget).expect("the example is surveyed");
        let known = known(&request.scene, request.methods.grasp_model.model(), &budget).expect("the example is small");
        let verify = json!({"scene": scene, "plan": plan});
        let stated = read_verify(verify.to_string().as_bytes(), &limits).expect("what was answered can be stated");
        let report = (engine.check)(&stated.request.scene, &stated.statement, &stated.terms, &budget);
        Self {
            plan,
            survey: value(&SurveyBody::new(&request.scene, &survey)),
            knowledge: value(&KnowledgeBody::new(&request.scene, &known, &[])),
            verify,
            verification: value(&VerificationBody::new(&report)),
        }
    }
}

fn value(body: &impl Serialize) -> Value {
    serde_json::to_value(body).expect("a body is JSON")
}

/// The scene of all examples.
fn scene(schemas: &BTreeMap<String, RefOr<Schema>>) -> Value {
    let Some(RefOr::T(Schema::Object(scene))) = schemas.get("SceneBody") else { return Value::Null };
    scene.example.clone().unwrap_or_default()
}

/// The same object with these fields.
fn with(object: &Value, fields: Value) -> Value {
    let mut object = object.clone();
    if let (Value::Object(object), Value::Object(fields)) = (&mut object, fields) {
        object.extend(fields);
    }
    object
}

/// The example of an operation's 202 answer.
fn accepted(operation: &mut Operation) -> Option<&mut Option<Value>> {
    let RefOr::T(response) = operation.responses.responses.get_mut("202")? else { return None };
    let RefOr::T(content) = response.content.get_mut("application/json")? else { return None };
    Some(&mut content.example)
}
