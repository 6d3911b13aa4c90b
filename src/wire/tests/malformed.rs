//! Bodies that are not JSON, and repeated fields.

use serde_json::json;

use super::{has_faults, read, scene, with};
use crate::wire::{Problem, ProblemKind, RequestLimits, path, read_batch, read_job, read_scene, read_verify};

fn refused(body: &[u8]) -> Problem {
    read_scene(body, &RequestLimits::default()).unwrap_err()
}

/// Assert the whole sentence about this body.
#[track_caller]
fn says(body: &str, sentence: &str) {
    let problem = refused(body.as_bytes());
    assert_eq!((problem.status(), problem.kind()), (400, ProblemKind::MalformedJson), "{body}");
    assert_eq!(problem.detail(), format!("the body is not JSON: {sentence}"), "{body}");
    assert_eq!(problem.errors()[0].detail, problem.detail());
}

const SCENE: &str = r#"{
 "table": {"x_min": 0, "y_min": 0, "x_max": 1, "y_max": 1},
 "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
 "objects": [
  {"id": "a", "x": 0.5, "y": 0.5, "radius": 0.1},
  {"x": 0.2, "y": 0.2, "radius": 0.05, "id": "süß"}
 ],
 "target": "a"
}"#;

#[test]
fn a_number_that_is_none_is_named_with_its_object() {
    let only = "JSON has only finite numbers";
    for word in ["NaN", "nan", "-NaN", "Infinity", "-Infinity", "inf", "-inf", "+Inf"] {
        let told = format!("{word} stands at line 5 column 20, in /objects/0/x of object 'a'; {only}");
        says(&SCENE.replacen("0.5", word, 1), &told);
        // The id comes after it.
        let told = format!("{word} stands at line 6 column 9, in /objects/1/x of object 'süß'; {only}");
        says(&SCENE.replacen("\"x\": 0.2", &format!("\"x\": {word}"), 1), &told);
    }
    says(
        &SCENE.replacen("\"x_max\": 1", "\"x_max\": NaN", 1),
        &format!("NaN stands at line 2 column 45, in /table/x_max; {only}"),
    );
    says("NaN", &format!("NaN stands at line 1 column 1; {only}"));
}

#[test]
fn every_number_that_is_none_is_told_and_the_slip_behind_them_too() {
    let body = SCENE.replace("0.5", "NaN").replace("\"a\"\n}", "\"a\", // the cup\n}");
    let problem = refused(body.as_bytes());
    has_faults(
        &problem,
        &[("malformed_json", "/objects/0/x"), ("malformed_json", "/objects/0/y"), ("malformed_json", "")],
    );
    assert!(problem.errors()[2].detail.ends_with("a comment stands at line 8 column 17; JSON has no comments"));
    let many = format!("[{}0]", "NaN,".repeat(2000));
    assert_eq!(refused(many.as_bytes()).errors().len(), path::MAX_ERRORS);
}

#[test]
fn an_object_without_a_name_that_can_be_shown_is_told_by_its_pointer() {
    let only = "JSON has only finite numbers";
    says(r#"[{"x": NaN}]"#, &format!("NaN stands at line 1 column 8, in /0/x; {only}"));
    says(r#"[{"id": 7, "x": NaN}]"#, &format!("NaN stands at line 1 column 17, in /0/x; {only}"));
    let told = format!("NaN stands at line 1 column 26, in /0/to/x of object 'a'; {only}");
    says(r#"[{"id": "a", "to": {"x": NaN, "y": 0}}]"#, &told);
    let long = "a".repeat(129);
    let told = format!("NaN stands at line 1 column {}, in /0/x; {only}", long.len() + 15);
    says(&format!(r#"[{{"id":"{long}","x":NaN}}]"#), &told);
}

#[test]
fn syntax_of_other_languages_is_named() {
    let comment = |place| format!("a comment stands at {place}; JSON has no comments");
    says("// a scene\n{}", &comment("line 1 column 1"));
    says("{\n  # a scene\n}", &comment("line 2 column 3"));
    says("{\"a\": /* one */ 1}", &comment("line 1 column 7"));
    says("{\"a\": [1 // one\n]}", &comment("line 1 column 10"));
    says("{} // done", &comment("line 1 column 4"));
    let quote = |kind, place| format!("a {kind} quote stands at {place}; JSON puts names and texts in double quotes");
    says("{'a': 1}", &quote("single", "line 1 column 2"));
    says("{\"ä\": 'b'}", &quote("single", "line 1 column 7"));
    says("{“a”: 1}", &quote("typographic", "line 1 column 2"));
    let comma = |place| format!("a trailing comma stands at {place}; no comma follows the last entry");
    says("{\"a\": [1, 2,\n]}", &comma("line 1 column 12"));
    says("{\"a\": 1, }", &comma("line 1 column 8"));
    says("{\"a\": None}", "None stands at line 1 column 7; JSON writes null");
    says("{\"a\": True}", "True stands at line 1 column 7; JSON writes true");
    says("[FALSE]", "FALSE stands at line 1 column 2; JSON writes false");
    says("[undefined]", "the word 'undefined' stands at line 1 column 2; JSON puts texts in double quotes");
    says("scene.json", "the word 'scene.json' stands at line 1 column 1; JSON puts texts in double quotes");
    says("{a: 1}", "the name 'a' at line 1 column 2 has no quotes; JSON puts names in double quotes");
}

#[test]
fn digits_that_are_no_number_hide_no_slip_behind_them() {
    says("[1., NaN]", "NaN stands at line 1 column 6, in /1; JSON has only finite numbers");
    says("{\"a\": 1e, // one\n}", "a comment stands at line 1 column 11; JSON has no comments");
    says("[-1.e5, 0]", "invalid number at line 1 column 5");
    says("[1e999, 0 1]", "expected `,` or `]` at line 1 column 11");
}

#[test]
fn a_body_that_is_not_utf_8_is_named() {
    let wide = |bytes: fn(u16) -> [u8; 2], mark: bool| -> Vec<u8> {
        let mark = mark.then_some(0xfeff);
        mark.into_iter().chain(SCENE.encode_utf16()).flat_map(bytes).collect()
    };
    for bytes in [u16::to_le_bytes, u16::to_be_bytes] {
        for mark in [true, false] {
            let problem = refused(&wide(bytes, mark));
            assert_eq!(problem.detail(), "the body is not JSON: it is encoded in UTF-16; send UTF-8");
        }
    }
    let utf_32: Vec<u8> = SCENE.chars().flat_map(|letter| u32::from(letter).to_le_bytes()).collect();
    assert!(refused(&utf_32).detail().contains("UTF-32"));
    says("\u{feff}{}", "it begins with a byte order mark; send UTF-8 without it");
    let latin_1: Vec<u8> = SCENE.chars().map(|letter| u8::try_from(letter).unwrap()).collect();
    assert_eq!(refused(&latin_1).detail(), "the body is not JSON: the byte 0xfc at line 6 column 48 is not UTF-8");
    assert_eq!(
        refused(b"\x1f\x8b\x08").detail(),
        "the body is not JSON: it is compressed by gzip; send it uncompressed"
    );
    assert_eq!(refused(b" \r\n").detail(), "the body is empty");
}

#[test]
fn any_other_syntax_error_has_the_json_librarys_message() {
    says("{\n \"table\": }", "expected value at line 2 column 11");
    says("{\"a\": 1 \"b\": 2}", "expected `,` or `}` at line 1 column 9");
    says("{} {}", "trailing characters at line 1 column 4");
    says("[nul", "EOF while parsing a value at line 1 column 4");
    says("[\"a", "EOF while parsing a string at line 1 column 3");
    says("[01]", "invalid number at line 1 column 3");
    says(&"[".repeat(1000), "recursion limit exceeded at line 1 column 128");
}

#[test]
fn a_field_that_is_there_twice_is_a_fault_at_its_place() {
    let twice =
        SCENE.replacen("\"x\": 0.5", "\"x\": 0.5, \"x\": 0.6", 1).replacen("\"target\"", "\"table\": 3, \"target\"", 1);
    let problem = refused(twice.as_bytes());
    assert_eq!((problem.status(), problem.kind()), (422, ProblemKind::InvalidRequest));
    assert_eq!(problem.errors()[0].detail, "'x' is there a second time, at line 5 column 25");
    has_faults(&problem, &[("repeated_field", "/objects/0/x"), ("repeated_field", "/table"), ("wrong_type", "/table")]);
    // A name with an escape is the same name.
    let problem = refused(SCENE.replacen("\"x\": 0.5", "\"x\": 0.5, \"\\u0078\": 0.5", 1).as_bytes());
    has_faults(&problem, &[("repeated_field", "/objects/0/x")]);
    // A colon in a string does not follow a name.
    let named = SCENE.replacen("\"a\"", "\"a:\\\"b:\"", 1).replacen("\"target\": \"a\"", "\"target\": \"a:\\\"b:\"", 1);
    assert!(read_scene(named.as_bytes(), &RequestLimits::default()).is_ok());
}

#[test]
fn jobs_and_checks_refuse_a_field_that_is_there_twice_too() {
    let limits = RequestLimits::default();
    let twice = SCENE.replacen("\"x\": 0.5", "\"x\": 0.5, \"x\": 0.5", 1);
    has_faults(&read_job(twice.as_bytes(), &limits).unwrap_err(), &[("repeated_field", "/objects/0/x")]);
    let batch = format!("{{\"scenes\": [{twice}]}}");
    has_faults(&read_batch(batch.as_bytes(), &limits).unwrap_err(), &[("repeated_field", "/scenes/0/objects/0/x")]);
    let plan = r#"{"relocations": [], "target_grasp": {"yaw": 0, "yaw": 1, "slack": 0.1}}"#;
    let verify = format!("{{\"scene\": {SCENE}, \"plan\": {plan}}}");
    has_faults(&read_verify(verify.as_bytes(), &limits).unwrap_err(), &[("repeated_field", "/plan/target_grasp/yaw")]);
}

#[test]
fn long_names_and_ids_make_no_long_answer() {
    let (name, thousand) = ("a".repeat(40_000), vec!["NaN"; 1001].join(","));
    let repeated = vec![r#""a":0"#; 1001].join(",");
    for body in [
        format!(r#"{{"{name}":[{thousand}]}}"#),
        format!(r#"{{"{name}":{{{repeated}}}}}"#),
        format!(r#"{{"id":"{name}","objects":[{thousand}]}}"#),
        format!(r#"{{"{name}":0,"{name}":0}}"#),
    ] {
        let problem = refused(body.as_bytes());
        let length = serde_json::to_vec(&problem).unwrap().len();
        assert!(length < 500_000 && problem.errors().len() <= 1000, "{length} {}", problem.errors().len());
    }
}

/// The JSON library means something by these names where it reads a value of its own.
#[test]
fn a_name_that_the_json_library_keeps_for_itself_is_a_name() {
    for name in ["$serde_json::private::Number", "$serde_json::private::RawValue"] {
        for (pointer, text) in [("/objects/0/x", "0.3"), ("/target", "\"a\""), ("/objects", "[]"), ("/table", "{}")] {
            let problem = read(&with(pointer, json!({name: text})).to_string()).expect_err("an object");
            assert!(problem.errors().iter().any(|error| error.pointer.starts_with(pointer)), "{name} {problem}");
        }
        let whole = read(&json!({name: scene().to_string()}).to_string()).expect_err("no scene");
        has_faults(
            &whole,
            &[
                ("unknown_field", &format!("/{name}")),
                ("missing", "/table"),
                ("missing", "/gripper"),
                ("missing", "/objects"),
                ("missing", "/target"),
            ],
        );
    }
}

/// One text within the other, each with all the brackets that a body may have, would fill any stack.
#[test]
fn a_text_within_a_text_is_read_as_a_text() {
    let mut text = "0".to_owned();
    for _ in 0..12 {
        let inner = json!({"$serde_json::private::RawValue": text}).to_string();
        text = format!("{}{inner}{}", "[".repeat(120), "]".repeat(120));
    }
    let problem = read(&with("/objects/0/x", json!({"a": text})).to_string());
    has_faults(&problem.expect_err("an object"), &[("wrong_type", "/objects/0/x")]);
    let problem = read(&scene().to_string().replace("0.3", &text)).expect_err("lists");
    has_faults(&problem, &[("wrong_type", "/objects/0/x")]);
}

#[test]
fn a_repeated_field_is_seen_whatever_else_is_there() {
    let body = scene().to_string();
    let twice = format!(
        r#"{},"target":"b","scene_id":{{"$serde_json::private::RawValue":"{{\"a\":1,\"b\":2}}"}}}}"#,
        &body[..body.len() - 1]
    );
    let problem = read(&twice).expect_err("twice");
    assert!(problem.errors().iter().any(|error| error.pointer == "/target"), "{problem}");
}
