//! What each command prints, and how it exits.

use std::process::Stdio;

use serde_json::Value;

use crate::scenes::{ALONE, CROWD, FAULTY};
use crate::{answered, failed, file, run, run_with_input, singulate};

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn plan_answers_in_the_format_asked_for() {
    let path = file("formats.json", CROWD);
    let path = path.to_str().unwrap();
    let answer = json(&answered(run(&["plan", path])));
    assert_eq!(
        (&answer["verdict"], &answer["cost"], &answer["optimal"]),
        (&"relocate".into(), &2.into(), &true.into())
    );
    let explicit = json(&answered(run(&["plan", path, "--format", "json"])));
    assert_eq!(explicit["relocations"], answer["relocations"]);
    let text = answered(run(&["plan", "--format", "text", path]));
    assert!(
        text.starts_with("relocate 2 objects (proven least)\ntarget: cup\n") && text.contains("So 2 is the least.")
    );
    let drawing = answered(run(&["plan", path, "--format", "svg"]));
    assert!(drawing.starts_with("<svg") && drawing.matches("class=\"relocation\"").count() == 2);
    let errors = failed(&run(&["plan", path, "--format", "pdf"]), 2);
    assert!(errors.contains("pdf") && errors.contains("json, text, svg"));
}

#[test]
fn a_scene_can_come_from_stdin() {
    let answer = json(&answered(run_with_input(&["plan", "-"], ALONE)));
    assert_eq!((&answer["verdict"], &answer["scene_id"]), (&"graspable".into(), &"alone".into()));
}

#[test]
fn a_bad_scene_gives_every_fault_with_its_place_and_status_2() {
    for command in ["plan", "survey"] {
        let errors = failed(&run_with_input(&[command, "-"], FAULTY), 2);
        let lines: Vec<&str> = errors.lines().collect();
        assert_eq!(lines[0], "stdin: 4 faults");
        let starts = [
            "  unknown_field  /colour  ",
            "  wrong_type  /gripper/clearance  ",
            "  not_whole  /gripper/fingers  ",
            "  out_of_range  /objects/0/radius  ",
        ];
        for start in starts {
            assert!(lines[1..].iter().any(|line| line.starts_with(start)), "no '{start}' in {errors}");
        }
    }
    let errors = failed(&run_with_input(&["plan", "-"], "{\"table\": }"), 2);
    assert!(errors.contains("line 1 column 11") && errors.lines().count() == 1, "told once: {errors}");
    assert!(failed(&run(&["plan", "/nowhere.json"]), 2).starts_with("/nowhere.json: "));
}

#[test]
fn bad_arguments_exit_with_status_2() {
    for arguments in [&["plan"][..], &["paln"], &["plan", "a", "b"], &["generate", "--radius", "x"], &["serve", "here"]]
    {
        failed(&run(arguments), 2);
    }
}

#[test]
fn verify_answers_with_status_0_whether_the_plan_holds_or_not() {
    let scene = file("verify-scene.json", CROWD);
    let scene = scene.to_str().unwrap();
    let plan = answered(run(&["plan", scene]));
    let verified = json(&answered(run_with_input(&["verify", scene, "-"], &plan)));
    assert_eq!(verified, json(r#"{"valid": true, "faults": [], "first_failing_step": null, "replan": false}"#));
    let mut lifted = json(&plan);
    lifted["relocations"][0]["to"]["x"] = lifted["relocations"][1]["to"]["x"].clone();
    lifted["relocations"][0]["to"]["y"] = lifted["relocations"][1]["to"]["y"].clone();
    let verified = json(&answered(run_with_input(&["verify", scene, "-"], &lifted.to_string())));
    assert_eq!(verified["valid"], false);
    let text = answered(run_with_input(&["verify", scene, "-", "--format", "text"], &lifted.to_string()));
    assert!(text.starts_with("not valid: "), "{text}");
}

#[test]
fn verify_tells_whether_what_is_left_of_a_plan_can_be_carried_out() {
    let scene = file("verify-left.json", CROWD);
    let scene = scene.to_str().unwrap();
    let mut plan = json(&answered(run(&["plan", scene])));
    let x = &mut plan["relocations"][0]["from"]["x"];
    *x = (x.as_f64().unwrap() + 0.001).into();
    plan["relocations"].as_array_mut().unwrap().truncate(1);
    plan["target_grasp"] = Value::Null;
    let next = plan.to_string();
    let verified = |flags: &[&str]| json(&answered(run_with_input(&[&["verify", scene, "-"], flags].concat(), &next)));
    let answer = verified(&["--partial", "--position-tolerance", "0.002"]);
    assert_eq!((&answer["valid"], &answer["replan"]), (&true.into(), &false.into()), "{answer}");
    let answer = verified(&["--partial"]);
    assert_eq!((&answer["first_failing_step"], &answer["faults"][0]["code"]), (&0.into(), &"wrong_from".into()));
    assert_eq!(verified(&["--position-tolerance", "0.002"])["first_failing_step"], 1, "the final grasp is absent");
    for metres in ["-0.001", "1.5", "nan", "inf", "2mm"] {
        let metres = format!("--position-tolerance={metres}");
        failed(&run_with_input(&["verify", scene, "-", &metres], &next), 2);
    }
}

#[test]
fn verify_refuses_a_plan_for_another_target_and_a_second_stdin() {
    let scene = file("verify-target.json", ALONE);
    let plan = r#"{"target": "vase", "relocations": [], "target_grasp": {"yaw": 0}}"#;
    let errors = failed(&run_with_input(&["verify", scene.to_str().unwrap(), "-"], plan), 2);
    assert!(errors.contains("target_mismatch  /target"), "{errors}");
    failed(&run(&["verify", "-", "-"]), 2);
}

#[test]
fn survey_tells_of_every_movable_object() {
    let survey = json(&answered(run_with_input(&["survey", "-"], CROWD)));
    assert!(survey["objects"].is_array());
    assert!(answered(run_with_input(&["survey", "-", "--format", "text"], CROWD)).starts_with("object"));
}

#[test]
fn a_seed_gives_the_same_bytes_for_ever() {
    let arguments = ["generate", "--objects", "12", "--table", "1.2", "0.7", "--radius", "0.03..0.075"];
    let arguments = [&arguments[..], &["--seed", "7", "--fixed-share", "0.2"]].concat();
    let scene = answered(run(&arguments));
    assert_eq!(scene, include_str!("generated-seed-7.json"));
    assert_eq!(json(&answered(run_with_input(&["plan", "-"], &scene)))["target"], json(&scene)["target"]);
}

#[test]
fn generate_says_how_many_objects_fitted() {
    let errors = failed(&run(&["generate", "--objects", "100"]), 2);
    assert!(errors.contains("of 100 objects fitted on the table"), "{errors}");
    assert!(failed(&run(&["generate", "--fingers", "1"]), 2).contains("1 is not between 2 and 12"));
    answered(run(&["generate", "--pressed", "--radius", "0.03", "--origin", "-3", "7"]));
}

#[test]
fn generate_says_what_is_wanted_where_things_go_and_how_far_the_hand_opens() {
    let generated = |flags: &[&str]| json(&answered(run(&[&["generate", "--seed", "7"], flags].concat())));
    let plain = generated(&[]);
    let trays = ["--drop-off", "tray:4", "--drop-off", "bin"];
    let expected: Value = json(r#"[{"id": "tray", "capacity": 4}, {"id": "bin"}]"#);
    let clear = generated(&[&["--clear"], &trays[..]].concat());
    assert_eq!((&clear["goal"], &clear["drop_offs"]), (&json(r#"{"clear": true}"#), &expected));
    assert_eq!((&clear["target"], &clear["settings"]), (&Value::Null, &Value::Null));
    assert_eq!(clear["objects"], plain["objects"], "the same table");
    let all = generated(&[&["--all-of", "2", "--destination", "drop_off"], &trays[..]].concat());
    assert_eq!(all["settings"], json(r#"{"destination": "drop_off"}"#));
    let ids = |list: &Value| -> Vec<Value> { list.as_array().unwrap().clone() };
    let (two, three) = (ids(&all["goal"]["all_of"]), ids(&generated(&["--any-of", "3"])["goal"]["any_of"]));
    assert_eq!((two.len(), three.len()), (2, 3));
    assert!(two.iter().chain([&plain["target"]]).all(|id| three.contains(id)), "{two:?} {three:?}");
    let hand = &generated(&["--max-opening", "0.2", "--opening", "full"])["gripper"];
    assert_eq!((&hand["max_opening"], &hand["opening"]), (&0.2.into(), &"full".into()));
    for scene in [&clear, &all] {
        let verdict = json(&answered(run_with_input(&["plan", "-"], &scene.to_string())))["verdict"].clone();
        assert!(["cleared", "relocate"].map(Value::from).contains(&verdict), "{verdict}");
    }
}

#[test]
fn generate_refuses_goals_and_drop_offs_that_make_no_sense() {
    for (flags, detail) in [
        (&["--any-of", "2", "--clear", "--drop-off", "tray"][..], "cannot be used with"),
        (&["--any-of", "2", "--all-of", "2", "--drop-off", "tray"], "cannot be used with"),
        (&["--clear"], "--drop-off <ID[:CAPACITY]>"),
        (&["--all-of", "2"], "--drop-off <ID[:CAPACITY]>"),
        (&["--destination", "table"], "--drop-off <ID[:CAPACITY]>"),
        (&["--destination", "drop-off", "--drop-off", "tray"], "table_then_drop_off"),
        (&["--opening", "full"], "--max-opening <M>"),
        (&["--drop-off", "tray:few"], "'few' is no number of objects"),
        (&["--drop-off", "tray:0"], "0 is not between 1 and 1000000000"),
        (&["--drop-off", "tray", "--drop-off", "tray:2"], "'tray' is already the id of drop-off 0"),
        (&["--any-of", "0"], "at least one object"),
        (&["--any-of", "17"], "17 objects are wanted, and 16 can be grasped"),
        (&["--max-opening", "0.1"], "0.150000 m wide, more than the greatest opening 0.1 m"),
    ] {
        let errors = failed(&run(&[&["generate"], flags].concat()), 2);
        assert!(errors.contains(detail), "{flags:?}: {errors}");
    }
}

#[test]
fn a_table_that_is_cleared_is_told_and_drawn() {
    let table = ["generate", "--objects", "8", "--clear", "--drop-off", "tray:3", "--drop-off", "bin:2"];
    let scene = answered(run(&table));
    let text = answered(run_with_input(&["plan", "-", "--format", "text"], &scene));
    let page = include_str!("../../docs/command-line.md");
    let shown = page.split_once("```text clearing\n").unwrap().1.split_once("```").unwrap().0;
    assert_eq!(text.rsplit_once("\n\n").unwrap().0, shown.trim_end(), "without the times");
    assert!(page.contains(&table.join(" ")));
    let drawing = answered(run_with_input(&["plan", "-", "--format", "svg"], &scene));
    let count = |class: &str| drawing.matches(&format!("class=\"{class}\"")).count();
    assert_eq!((count("relocation"), count("tray"), count("route")), (5, 2, 5));
}

#[test]
fn openapi_prints_the_committed_document() {
    assert_eq!(answered(run(&["openapi"])), include_str!("../../openapi/openapi.json"));
}

#[test]
fn a_reader_that_stops_early_is_no_error() {
    let mut child = singulate(&["openapi"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), output.stderr.len()), (Some(0), 0));
}

#[test]
fn finer_gaps_give_more_room_and_cost_no_plan() {
    let planned = |scene| -> Value { serde_json::from_str(&answered(run_with_input(&["plan", "-"], scene))).unwrap() };
    // Sought with the finer gaps from the beginning, no plan is found before the effort is spent.
    assert_eq!(planned(include_str!("tight-fit.json"))["cost"], 3);
    let roomy = planned(include_str!("one-micrometre.json"));
    assert!(roomy["relocations"][0]["gap"].as_f64().unwrap() > 0.003, "{roomy}");
}
