//! What the page for robot controllers shows, carried out.

use std::process::Command;

use serde_json::{Value, json};

use crate::{answered, file, run, run_with_input};

const PAGE: &str = include_str!("../../docs/robot-controllers.md");

fn block(kind: &str) -> &'static str {
    PAGE.split(&format!("```{kind}\n")).nth(1).unwrap().split("```").next().unwrap()
}

/// A cup and a plate on each side of it, 12 mm away, for the gripper with the page's margins.
fn scene() -> Value {
    let gripper: Value = serde_json::from_str(block("json margins")).unwrap();
    let disc = |id: &str, x: f64, y: f64| json!({"id": id, "x": x, "y": y, "radius": 0.04});
    json!({
        "table": {"x_min": 0, "y_min": 0, "x_max": 1, "y_max": 0.8},
        "gripper": gripper,
        "objects": [
            disc("cup", 0.5, 0.4),
            disc("east", 0.592, 0.4), disc("north", 0.5, 0.492), disc("west", 0.408, 0.4), disc("south", 0.5, 0.308)
        ],
        "target": "cup"
    })
}

fn planned(scene: &Value) -> Value {
    serde_json::from_str(&answered(run_with_input(&["plan", "-"], &scene.to_string()))).unwrap()
}

#[test]
fn every_path_that_is_named_is_one_of_the_interface() {
    let document: Value = serde_json::from_str(include_str!("../../openapi/openapi.json")).unwrap();
    for page in [PAGE, include_str!("../../docs/errors.md")] {
        let paths: Vec<&str> = page
            .match_indices("/v1/")
            .map(|(at, _)| page[at..].split(|c: char| !(c.is_alphanumeric() || "/{}_".contains(c))).next().unwrap())
            .collect();
        assert!(!paths.is_empty());
        for path in paths {
            assert!(document["paths"][path].is_object(), "{path}");
        }
    }
}

#[test]
fn frames_and_yaws_are_as_the_functions_say() {
    let checks = r#"
x, y, yaw = to_robot(0.3, 0.1, 0.2, 1.0, 2.0, math.pi / 2)
assert math.isclose(x, 0.9) and math.isclose(y, 2.3) and math.isclose(yaw, 0.2 + math.pi / 2)
for fingers in range(2, 13):
    for wrist in (-6.0, -1.0, 0.0, 0.4, 3.1, 9.0):
        for yaw in (0.0, 0.3, 6.2):
            turned = nearest_yaw(yaw, wrist, fingers)
            turns = (turned - yaw) * fingers / (2 * math.pi)
            assert math.isclose(turns, round(turns), abs_tol=1e-9)
            assert abs(turned - wrist) <= math.pi / fingers + 1e-9
"#;
    let output = Command::new("python3").args(["-c", &format!("{}{checks}", block("python"))]).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn the_margins_are_the_sums_and_every_step_keeps_them() {
    let gripper: Value = serde_json::from_str(block("json margins")).unwrap();
    let field = |name: &str| gripper[name].as_f64().unwrap();
    let (place, radius, robot, yaw, thickness) = (0.0015, 0.001, 0.0005, 0.02, 0.008);
    assert!((field("margin") - 2.0 * (robot + place + radius)).abs() < 1e-12);
    assert!(field("clearance") >= thickness + robot + place + radius && field("yaw_tolerance") >= yaw);

    let answer = planned(&scene());
    let steps = answer["relocations"].as_array().unwrap();
    assert!(!steps.is_empty(), "{answer}");
    let slack = |grasp: &Value| grasp["slack"].as_f64().unwrap();
    assert!(slack(&answer["target_grasp"]) >= field("yaw_tolerance"));
    for step in steps {
        assert!(step["gap"].as_f64().unwrap() >= field("margin"), "{step}");
        assert!(["grasp", "release"].iter().all(|part| slack(&step[part]) >= field("yaw_tolerance")), "{step}");
    }
}

/// What the camera sees after so many moves, of which `step` is the last: the object near where it was put, and everything a
/// little elsewhere.
fn see(scene: &mut Value, step: &Value, moves: usize) {
    for (n, object) in scene["objects"].as_array_mut().unwrap().iter_mut().enumerate() {
        let moved = object["id"] == step["object"];
        for axis in ["x", "y"] {
            let was = if moved { &step["to"][axis] } else { &object[axis] }.as_f64().unwrap();
            let drift = if (n + moves).is_multiple_of(2) { 0.0015 } else { -0.0015 };
            object[axis] = json!(was + drift);
        }
    }
}

#[test]
fn one_move_at_a_time_comes_to_an_end_though_each_is_a_little_off() {
    let mut scene = scene();
    let mut costs = Vec::new();
    loop {
        let answer = planned(&scene);
        costs.push(answer["cost"].as_u64().unwrap());
        if answer["verdict"] == "graspable" {
            break;
        }
        assert_eq!(answer["verdict"], "relocate");
        see(&mut scene, &answer["relocations"][0], costs.len());
    }
    assert_eq!(costs, [2, 1, 0]);
}

#[test]
fn a_plan_holds_to_its_end_though_each_move_is_a_little_off() {
    let terms: Value = serde_json::from_str(block("json verify")).unwrap();
    let (place, robot) = (0.0015, 0.0005);
    assert_eq!(terms, json!({"partial": true, "position_tolerance": 2.0 * place + robot}));
    let tolerance = terms["position_tolerance"].to_string();
    let mut scene = scene();
    let mut plan = planned(&scene);
    for moves in 1..=plan["relocations"].as_array().unwrap().len() {
        let step = plan["relocations"].as_array_mut().unwrap().remove(0);
        see(&mut scene, &step, moves);
        let picture = file("picture.json", &scene.to_string());
        let verify = ["verify", picture.to_str().unwrap(), "-", "--partial", "--position-tolerance", &tolerance];
        let verified: Value = serde_json::from_str(&answered(run_with_input(&verify, &plan.to_string()))).unwrap();
        assert_eq!(verified["replan"], false, "{verified}");
        let exact: Value = serde_json::from_str(&answered(run_with_input(&verify[..4], &plan.to_string()))).unwrap();
        let left = !plan["relocations"].as_array().unwrap().is_empty();
        assert_eq!(exact["replan"], left, "without a tolerance the next step is not where it was: {exact}");
    }
}

#[test]
fn the_hands_that_are_described_go_with_a_scene() {
    let section = PAGE.split("\n## How do I describe my hand?\n").nth(1).unwrap().split("\n## ").next().unwrap();
    let hands: Vec<Value> = section
        .split('`')
        .filter(|part| part.starts_with("{\"fingers\""))
        .map(|part| serde_json::from_str(part).unwrap())
        .collect();
    assert_eq!(hands.len(), 2);
    for hand in hands {
        let mut scene = scene();
        // The cup fits between the open fingers with 2 mm to spare, the others do not.
        scene["objects"][0]["radius"] = (hand["max_opening"].as_f64().unwrap() / 2.0 - 0.001).into();
        scene["gripper"] = hand;
        let warnings = planned(&scene)["warnings"].clone();
        let warned: Vec<[&Value; 2]> =
            warnings.as_array().unwrap().iter().map(|warning| [&warning["code"], &warning["pointer"]]).collect();
        let expected = (1..5).map(|n| [json!("too_wide"), json!(format!("/objects/{n}"))]).collect::<Vec<_>>();
        assert_eq!(warned, expected.iter().map(|[code, pointer]| [code, pointer]).collect::<Vec<_>>());
    }
}

#[test]
fn a_request_is_as_large_as_is_said() {
    let (_, rest) = PAGE.split_once("`singulate generate ").unwrap();
    let arguments: Vec<&str> = rest.split(" \\|").next().unwrap().split(' ').collect();
    let length = answered(run(&[&["generate"][..], &arguments].concat())).len();
    assert!((4_500..5_500).contains(&length), "{length}");
}

/// What the loop that clears a table has in its hands.
struct Cell {
    /// The table as it is.
    scene: Value,
    /// How many more objects each drop-off takes.
    room: Vec<(&'static str, u64)>,
    /// Pictures that were taken.
    pictures: usize,
    plans: usize,
    /// Where each object was taken.
    taken: Vec<(String, String)>,
}

impl Cell {
    /// The page's `perceive`, with the goal and what is left of the room: everything a little beside its place.
    fn perceive(&mut self) -> Value {
        self.pictures += 1;
        let mut seen = self.scene.clone();
        for (n, object) in seen["objects"].as_array_mut().unwrap().iter_mut().enumerate() {
            // Together 1.5 mm, the page's `e_place`.
            let error = if (n + self.pictures).is_multiple_of(2) { 0.001_06 } else { -0.001_06 };
            for axis in ["x", "y"] {
                object[axis] = json!(object[axis].as_f64().unwrap() + error);
            }
        }
        let left = self.room.iter().filter(|(_, left)| *left > 0);
        seen["drop_offs"] = left.map(|(id, left)| json!({"id": id, "capacity": left})).collect();
        seen
    }

    fn take(&mut self, step: &Value) {
        assert_eq!(step["action"], "pick_drop");
        let (object, drop_off) = (step["object"].as_str().unwrap(), step["drop_off"].as_str().unwrap());
        let objects = self.scene["objects"].as_array_mut().unwrap();
        let at = objects.iter().position(|item| item["id"] == object).unwrap();
        objects.remove(at);
        let room = self.room.iter_mut().find(|(id, _)| *id == drop_off).unwrap();
        room.1 -= 1;
        self.taken.push((object.to_owned(), drop_off.to_owned()));
    }

    /// The page's loop; the lift of this step fails, counted over all plans. The last answer.
    fn clear(&mut self, failing: usize) -> Value {
        let mut lifts = 0;
        loop {
            let answer = planned(&self.perceive());
            self.plans += 1;
            let mut rest = answer.clone();
            if rest["relocations"].as_array().unwrap().is_empty() {
                return answer;
            }
            while !rest["relocations"].as_array().unwrap().is_empty() {
                lifts += 1;
                if lifts == failing {
                    break;
                }
                let step = rest["relocations"].as_array_mut().unwrap().remove(0);
                self.take(&step);
                if replan(&self.perceive(), &rest) {
                    break;
                }
            }
        }
    }
}

/// Whether what is left of a plan asks for a new one.
fn replan(scene: &Value, rest: &Value) -> bool {
    let scene = file("cleared.json", &scene.to_string());
    let verify = ["verify", scene.to_str().unwrap(), "-", "--partial", "--position-tolerance", "0.0035"];
    let verified: Value = serde_json::from_str(&answered(run_with_input(&verify, &rest.to_string()))).unwrap();
    verified["replan"] == true
}

#[test]
fn the_loop_takes_all_away_though_a_lift_fails_and_each_picture_is_a_little_off() {
    assert!(block("text").contains("rest = answer\n    while rest.relocations is not empty"));
    let mut scene = scene();
    scene.as_object_mut().unwrap().remove("target");
    scene["goal"] = json!({"clear": true});
    let mut cell = Cell { scene, room: vec![("tray", 2), ("bin", 40)], pictures: 0, plans: 0, taken: Vec::new() };
    let last = cell.clear(3);
    assert_eq!(
        (&last["verdict"], &last["proven"], last["left"].as_array().unwrap().len()),
        (&json!("cleared"), &json!(true), 0)
    );
    assert_eq!(cell.taken.len(), 5);
    assert_eq!(cell.taken.iter().filter(|(_, to)| to == "tray").count(), 2);
    assert_eq!(cell.plans, 3, "one at the start, one after the failed lift, one that says that all is away");
}
