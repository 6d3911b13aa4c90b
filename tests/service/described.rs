//! What is served is what the interface document describes, read as generators of clients read it.

use serde_json::{Map, Value, json};
use singulate::api::ServerSettings;
use singulate::jobs::JobSettings;

use crate::document::COMMITTED;
use crate::host::{Host, endless, scene};
use crate::jobs::events::messages;
use crate::jobs::{path, submit};
use crate::schema::faults;

fn document() -> Value {
    serde_json::from_str(COMMITTED).unwrap()
}

/// Of a response with a body in JSON, or a request: the example that its own stands for, else that of its schema.
fn example<'a>(document: &'a Value, described: &'a Value) -> Option<&'a Value> {
    let content = described["content"].get("application/json")?;
    let schema = content["schema"]["$ref"].as_str()?.strip_prefix('#')?;
    content.get("example").or_else(|| document.pointer(schema)?.get("example"))
}

/// The examples that have names, where there are several.
fn named(described: &Value) -> Vec<(&str, &Value)> {
    let examples = described["content"]["application/json"]["examples"].as_object().into_iter().flatten();
    examples.map(|(name, example)| (name.as_str(), &example["value"])).collect()
}

/// Without what differs from run to run.
fn steady(answer: &Value) -> Value {
    const DIFFERS: [&str; 4] = ["statistics", "id", "created_at", "expires_at"];
    match answer {
        Value::Object(answer) => {
            let job = answer.contains_key("scene_sha256");
            let kept = answer.iter().filter(|(name, _)| !DIFFERS.contains(&name.as_str()) || (*name == "id" && !job));
            kept.map(|(name, field)| (name.clone(), steady(field))).collect::<Map<_, _>>().into()
        }
        Value::Array(items) => items.iter().map(steady).collect(),
        other => other.clone(),
    }
}

#[tokio::test]
async fn each_example_answer_of_the_document_belongs_to_its_example_request() {
    let document = document();
    let mut asked = Vec::new();
    for (path, item) in document["paths"].as_object().unwrap() {
        let Some(request) = example(&document, &item["post"]["requestBody"]) else { continue };
        let host = Host::start().await;
        let reply = host.post(path, request).await;
        let wanted = example(&document, &item["post"]["responses"][reply.status.to_string()]);
        let wanted = wanted.unwrap_or_else(|| panic!("{path} has no example of {reply:?}"));
        assert_eq!(steady(&reply.json()), steady(wanted), "{path}");
        assert!(path != "/v1/plans" || wanted["verdict"] == "relocate", "an example worth a look: {wanted}");
        asked.push(path.as_str());
    }
    let all = ["/v1/plans", "/v1/plans/verify", "/v1/survey", "/v1/knowledge", "/v1/jobs", "/v1/jobs/batch"];
    assert_eq!(asked, all);
}

#[tokio::test]
async fn each_named_answer_belongs_to_the_request_of_its_name() {
    let (host, document) = (Host::start().await, document());
    let plan = &document["paths"]["/v1/plans"]["post"];
    let (requests, answers) = (named(&plan["requestBody"]), named(&plan["responses"]["200"]));
    let names: Vec<_> = requests.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["one_object", "table_setting", "whole_table"]);
    assert_eq!(requests.len(), answers.len());
    for ((asked, request), (told, answer)) in requests.into_iter().zip(answers) {
        assert_eq!(asked, told);
        let schemas = [("SceneBody", request), ("AnswerBody", answer)];
        for (name, example) in schemas {
            assert_eq!(faults(&document, &document["components"]["schemas"][name], example, name), [""; 0]);
        }
        assert_eq!(steady(&host.post("/v1/plans", request).await.json()), steady(answer), "{asked}");
    }
    let answers = named(&plan["responses"]["200"]);
    let (cleared, set) = (answers[2].1, answers[1].1);
    assert!(cleared["left"] == json!(["plate-1"]) && cleared["proven"] == true, "an example worth a look: {cleared}");
    let moved = [&set["relocations"][0]["object"], &set["relocations"][1]["object"], &set["relocations"][1]["turn"]];
    assert!(moved == [&json!("glass"), &json!("knife"), &json!(0.0)] && set["optimal"] == true, "worth a look: {set}");
}

#[test]
fn every_example_of_the_document_is_such_as_its_schema_says() {
    let document = document();
    for (name, schema) in document["components"]["schemas"].as_object().unwrap() {
        if let Some(example) = schema.get("example") {
            assert_eq!(faults(&document, schema, example, name), [""; 0]);
        }
        for (field, property) in schema["properties"].as_object().into_iter().flatten() {
            if let Some(example) = property.get("example") {
                assert_eq!(faults(&document, property, example, &format!("{name}.{field}")), [""; 0]);
            }
        }
    }
}

#[tokio::test]
async fn a_served_answer_is_a_plan_to_verify_by_the_schemas() {
    let (host, document) = (Host::start().await, document());
    let request = &document["components"]["schemas"]["VerifyBody"];
    let mut overlapping = scene(1000);
    overlapping["objects"][1]["x"] = json!(0.31 + 0.1245);
    overlapping["objects"][1]["y"] = json!(0.22);
    let stuck = include_str!("../../client-examples/scenes/deadlock.json");
    let full = include_str!("../../client-examples/scenes/no-space.json");
    let moved = include_str!("../../client-examples/scenes/one-move.json");
    let others = [stuck, full, moved].map(|text| serde_json::from_str::<Value>(text).unwrap());
    for scene in [vec![overlapping], others.to_vec()].concat() {
        let answer = host.post("/v1/plans", &scene).await.json();
        assert!(!answer["warnings"].as_array().unwrap().is_empty() || scene["objects"].as_array().unwrap().len() > 2);
        let stated = json!({"scene": scene, "plan": answer});
        assert_eq!(faults(&document, request, &stated, ""), [""; 0]);
        assert_eq!(host.post("/v1/plans/verify", &stated).await.json()["valid"], true, "{stated}");
    }
}

#[tokio::test]
async fn the_data_of_each_event_is_what_its_schema_says() {
    let document = document();
    let response = &document["paths"]["/v1/jobs/{id}/events"]["get"]["responses"]["200"];
    let schema = &response["content"]["text/event-stream"]["schema"];
    let jobs = JobSettings { threads: 1, ..JobSettings::default() };
    let host = Host::with(ServerSettings { jobs, ..ServerSettings::default() }, endless()).await;
    let (ended, waiting) = (submit(&host, &scene(60_000)).await, submit(&host, &scene(60_000)).await);
    host.post(&format!("{}/cancel", path(&ended)), &Value::Null).await;
    let all = host.get(&format!("{}/events", path(&ended))).await.text;
    let stream = host.client.get(host.url(&format!("{}/events", path(&waiting)))).send().await.unwrap();
    host.ask_to_stop();
    let told = [messages(&all), messages(&stream.text().await.unwrap())].concat();
    for (_, name, data) in &told {
        assert_eq!(faults(&document, schema, data, name), [""; 0]);
    }
    let names: Vec<&str> = told.iter().map(|(_, name, _)| name.as_str()).collect();
    assert!(names.contains(&"queued") && names.contains(&"finished") && names.ends_with(&["draining"]), "{names:?}");
    host.stopped().await;
}
