//! The examples of the interface document. Answers are computed from the example requests, so that they match; only
//! statistics, times and job ids are made up.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::{Value, json};
use utoipa::openapi::example::ExampleBuilder;
use utoipa::openapi::path::Operation;
use utoipa::openapi::{Content, OpenApi, RefOr, Schema};

use crate::computation::Engine;
use crate::wire::{
    AnswerBody, KnowledgeBody, PlanRequest, RequestLimits, StatisticsBody, SurveyBody, VerificationBody, queued_job,
    read_scene, read_verify,
};
use singulate_planner::budget::Budget;
use singulate_planner::knowledge::known;
use singulate_planner::search::SILENT;

/// Give every body of the document its example; `SceneBody` has one already.
pub(super) fn add(document: &mut OpenApi) {
    let schemas = &mut document.components.get_or_insert_default().schemas;
    let scene = scene(schemas);
    let clearing = clearing(&scene);
    let setting = setting();
    let plans = [
        ("one_object", "Free one object", &scene),
        ("whole_table", "Clear the table", &clearing),
        ("table_setting", "Free a tray among cutlery and glasses", &setting),
    ]
    .map(|(name, summary, scene)| (name, summary, scene.clone(), planned(scene)));
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
    if let Some(plan) = document.paths.paths.get_mut("/v1/plans").and_then(|item| item.post.as_mut()) {
        for (name, summary, scene, answer) in plans {
            add_named(requested(plan), (name, summary), scene);
            add_named(answered(plan, "200"), (name, summary), answer);
        }
    }
    // These answer with a job without a result.
    for (path, job) in [("/v1/jobs", queued), ("/v1/jobs/{id}/cancel", cancelled)] {
        let operation = document.paths.paths.get_mut(path).and_then(|item| item.post.as_mut());
        if let Some(content) = operation.and_then(|operation| answered(operation, "202")) {
            content.example = Some(job);
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
        let request = requested_plan(scene);
        let plan = planned(scene);
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

fn requested_plan(scene: &Value) -> PlanRequest {
    read_scene(scene.to_string().as_bytes(), &RequestLimits::default()).expect("the example is a scene")
}

/// The answer to a planning request.
fn planned(scene: &Value) -> Value {
    let request = requested_plan(scene);
    let judged = (Engine::default().plan)(&request, &Budget::unlimited(), SILENT).expect("the example is planned");
    let statistics = StatisticsBody { knowledge_ms: 0.04, search_ms: 0.01, placement_ms: 0.2, check_ms: 0.02 };
    value(&AnswerBody { statistics, ..AnswerBody::new(&request, &judged) })
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

/// The same scene, to be cleared: the cup goes to its own place, and there is no room for all plates.
fn clearing(scene: &Value) -> Value {
    let plates = json!({"id": "tray", "capacity": 2, "accepts": ["plate-1", "plate-2", "plate-3"]});
    let mut clearing =
        with(scene, json!({"goal": {"clear": true}, "drop_offs": [plates, {"id": "sink", "accepts": ["cup"]}]}));
    if let Value::Object(fields) = &mut clearing {
        fields.remove("target");
    }
    clearing
}

/// Two jaws at a tray: a knife stands in their way, and a glass in the way of the palm over the knife.
fn setting() -> Value {
    json!({
        "scene_id": "table-7",
        "table": {"x_min": 0, "y_min": 0, "x_max": 0.9, "y_max": 0.6},
        "gripper": {"fingers": 2, "finger_width": 0.02, "clearance": 0.02, "max_opening": 0.14, "finger_length": 0.12,
            "palm_radius": 0.05, "tip_height": 0.004},
        "objects": [
            {"id": "tray", "x": 0.3, "y": 0.2, "height": 0.03,
                "shape": {"kind": "rectangle", "length": 0.3, "width": 0.12, "corner_radius": 0.02}},
            {"id": "knife", "x": 0.3, "y": 0.37, "yaw": 1.57, "height": 0.01,
                "shape": {"kind": "capsule", "length": 0.2, "radius": 0.01}, "grasps": [{"yaw": 1.57, "tolerance": 0.05}]},
            {"id": "glass", "x": 0.37, "y": 0.37, "radius": 0.033, "height": 0.14},
            {"id": "plate", "x": 0.68, "y": 0.3, "radius": 0.065, "height": 0.02}
        ],
        "target": "tray"
    })
}

/// The JSON that an operation takes.
fn requested(operation: &mut Operation) -> Option<&mut Content> {
    let RefOr::T(body) = operation.request_body.as_mut()? else { return None };
    let RefOr::T(content) = body.content.get_mut("application/json")? else { return None };
    Some(content)
}

/// The JSON that an operation answers with this status.
fn answered<'a>(operation: &'a mut Operation, status: &str) -> Option<&'a mut Content> {
    let RefOr::T(response) = operation.responses.responses.get_mut(status)? else { return None };
    let RefOr::T(content) = response.content.get_mut("application/json")? else { return None };
    Some(content)
}

/// Gives a body one of several examples.
fn add_named(content: Option<&mut Content>, (name, summary): (&str, &str), value: Value) {
    if let Some(content) = content {
        let example = ExampleBuilder::new().summary(summary).value(Some(value)).build();
        content.examples.insert(name.to_owned(), example.into());
    }
}
