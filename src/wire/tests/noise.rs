//! The overlap tolerance and its limits.

use serde_json::{Value, json};

use super::{has_faults, read, scene, with};
use crate::wire::{RequestLimits, read_scene};

/// The scene with `b` this deep in `a`.
fn overlapping(depth: f64) -> Value {
    with("/objects/1", json!({"id": "b", "x": 0.45 - depth, "y": 0.2, "radius": 0.075}))
}

fn with_tolerance(mut body: Value, tolerance: Value) -> Value {
    body["settings"] = json!({"overlap_tolerance": tolerance});
    body
}

fn codes(body: &Value) -> Vec<String> {
    read(&body.to_string()).unwrap().warnings.into_iter().map(|warning| warning.code).collect()
}

#[test]
fn discs_that_touch_in_decimals_do_not_overlap() {
    let case = read(include_str!("../../../tests/golden/touching-in-decimals.json")).unwrap();
    assert_eq!(case.warnings, []);
    // In every direction, and at every distance from the origin.
    for n in 0..2000_u32 {
        let turn = f64::from(n) * 0.377;
        let (x, y) = (f64::from(n) * 0.013, f64::from(n) * 0.007);
        let (along, across) = (0.08 * libm::cos(turn), 0.08 * libm::sin(turn));
        let disc = |id: &str, x: f64, y: f64| json!({"id": id, "x": x, "y": y, "radius": 0.04});
        let mut body = scene();
        body["table"] = json!({"x_min": -1, "y_min": -1, "x_max": 30, "y_max": 20});
        body["objects"] = json!([disc("a", x, y), disc("b", x + along, y + across)]);
        assert_eq!(codes(&body), Vec::<String>::new(), "{n}");
    }
}

#[test]
fn a_reported_overlap_is_never_shown_as_zero() {
    for depth in [1e-9, 1e-7, 4.9e-7, 5.1e-7, 1e-6, 2e-5, 1e-3] {
        let warnings = read(&overlapping(depth).to_string()).unwrap().warnings;
        assert_eq!(warnings.is_empty(), depth < 5e-7, "{depth}");
        assert!(warnings.iter().all(|warning| !warning.detail.contains("0.000000")), "{warnings:?}");
    }
}

#[test]
fn two_fixed_objects_may_overlap_as_deep_as_they_like() {
    let mut body = scene();
    let objects = body["objects"].as_array_mut().unwrap();
    for n in 0..22 {
        let x = 0.1 + f64::from(n) * 0.02;
        objects.push(json!({"id": format!("rack-{n}"), "x": x, "y": 0.6, "radius": 0.03, "fixed": true}));
    }
    objects.push(json!({"id": "rack-again", "x": 0.1, "y": 0.6, "radius": 0.03, "fixed": true}));
    assert_eq!(codes(&body), Vec::<String>::new());
}

#[test]
fn a_movable_object_overlaps_a_fixed_one_whichever_comes_first() {
    let plate = json!({"id": "plate", "x": 0.84, "y": 0.5, "radius": 0.02});
    for depth in [0.0, 0.0005, 0.005] {
        let mut body = scene();
        body["objects"][1] = plate.clone();
        body["objects"][1]["x"] = json!(0.83 + depth);
        for order in [[0, 1, 2], [0, 2, 1]] {
            let objects = order.map(|at: usize| body["objects"][at].clone());
            let mut body = body.clone();
            body["objects"] = json!(objects);
            match read(&body.to_string()) {
                Ok(request) if depth < 0.001 => {
                    let pointers: Vec<_> = request.warnings.iter().map(|warning| warning.pointer.as_str()).collect();
                    assert_eq!(pointers, if depth > 0.0 { vec!["/objects/2"] } else { Vec::new() });
                }
                Ok(_) => panic!("{depth} passes"),
                Err(problem) => has_faults(&problem, &[("overlap", "/objects/2")]),
            }
        }
    }
}

#[test]
fn a_pile_of_fixed_objects_is_read_and_no_pair_of_them_looked_at() {
    let mut body = scene();
    let rack = |n: u32| json!({"id": format!("rack-{n}"), "x": 0.9, "y": 0.5, "radius": 0.05, "fixed": true});
    body["objects"].as_array_mut().unwrap().extend((0..5000).map(rack));
    assert_eq!(codes(&body), Vec::<String>::new());
}

#[test]
fn a_request_says_how_deep_its_discs_may_overlap() {
    let noisy = overlapping(0.003);
    has_faults(&read(&noisy.to_string()).unwrap_err(), &[("overlap", "/objects/1")]);
    let request = read(&with_tolerance(noisy.clone(), json!(0.003)).to_string()).unwrap();
    assert_eq!(request.warnings[0].detail, "overlaps 'a' by 0.003000 m (tolerance 0.003 m)");
    assert!((request.overlap_tolerance - 0.003).abs() < 1e-15);
    assert!(read(&with_tolerance(overlapping(0.01), json!(0.01)).to_string()).is_ok());
    // A tolerance below the default is valid.
    has_faults(
        &read(&with_tolerance(overlapping(0.0005), json!(0)).to_string()).unwrap_err(),
        &[("overlap", "/objects/1")],
    );
    assert!(read(&with_tolerance(noisy, Value::Null).to_string()).is_err());
}

#[test]
fn a_tolerance_beyond_the_services_is_a_fault_of_its_own() {
    let pointer = "/settings/overlap_tolerance";
    for (value, code) in [
        (json!(0.011), "out_of_range"),
        (json!(-0.001), "out_of_range"),
        (json!(3), "out_of_range"),
        (json!("3 mm"), "wrong_type"),
    ] {
        // An overlap that some tolerance allows is not reported as well.
        let problem = read(&with_tolerance(overlapping(0.003), value).to_string()).unwrap_err();
        has_faults(&problem, &[(code, pointer)]);
    }
    let deeper = with_tolerance(overlapping(0.02), json!("3 mm"));
    has_faults(&read(&deeper.to_string()).unwrap_err(), &[("wrong_type", pointer), ("overlap", "/objects/1")]);
    // A fault of another setting does not change the tolerance.
    let mut body = with_tolerance(overlapping(0.003), json!(0.004));
    body["settings"]["objective"] = json!("fastest");
    has_faults(&read(&body.to_string()).unwrap_err(), &[("unknown_value", "/settings/objective")]);
}

#[test]
fn the_services_own_tolerance_may_always_be_named() {
    let mut limits = RequestLimits::default();
    let read = |body: Value, limits: &RequestLimits| read_scene(body.to_string().as_bytes(), limits);
    limits.max_overlap_tolerance = 0.002;
    assert!(read(with_tolerance(overlapping(0.002), json!(0.002)), &limits).is_ok());
    assert!(read(with_tolerance(overlapping(0.002), json!(0.003)), &limits).is_err());
    limits.scene.overlap_tolerance = 0.02;
    for body in [overlapping(0.015), with_tolerance(overlapping(0.015), json!(0.02))] {
        assert!(read(body, &limits).is_ok());
    }
    assert!(read(with_tolerance(overlapping(0.015), json!(0.021)), &limits).is_err());
}
