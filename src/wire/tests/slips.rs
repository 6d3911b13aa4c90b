//! Numbers that look like another unit, and their warnings.

use serde_json::{Value, json};

use super::{has_faults, read, scene, with};

/// The code, the pointer and the sentence of each warning.
fn warnings(body: &Value) -> Vec<(String, String, String)> {
    let items = read(&body.to_string()).unwrap().warnings.into_iter();
    items.map(|item| (item.code, item.pointer, item.detail)).collect()
}

/// Codes and pointers alone.
fn places(body: &Value) -> Vec<(String, String)> {
    warnings(body).into_iter().map(|(code, pointer, _)| (code, pointer)).collect()
}

fn pairs(expected: &[(&str, &str)]) -> Vec<(String, String)> {
    expected.iter().map(|&(code, pointer)| (code.to_owned(), pointer.to_owned())).collect()
}

/// The sentence of the only fault.
fn fault(body: &Value, code: &str, pointer: &str) -> String {
    let problem = read(&body.to_string()).unwrap_err();
    has_faults(&problem, &[(code, pointer)]);
    problem.errors()[0].detail.clone()
}

/// The scene with some lengths multiplied by a factor.
fn scaled(factor: f64, whose: &[&str]) -> Value {
    fn scale(value: &mut Value, factor: f64) {
        match value {
            Value::Number(number) => *value = json!(number.as_f64().unwrap() * factor),
            Value::Object(fields) => {
                let lengths = fields.iter_mut().filter(|(name, _)| *name != "fingers");
                lengths.for_each(|(_, value)| scale(value, factor));
            }
            Value::Array(items) => items.iter_mut().for_each(|item| scale(item, factor)),
            _ => {}
        }
    }
    let mut body = scene();
    whose.iter().for_each(|name| scale(&mut body[name], factor));
    body
}

#[test]
fn degrees_for_radians_are_a_warning_from_half_a_period_on() {
    for (value, fingers) in [(2.0, 3), (1.0, 4), (3.0, 2), (core::f64::consts::PI / 3.0, 3)] {
        let mut body = with("/gripper/yaw_tolerance", json!(value));
        body["gripper"]["fingers"] = json!(fingers);
        let warnings = warnings(&body);
        let (code, pointer, detail) = &warnings[0];
        assert_eq!((code.as_str(), pointer.as_str()), ("wide_yaw_tolerance", "/gripper/yaw_tolerance"));
        assert!(detail.contains(&format!("{value} rad")) && detail.contains("radians?"), "{detail}");
        assert_eq!(warnings.len(), 1);
    }
    assert_eq!(places(&with("/gripper/yaw_tolerance", json!(1.047))), []);
    let detail = fault(&with("/gripper/yaw_tolerance", json!(5)), "out_of_range", "/gripper/yaw_tolerance");
    assert!(detail.contains("radians?"), "{detail}");
}

#[test]
fn one_length_in_millimetres_is_a_warning_at_its_place() {
    // Radii of 50 and 75 mm on 1.2 by 0.7 m.
    for (name, values) in
        [("margin", &[0.5, 1.0, 4.0, 20.0][..]), ("clearance", &[0.5, 1.0, 5.0, 50.0]), ("finger_width", &[1.0, 20.0])]
    {
        for value in values {
            let pointer = format!("/gripper/{name}");
            let found = warnings(&with(&pointer, json!(value)));
            assert_eq!((found[0].0.as_str(), &found[0].1), ("out_of_proportion", &pointer), "{value}");
            assert!(found[0].2.starts_with(&format!("{value} m")) && found[0].2.ends_with("metres?"), "{found:?}");
            let others = found.iter().skip(1);
            assert!(others.clone().all(|(code, ..)| code == "fingers_overlap"), "{found:?}");
        }
    }
    for (name, value) in [("margin", 0.1), ("clearance", 0.2), ("clearance", 0.002), ("finger_width", 0.001)] {
        assert_eq!(places(&with(&format!("/gripper/{name}"), json!(value))), [], "{name} {value}");
    }
}

#[test]
fn a_length_beyond_the_table_is_a_warning_whatever_the_radii() {
    let mut body = with("/objects/1", json!({"id": "b", "x": 0.6, "y": 0.35, "radius": 0.2}));
    body["gripper"]["margin"] = json!(0.4);
    assert_eq!(places(&body), pairs(&[("out_of_proportion", "/gripper/margin")]));
    assert!(warnings(&body)[0].2.contains("the table of 1.200 m by 0.700 m"));
}

#[test]
fn a_gripper_in_metres_among_millimetres_is_a_warning_and_so_is_the_reverse() {
    let fields = [("out_of_proportion", "/gripper/finger_width"), ("out_of_proportion", "/gripper/clearance")];
    for factor in [100.0, 1000.0] {
        assert_eq!(places(&scaled(factor, &["table", "objects"])), pairs(&fields), "{factor}");
    }
    let mut overlapping = pairs(&fields);
    overlapping.extend(pairs(&[("fingers_overlap", "/objects/0"), ("fingers_overlap", "/objects/1")]));
    assert_eq!(places(&scaled(1000.0, &["gripper"])), overlapping);
    // All in one unit: the answer is right except for the unit.
    assert_eq!(places(&scaled(1000.0, &["table", "objects", "gripper"])), []);
}

#[test]
fn a_table_in_millimetres_is_a_warning() {
    assert_eq!(places(&scaled(1000.0, &["table"])), pairs(&[("out_of_proportion", "/table")]));
}

#[test]
fn a_disc_that_hangs_over_the_table_by_more_than_a_third_is_a_warning() {
    let disc = |x: f64| with("/objects/1", json!({"id": "b", "x": x, "y": 0.2, "radius": 0.06}));
    for x in [0.039, 0.0, 1.161, 1.2] {
        assert_eq!(places(&disc(x)), pairs(&[("hangs_over_table", "/objects/1")]), "{x}");
    }
    for x in [0.06, 0.041, 0.04, 1.16, 1.1] {
        assert_eq!(places(&disc(x)), [], "{x}");
    }
    assert!(warnings(&disc(0.03))[0].2.contains("by 0.030000 m, more than a third of its radius 0.06 m"));
}

#[test]
fn an_object_beside_the_table_is_told_the_tables_range() {
    let beside = |x: f64| fault(&with("/objects/1/x", json!(x)), "off_table", "/objects/1");
    assert!(beside(3.0).ends_with("is not on the table (x from 0 to 1.2, y from 0 to 0.7)"), "{}", beside(3.0));
    assert!(beside(600.0).ends_with(": another frame, or millimetres instead of metres?"), "{}", beside(600.0));
}

#[test]
fn an_overlap_of_metres_or_of_half_a_disc_is_told_its_likely_cause() {
    let overlap = |x: f64, radius: f64| {
        let disc = json!({"id": "b", "x": x, "y": 0.2, "radius": radius});
        fault(&with("/objects/1", disc), "overlap", "/objects/1")
    };
    assert!(overlap(0.44, 0.075).ends_with("(tolerance 0.001 m)"));
    assert!(overlap(0.302, 0.075).ends_with(": one object seen twice?"));
    let mut radii = scene();
    radii["objects"][0]["radius"] = json!(75);
    let problem = read(&radii.to_string()).unwrap_err();
    assert_eq!(problem.errors().len(), 2);
    let metres = |detail: &str| detail.ends_with(": millimetres instead of metres, or one object seen twice?");
    assert!(problem.errors().iter().all(|error| metres(&error.detail)), "{problem}");
}

#[test]
fn every_fault_and_every_problem_names_its_entry() {
    let problem = read(&with("/colour", json!("red")).to_string()).unwrap_err();
    let written = serde_json::to_value(&problem).unwrap();
    assert_eq!(written["see"], "docs/errors.md#problem-invalid_request");
    assert_eq!(written["errors"][0]["see"], "docs/errors.md#unknown_field");
    let written = serde_json::to_value(read("{").unwrap_err()).unwrap();
    assert_eq!(
        (&written["see"], &written["errors"][0]["see"]),
        (&json!("docs/errors.md#problem-malformed_json"), &json!("docs/errors.md#malformed_json"),)
    );
}
