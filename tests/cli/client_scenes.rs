//! What the client examples are to print is what `plan` says, as long as `verify` says after each move that it holds.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::{answered, failed, file, run, run_with_input};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("client-examples/scenes")
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The scenes' names; each has a file of what a client prints for it.
fn names() -> Vec<String> {
    let stem = |path: PathBuf| path.file_stem().unwrap().to_str().unwrap().to_owned();
    let files = |folder: &Path, kind: &str| {
        let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let mut names: Vec<String> =
            paths.filter(|path| path.extension().is_some_and(|it| it == kind)).map(stem).collect();
        names.sort();
        names
    };
    let names = files(&folder(), "json");
    assert_eq!(names, files(&folder().join("expected"), "txt"));
    names
}

fn ids(list: &Value) -> String {
    list.as_array().unwrap().iter().map(|id| id.as_str().unwrap()).collect::<Vec<_>>().join(", ")
}

/// A number as the clients print it.
fn number(value: &Value) -> String {
    format!("{:.3}", value.as_f64().unwrap())
}

/// Where an object or the gripper stands, as the clients print it: the yaw where there is one.
fn place(value: &Value) -> String {
    let parts = ["x", "y", "yaw"].iter().filter_map(|&part| value.get(part));
    parts.map(number).collect::<Vec<_>>().join(" ")
}

/// The item of this id in a list of the scene.
fn position(list: &Value, id: &Value) -> usize {
    list.as_array().unwrap().iter().position(|item| item["id"] == *id).unwrap()
}

/// Carry a step out in the scene, and say so in the clients' words.
fn carry_out(scene: &mut Value, step: &Value) -> String {
    let object = step["object"].as_str().unwrap();
    let at = position(&scene["objects"], &step["object"]);
    let (from, grasp) = (place(&step["from"]), place(&step["grasp"]));
    if step["action"] == "pick_drop" {
        take_away(scene, at, &step["drop_off"]);
        let to = step["drop_off"].as_str().unwrap();
        return format!("take {object} from {from} away to {to}, grasp at {grasp}\n");
    }
    assert_eq!(step["action"], "pick_place");
    for (part, value) in step["to"].as_object().unwrap() {
        scene["objects"][at][part] = value.clone();
    }
    let (to, release) = (place(&step["to"]), place(&step["release"]));
    let turned = step.get("turn").map(|turn| format!(", turned by {}", number(turn))).unwrap_or_default();
    format!("move {object} from {from} to {to}{turned}, grasp at {grasp}, release at {release}\n")
}

/// The object at this position is at the drop-off, which is left out if it is full.
fn take_away(scene: &mut Value, object: usize, drop_off: &Value) {
    let gone = scene["objects"].as_array_mut().unwrap().remove(object);
    let at = position(&scene["drop_offs"], drop_off);
    if let Some(capacity) = scene["drop_offs"][at]["capacity"].as_u64() {
        scene["drop_offs"][at]["capacity"] = (capacity - 1).into();
        if capacity == 1 {
            scene["drop_offs"].as_array_mut().unwrap().remove(at);
        }
    }
    if let Some(wanted) = scene["goal"].get_mut("all_of") {
        wanted.as_array_mut().unwrap().retain(|id| *id != gone["id"]);
    }
}

/// What is left of a plan holds, so that no client plans again.
fn holds(scene: &Value, left: &Value) {
    let scene = file("client-scene.json", &scene.to_string());
    let arguments = ["verify", scene.to_str().unwrap(), "-", "--partial", "--position-tolerance", "0.005"];
    let verified: Value = serde_json::from_str(&answered(run_with_input(&arguments, &left.to_string()))).unwrap();
    assert_eq!(verified["replan"], false, "{verified}");
}

/// What a client prints for a scene in order, and its exit status.
fn followed(mut scene: Value) -> String {
    let mut answer: Value =
        serde_json::from_str(&answered(run_with_input(&["plan", "-"], &scene.to_string()))).unwrap();
    let mut said = String::new();
    while !answer["relocations"].as_array().unwrap().is_empty() {
        let step = answer["relocations"].as_array_mut().unwrap().remove(0);
        said.push_str(&carry_out(&mut scene, &step));
        // After the last step there is only a grasp to be asked about.
        if !answer["relocations"].as_array().unwrap().is_empty() || !answer["target_grasp"].is_null() {
            holds(&scene, &answer);
        }
    }
    said + &end(&answer)
}

/// What a client prints at the end of a plan.
fn end(answer: &Value) -> String {
    match answer["verdict"].as_str().unwrap() {
        "relocate" if answer["target"].is_null() => "all taken away\nexit 0\n".to_owned(),
        "graspable" | "relocate" => {
            let target = answer["target"].as_str().unwrap();
            format!("grasp {target} at {}\nexit 0\n", place(&answer["target_grasp"]))
        }
        "partly_cleared" => {
            assert_eq!(answer["proven"], true);
            let core = answer["stuck"].get("core");
            let stuck = core.map(|core| format!("stuck: {} hold each other\n", ids(core))).unwrap_or_default();
            format!("{stuck}partly cleared: {} left\nexit 7\n", ids(&answer["left"]))
        }
        "deadlock" => format!("deadlock: {} hold each other\nexit 3\n", ids(&answer["deadlock"]["core"])),
        "no_space" => format!("no space: {} would have to go\nexit 4\n", ids(&answer["needed"])),
        "timed_out" => format!("timed out: {} would have to go\nexit 5\n", ids(&answer["needed"])),
        verdict => panic!("{verdict}"),
    }
}

#[test]
fn every_client_scene_is_answered_as_the_clients_expect() {
    let mut ends = Vec::new();
    for name in names() {
        let expected = read(&folder().join("expected").join(&name).with_extension("txt"));
        let path = folder().join(&name).with_extension("json");
        let mut scene: Value = serde_json::from_str(&read(&path)).unwrap();
        if name == "invalid" {
            assert_eq!(expected, "exit 2\n");
            assert!(failed(&run(&["plan", path.to_str().unwrap()]), 2).lines().count() > 2, "several faults at once");
            continue;
        }
        assert_eq!(scene["scene_id"], name);
        if name == "timed-out" {
            // It ends at the limit of memory; however slow the machine is, time must not end it first.
            scene["settings"]["time_limit_ms"] = 60_000.into();
        }
        assert_eq!(followed(scene), expected, "{name}");
        ends.push(expected.trim_end().rsplit(' ').next().unwrap().to_owned());
    }
    for status in ["0", "3", "4", "5", "7"] {
        assert!(ends.iter().any(|end| end == status), "no scene ends with {status}");
    }
}
