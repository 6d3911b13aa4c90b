//! Answers that no restructuring may change: golden and generated scenes, by every method.
//!
//! `tests/golden/frozen.txt` holds a digest for each. Statistics and sentences are left out: times differ from run to run, and
//! sentences may become clearer. Where an answer is meant to change, `FROZEN=write` rewrites the file.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use singulate::experiments::varied;
use singulate::wire::SceneBody;
use singulate_planner::scene::{Scene, SceneLimits};

use crate::host::Host;

/// How many generated scenes.
const GENERATED: u64 = 500;

/// Named scenes, as request bodies without settings.
fn scenes() -> Vec<(String, Value)> {
    let golden: Value = serde_json::from_str(include_str!("../golden/scenes.json")).unwrap();
    let golden = golden.as_array().unwrap().iter();
    let golden = golden.map(|case| (case["name"].as_str().unwrap().to_owned(), case["scene"].clone()));
    let generated = (0..GENERATED).map(|seed| {
        let (scene, _) = Scene::new(varied(seed), &SceneLimits::default()).unwrap();
        (format!("generated-{seed}"), serde_json::to_value(SceneBody::new(&scene, None)).unwrap())
    });
    golden.chain(generated).collect()
}

/// What is asked of the scene with this number: name, path, settings. The costly questions of every tenth only.
fn questions(number: usize) -> Vec<(&'static str, &'static str, Value)> {
    let mut questions = vec![("plan", "/v1/plans", json!({}))];
    if number.is_multiple_of(10) {
        questions.extend([
            ("short", "/v1/plans", json!({"objective": "short_moves"})),
            ("paper", "/v1/plans", json!({"grasp_model": "sector", "search": "lobs", "placement": "raster"})),
            ("astar", "/v1/plans", json!({"search": "forward_astar"})),
            ("survey", "/v1/survey", json!({})),
            ("knowledge", "/v1/knowledge", json!({})),
            ("sectors", "/v1/knowledge", json!({"grasp_model": "sector"})),
        ]);
    }
    questions
}

/// The answer without what may differ.
fn digest(mut answer: Value) -> String {
    if let Some(answer) = answer.as_object_mut() {
        answer.remove("statistics");
    }
    for warning in answer.get_mut("warnings").and_then(Value::as_array_mut).into_iter().flatten() {
        warning.as_object_mut().unwrap().retain(|name, _| matches!(name.as_str(), "code" | "pointer"));
    }
    Sha256::digest(answer.to_string()).iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}

#[tokio::test]
async fn answers_are_what_they_were() {
    let host = Host::start().await;
    let mut found = BTreeMap::new();
    for (number, (name, mut scene)) in scenes().into_iter().enumerate() {
        for (kind, path, mut settings) in questions(number) {
            // No machine exhausts this.
            settings["time_limit_ms"] = json!(60_000);
            scene["settings"] = settings;
            let reply = host.post(path, &scene).await;
            assert_eq!(reply.status, 200, "{name} {kind}: {reply:?}");
            found.insert(format!("{name} {kind}"), digest(reply.json()));
        }
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/frozen.txt");
    if std::env::var("FROZEN").is_ok_and(|value| value == "write") {
        let lines = found.iter().fold(String::new(), |mut lines, (name, digest)| {
            writeln!(lines, "{name} {digest}").unwrap();
            lines
        });
        fs::write(&path, lines).unwrap();
    }
    let frozen = fs::read_to_string(&path).unwrap();
    let frozen = frozen.lines().map(|line| line.rsplit_once(' ').unwrap());
    let frozen: BTreeMap<_, _> = frozen.map(|(name, digest)| (name.to_owned(), digest.to_owned())).collect();
    let changed: Vec<&String> =
        found.iter().filter(|(name, digest)| frozen.get(*name) != Some(digest)).map(|(name, _)| name).collect();
    assert!(changed.is_empty(), "{} of {} answers changed: {changed:?}", changed.len(), found.len());
    assert_eq!(found.len(), frozen.len());
}
