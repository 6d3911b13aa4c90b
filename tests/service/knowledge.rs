//! What is known before any search, and the paper's methods, over HTTP.

use serde_json::{Value, json};

use crate::host::Host;

/// The target `a` with two obstacles near, and `c`, fixed, out of reach of everything.
fn scene(settings: Value) -> Value {
    json!({
        "table": {"x_min": 0, "y_min": 0, "x_max": 2, "y_max": 1},
        "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
        "objects": [
            {"id": "a", "x": 0.5, "y": 0.5, "radius": 0.075},
            {"id": "b", "x": 0.66, "y": 0.5, "radius": 0.075},
            {"id": "crumb", "x": 0.4, "y": 0.5, "radius": 0.01},
            {"id": "c", "x": 1.8, "y": 0.5, "radius": 0.075, "fixed": true}
        ],
        "target": "a",
        "settings": settings
    })
}

fn object<'a>(body: &'a Value, id: &str) -> &'a Value {
    body["objects"].as_array().unwrap().iter().find(|object| object["id"] == id).unwrap()
}

fn numbers(list: &Value) -> Vec<f64> {
    list.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

#[tokio::test]
async fn knowledge_tells_every_objects_shadows_and_options() {
    let host = Host::start().await;
    let reply = host.post("/v1/knowledge", &scene(json!({}))).await;
    let body = reply.json();
    let ids: Vec<_> = body["objects"].as_array().unwrap().iter().map(|object| &object["id"]).collect();
    assert_eq!((reply.status, ids.len(), ids[0], ids[3]), (200, 4, &json!("a"), &json!("c")));
    let a = object(&body, "a");
    assert_eq!((&a["options"], &a["histogram"]), (&json!([[]]), &Value::Null));
    let obstacles: Vec<_> = a["shadows"].as_array().unwrap().iter().map(|shadow| &shadow["obstacle"]).collect();
    assert_eq!(obstacles, ["b", "crumb"]);
    // b stands to the right of a, so it blocks yaw 0 to both sides.
    let intervals = &a["shadows"][0]["intervals"];
    let (low, high) = (numbers(&intervals[0]), numbers(&intervals[1]));
    let period = core::f64::consts::TAU / 3.0;
    assert!(low[0] == 0.0 && low[1] > 0.3 && (high[1] - period).abs() < 1e-12, "{intervals}");
    assert!((low[1] - (period - high[0])).abs() < 1e-9, "{intervals}");
    let free = numbers(&a["option_yaws"][0][0]);
    assert!(free[0] >= low[1] - 1e-9 && free[1] <= high[0] + 1e-9, "{free:?}");
    let c = object(&body, "c");
    assert_eq!(*c, json!({"id": "c", "options": [], "option_yaws": [], "shadows": [], "histogram": null}));
}

#[tokio::test]
async fn knowledge_by_sectors_comes_with_the_histogram() {
    let host = Host::start().await;
    let body = host.post("/v1/knowledge", &scene(json!({"grasp_model": "sector"}))).await.json();
    let histogram = &object(&body, "a")["histogram"];
    let (h, g) = (numbers(&histogram["h"]), numbers(&histogram["g"]));
    assert_eq!((h.len(), g.len()), (360, 120));
    // b on the right, the crumb on the left, nothing above.
    assert!(h[0] > 0.0 && h[180] > h[0] && h[90] == 0.0, "{h:?}");
    assert!(g[60] > 0.0 && g.contains(&0.0), "{g:?}");
    assert!(object(&body, "c")["histogram"].is_null());
}

#[tokio::test]
async fn a_plan_by_the_papers_methods_says_what_is_known_of_it() {
    let host = Host::start().await;
    let plain = host.post("/v1/plans", &scene(json!({}))).await.json();
    assert_eq!((&plain["verdict"], &plain["warnings"]), (&json!("graspable"), &json!([])));
    let sector = host.post("/v1/plans", &scene(json!({"grasp_model": "sector", "search": "lobs"}))).await.json();
    assert_eq!((&sector["verdict"], &sector["optimal"]), (&json!("graspable"), &json!(true)));
    // The crumb stands inside the ring.
    let warnings = sector["warnings"].as_array().unwrap();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert_eq!(
        (&warnings[0]["code"], &warnings[0]["pointer"]),
        (&json!("tangent_angle"), &json!("/settings/grasp_model"))
    );
}

#[tokio::test]
async fn a_false_deadlock_is_served_without_proof() {
    let host = Host::start().await;
    let mut scene: Value = serde_json::from_str(include_str!("../golden/lobs/false_deadlock.json")).unwrap();
    scene["settings"] = json!({"search": "lobs", "time_limit_ms": 60_000});
    let body = host.post("/v1/plans", &scene).await.json();
    assert_eq!(body["verdict"], "deadlock");
    for field in ["deadlock", "cost", "lower_bound", "optimal", "landmarks", "needed"] {
        assert!(body[field].is_null(), "{field} is {}", body[field]);
    }
    let codes: Vec<_> = body["warnings"].as_array().unwrap().iter().map(|warning| &warning["code"]).collect();
    assert_eq!(codes, ["false_deadlock", "unproven_deadlock"]);
    scene["settings"] = json!({"time_limit_ms": 60_000});
    let exact = host.post("/v1/plans", &scene).await.json();
    assert_eq!((&exact["verdict"], &exact["cost"], &exact["optimal"]), (&json!("relocate"), &json!(5), &json!(true)));
}
