//! The interface document and its page.

use serde_json::{Value, json};
use singulate::api::{ServerSettings, openapi_json};
use singulate::wire::{MAX_SCENE_ID_LENGTH, RequestLimits};
use singulate_planner::scene::{
    CAPACITY_RANGE, COORDINATE_RANGE, DEFAULT_TOLERANCE, FINGERS_RANGE, GRASP_OFFSET_RANGE, LENGTH_RANGE, MARGIN_RANGE,
    MAX_DROP_OFFS, MAX_FINDINGS, MAX_GRASPS, MAX_ID_LENGTH, MAX_POINTS, POINT_RANGE, SceneLimits, TIP_HEIGHT_RANGE,
    YAW_RANGE, YAW_TOLERANCE_RANGE,
};

use crate::host::Host;

pub(crate) const COMMITTED: &str = include_str!("../../openapi/openapi.json");

fn schemas() -> Value {
    let document: Value = serde_json::from_str(COMMITTED).unwrap();
    document["components"]["schemas"].clone()
}

#[test]
fn the_committed_document_is_the_generated_one() {
    assert!(COMMITTED == openapi_json(), "rewrite it: cargo run -- openapi > openapi/openapi.json");
}

#[tokio::test]
async fn the_served_document_is_the_committed_one() {
    let reply = Host::start().await.get("/openapi.json").await;
    assert_eq!((reply.status, reply.header("content-type")), (200, "application/json"));
    assert!(reply.text == COMMITTED);
}

#[test]
fn the_ranges_of_the_document_are_those_of_the_checks() {
    let schemas = schemas();
    let ranges = [
        ("TableBody", &["x_min", "y_min", "x_max", "y_max"][..], COORDINATE_RANGE),
        ("RectangleBody", &["x_min", "y_min", "x_max", "y_max"], COORDINATE_RANGE),
        ("ObjectBody", &["x", "y"], COORDINATE_RANGE),
        ("StatedPose", &["x", "y"], COORDINATE_RANGE),
        ("StatedGrasp", &["x", "y"], COORDINATE_RANGE),
        ("ObjectBody", &["yaw"], YAW_RANGE),
        ("ObjectBody", &["radius", "height"], LENGTH_RANGE),
        ("DiscShape", &["radius"], LENGTH_RANGE),
        ("CapsuleShape", &["radius"], LENGTH_RANGE),
        ("CapsuleShape", &["length"], (2.0 * LENGTH_RANGE.0, 2.0 * LENGTH_RANGE.1)),
        ("RectangleShape", &["length", "width"], LENGTH_RANGE),
        ("RectangleShape", &["corner_radius"], (0.0, LENGTH_RANGE.1 / 2.0)),
        ("PolygonShape", &["corner_radius"], (0.0, LENGTH_RANGE.1)),
        ("ShapePoint", &["x", "y"], POINT_RANGE),
        ("ListedGraspBody", &["x", "y"], GRASP_OFFSET_RANGE),
        ("ListedGraspBody", &["yaw"], YAW_RANGE),
        // π/k for two fingers.
        ("ListedGraspBody", &["tolerance"], (0.0, core::f64::consts::FRAC_PI_2)),
        ("GripperBody", &["finger_width", "clearance", "max_opening", "finger_length", "palm_radius"], LENGTH_RANGE),
        ("GripperBody", &["tip_height"], TIP_HEIGHT_RANGE),
        ("DropOffBody", &["capacity"], CAPACITY_RANGE),
        ("GripperBody", &["fingers"], FINGERS_RANGE),
        ("GripperBody", &["margin"], MARGIN_RANGE),
        ("GripperBody", &["yaw_tolerance"], YAW_TOLERANCE_RANGE),
        ("SettingsBody", &["overlap_tolerance"], (0.0, RequestLimits::default().max_overlap_tolerance)),
    ];
    for (schema, fields, (min, max)) in ranges {
        for field in fields {
            let property = &schemas[schema]["properties"][field];
            let stated = (property["minimum"].as_f64(), property["maximum"].as_f64());
            assert_eq!(stated, (Some(min), Some(max)), "{schema}.{field}");
        }
    }
}

#[test]
fn the_lengths_of_the_document_are_those_of_the_checks() {
    let schemas = schemas();
    let property = |schema: &str, field: &str, name: &str| schemas[schema]["properties"][field][name].as_u64().unwrap();
    let limits = RequestLimits::default();
    let expected = [
        ("ObjectBody", "id", "maxLength", MAX_ID_LENGTH),
        ("SceneBody", "target", "maxLength", MAX_ID_LENGTH),
        ("SceneBody", "scene_id", "maxLength", MAX_SCENE_ID_LENGTH),
        ("SceneBody", "objects", "maxItems", SceneLimits::default().max_objects),
        ("GoalBody", "any_of", "maxItems", SceneLimits::default().max_objects),
        ("GoalBody", "all_of", "maxItems", SceneLimits::default().max_objects),
        ("SceneBody", "drop_offs", "maxItems", MAX_DROP_OFFS),
        ("JobSceneBody", "drop_offs", "maxItems", MAX_DROP_OFFS),
        ("DropOffBody", "id", "maxLength", MAX_ID_LENGTH),
        ("ObjectBody", "grasps", "maxItems", MAX_GRASPS),
        ("PolygonShape", "points", "maxItems", MAX_POINTS),
        ("Problem", "errors", "maxItems", MAX_FINDINGS),
        ("SettingsBody", "time_limit_ms", "maximum", usize::try_from(limits.max_time_limit.as_millis()).unwrap()),
    ];
    for (schema, field, name, value) in expected {
        assert_eq!(property(schema, field, name), value as u64, "{schema}.{field}.{name}");
    }
    let default = &schemas["SettingsBody"]["properties"]["time_limit_ms"]["description"];
    assert!(default.as_str().unwrap().contains(&format!("Default: {}.", limits.default_time_limit.as_millis())));
    let default = &schemas["SettingsBody"]["properties"]["overlap_tolerance"]["description"];
    assert!(default.as_str().unwrap().contains(&format!("Default: {}.", limits.scene.overlap_tolerance)));
    let default = &schemas["ListedGraspBody"]["properties"]["tolerance"]["description"];
    assert!(default.as_str().unwrap().contains(&format!("Default: {DEFAULT_TOLERANCE}.")));
    let grouped = |number: usize| format!("{},{:03},{:03}", number / 1_000_000, number / 1000 % 1000, number % 1000);
    assert!(COMMITTED.contains(&grouped(ServerSettings::default().max_body_bytes)));
}

#[test]
fn every_schema_and_field_is_described_and_every_plain_field_has_an_example() {
    for (name, schema) in schemas().as_object().unwrap() {
        assert!(schema["description"].is_string(), "{name}");
        for (field, property) in schema["properties"].as_object().into_iter().flatten() {
            assert!(property["description"].is_string(), "{name}.{field}");
            let refers =
                property.to_string().contains("\"$ref\":\"#/components/schemas/") && property["items"].is_null();
            assert!(refers || !property["example"].is_null(), "{name}.{field}");
        }
    }
}

#[test]
fn bodies_of_requests_have_no_other_fields() {
    let schemas = schemas();
    let requests = [
        "SceneBody",
        "TableBody",
        "RectangleBody",
        "GripperBody",
        "ObjectBody",
        "DiscShape",
        "CapsuleShape",
        "RectangleShape",
        "PolygonShape",
        "ShapePoint",
        "ListedGraspBody",
        "GoalBody",
        "DropOffBody",
        "SettingsBody",
        "VerifyBody",
        "JobSceneBody",
        "BatchBody",
    ];
    let stated = ["PlanBody", "StatedPickPlace", "StatedPickDrop", "StatedPose", "StatedGrasp", "StatedDeadlock"];
    for name in requests.iter().chain(&stated) {
        assert_eq!(schemas[name]["additionalProperties"], json!(false), "{name}");
    }
    let choices = [
        ("StepBody", &["PickPlaceBody", "PickDropBody"][..]),
        ("StatedStep", &["StatedPickPlace", "StatedPickDrop"]),
        ("ShapeBody", &["DiscShape", "CapsuleShape", "RectangleShape", "PolygonShape"]),
    ];
    for (name, kinds) in choices {
        let choices = schemas[name]["oneOf"].as_array().unwrap().iter().map(|choice| choice["$ref"].clone());
        let expected: Vec<_> = kinds.iter().map(|kind| json!(format!("#/components/schemas/{kind}"))).collect();
        assert_eq!(choices.collect::<Vec<_>>(), expected, "it is one of these and nothing else");
    }
}

#[test]
fn every_operation_is_described() {
    let document: Value = serde_json::from_str(COMMITTED).unwrap();
    let operations =
        document["paths"].as_object().unwrap().values().flat_map(|path| path.as_object().unwrap().values());
    for operation in operations {
        for field in ["operationId", "summary", "description"] {
            assert!(operation[field].is_string(), "{operation}");
        }
        for parameter in operation["parameters"].as_array().into_iter().flatten() {
            assert!(!parameter["schema"].to_string().contains("null"), "it is absent, never null: {parameter}");
        }
        for (status, response) in operation["responses"].as_object().unwrap() {
            let content = response["content"].is_object();
            assert!(response["description"].is_string() && content == (status != "204"), "{operation}");
        }
    }
}

#[test]
fn plans_come_first_in_the_document() {
    let document: Value = serde_json::from_str(COMMITTED).unwrap();
    let operations = |item: &Value| item.as_object().unwrap().values().cloned().collect::<Vec<_>>();
    let paths = document["paths"].as_object().unwrap();
    let tags: Vec<_> = paths.values().flat_map(operations).map(|operation| operation["tags"][0].clone()).collect();
    let mut groups = tags.clone();
    groups.dedup();
    assert_eq!(groups, ["planning", "jobs", "operation"], "{tags:?}");
    assert_eq!(paths.keys().next().unwrap(), "/v1/plans");
}

/// hey-api makes a `bigint` of an `int64`, and sends that as a string.
#[test]
fn no_integer_of_the_document_is_an_int64() {
    fn integers<'a>(part: &'a Value, found: &mut Vec<&'a Value>) {
        let word = json!("integer");
        if part["type"] == word || part["type"].as_array().is_some_and(|types| types.contains(&word)) {
            found.push(part);
        }
        let fields = part.as_object().into_iter().flat_map(serde_json::Map::values);
        fields.chain(part.as_array().into_iter().flatten()).for_each(|part| integers(part, found));
    }
    let document: Value = serde_json::from_str(COMMITTED).unwrap();
    let mut found = Vec::new();
    integers(&document, &mut found);
    assert!(found.len() > 20);
    for integer in found {
        let small = integer["maximum"].as_i64().is_some_and(|maximum| maximum <= i64::from(i32::MAX));
        let format = integer["format"].as_str();
        assert!(format == Some("int32") || (format.is_none() && !small), "{integer}");
    }
}

#[test]
fn an_object_of_which_no_field_is_named_says_what_it_admits() {
    fn check(part: &Value) {
        assert!(
            part["type"] != "object" || part["properties"].is_object() || part["additionalProperties"] == true,
            "{part}"
        );
        part.as_object().into_iter().flat_map(serde_json::Map::values).for_each(check);
        part.as_array().into_iter().flatten().for_each(check);
    }
    check(&serde_json::from_str(COMMITTED).unwrap());
}

#[tokio::test]
async fn the_page_needs_no_internet() {
    let host = Host::start().await;
    let page = host.get("/docs").await;
    assert_eq!((page.status, page.header("content-type")), (200, "text/html"));
    assert_eq!(host.get("/docs/").await.text, page.text);
    assert_eq!(host.get("/").await.text, page.text);
    let pieces = page.text.split('"').filter(|piece| [".js", ".css", ".png"].iter().any(|end| piece.ends_with(end)));
    let files: Vec<&str> = pieces.map(|piece| piece.trim_start_matches("./")).collect();
    assert!(files.contains(&"swagger-initializer.js"), "{files:?}");
    for name in &files {
        assert_eq!(host.get(&format!("/docs/{name}")).await.status, 200, "{name}");
    }
    let initializer = host.get("/docs/swagger-initializer.js").await.text;
    assert!(initializer.contains(r#""validatorUrl": "none""#) && initializer.contains("../openapi.json"));
    for text in [page.text, initializer, host.get("/docs/index.css").await.text] {
        assert!(!text.contains("http://") && !text.contains("https://") && !text.contains("\"//"), "{text}");
    }
}
