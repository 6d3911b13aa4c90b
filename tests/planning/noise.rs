//! Scenes as a camera sees them: every disc a little elsewhere, so that neighbours overlap; and things made of fixed discs
//! that overlap.

use std::collections::BTreeMap;

use serde_json::{Value, json};
use singulate::experiments::varied;
use singulate::wire::{AnswerBody, PlanRequest, RequestLimits, SceneBody, read_plan, read_scene};
use singulate_planner::budget::Budget;
use singulate_planner::check::check;
use singulate_planner::paper::{Judged, plan_by};
use singulate_planner::plan::survey;
use singulate_planner::scene::{Footprint, Scene, SceneLimits};
use singulate_planner::search::SILENT;
use singulate_planner::statement::{Statement, Step, Verdict};

/// How far a centre is off, m.
const NOISE: f64 = 3e-3;

/// Centres that are off by [`NOISE`] in the directions that the seed gives.
fn noisy(seed: u64) -> Value {
    let (scene, _) = Scene::new(varied(seed), &SceneLimits::default()).unwrap();
    let mut body = serde_json::to_value(SceneBody::new(&scene, None)).unwrap();
    for (n, object) in (0_u32..).zip(body["objects"].as_array_mut().unwrap()) {
        #[expect(clippy::cast_precision_loss, reason = "a small seed")]
        let direction = 2.399_963 * f64::from(n) + seed as f64;
        for (axis, shift) in [("x", libm::cos(direction)), ("y", libm::sin(direction))] {
            object[axis] = json!(object[axis].as_f64().unwrap() + NOISE * shift);
        }
    }
    body
}

fn with_settings(mut body: Value, settings: Value) -> Value {
    body["settings"] = settings;
    body
}

fn read(body: &Value) -> Result<PlanRequest, String> {
    read_scene(body.to_string().as_bytes(), &RequestLimits::default()).map_err(|problem| problem.to_string())
}

fn planned(request: &PlanRequest) -> Judged {
    plan_by(&request.methods, &request.scene, &request.settings, &Budget::unlimited(), SILENT).unwrap()
}

/// What the answer states, once it has passed the checker as it is served.
fn answered(request: &PlanRequest, named: &str) -> Statement {
    let judged = planned(request);
    let served = serde_json::to_vec(&AnswerBody::new(request, &judged)).unwrap();
    let stated = read_plan(&served, &request.scene, false).unwrap();
    assert_eq!(check(&request.scene, &stated, &Budget::unlimited()).faults, [], "{named}");
    judged.answer.statement
}

/// Carries the steps out with nothing but distances: each object comes to stand the margin away from all others, so that no
/// pair overlaps deeper than it did.
fn keeps_apart(scene: &Scene, steps: &[Step], named: &str) {
    let mut discs: Vec<Footprint> = scene.objects().iter().map(|object| object.footprint().clone()).collect();
    for step in steps.iter().filter_map(Step::pick_place) {
        let at = scene.find(&step.object).unwrap().get();
        assert_eq!(Some(discs[at].at().into()), step.from, "{named}");
        discs[at] = discs[at].moved_to(step.to.into());
        let others = discs.iter().enumerate().filter(|(other, _)| *other != at);
        let least = others.map(|(_, other)| discs[at].gap(other)).fold(f64::INFINITY, f64::min);
        assert!(least >= scene.gripper().margin() - 1e-9, "{named}: {least}");
    }
}

fn verdict(stated: &Statement) -> &'static str {
    match stated.verdict.unwrap() {
        Verdict::TimedOut => unreachable!("the budget never ends"),
        verdict => verdict.as_str(),
    }
}

#[test]
fn noise_of_three_millimetres_is_planned_for_where_the_cell_says_so() {
    let (mut refused, mut verdicts) = (0, BTreeMap::<&str, u64>::new());
    for seed in 0..200 {
        let (body, named) = (noisy(seed), format!("seed {seed}"));
        refused += usize::from(read(&body).is_err_and(|problem| problem.contains("(overlap)")));
        for objective in ["far_from_target", "short_moves"] {
            let settings = json!({"overlap_tolerance": 2.0 * NOISE, "objective": objective});
            let request = read(&with_settings(body.clone(), settings)).unwrap();
            let stated = answered(&request, &named);
            keeps_apart(&request.scene, stated.steps(), &named);
            *verdicts.entry(verdict(&stated)).or_default() += 1;
        }
    }
    assert!(refused > 50, "{refused}");
    assert!(["graspable", "relocate", "deadlock"].iter().all(|name| verdicts[name] > 20), "{verdicts:?}");
}

#[test]
fn noise_as_deep_as_the_service_admits_is_surveyed_and_answered_by_every_method() {
    for seed in 0..40 {
        let named = format!("seed {seed}");
        for (grasp_model, search, placement) in
            [("swept_finger", "lobs", "exact"), ("sector", "landmarks", "exact"), ("sector", "lobs", "raster")]
        {
            let settings = json!({"overlap_tolerance": 0.01, "grasp_model": grasp_model, "search": search,
                "placement": placement});
            let request = read(&with_settings(noisy(seed), settings)).unwrap();
            planned(&request);
            assert!(!survey(&request.scene, &Budget::unlimited()).unwrap().is_empty(), "{named}");
        }
    }
}

/// A rack of `count` discs behind a cup with a plate on either side and one in front.
fn behind(count: u32, pitch: f64) -> Value {
    let disc = |id: &str, x: f64, y: f64, radius: f64| json!({"id": id, "x": x, "y": y, "radius": radius});
    let plates =
        [("left", 0.3, 0.33), ("right", 0.5, 0.33), ("front", 0.4, 0.25)].map(|(id, x, y)| disc(id, x, y, 0.05));
    let mut objects = vec![disc("cup", 0.4, 0.35, 0.04)];
    objects.extend(plates);
    for n in 0..count {
        let mut rack = disc(&format!("rack-{n}"), 0.1 + pitch * f64::from(n), 0.46, 0.03);
        rack["fixed"] = json!(true);
        objects.push(rack);
    }
    json!({
        "table": {"x_min": 0, "y_min": 0, "x_max": 0.8, "y_max": 0.5},
        "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
        "objects": objects,
        "target": "cup"
    })
}

#[test]
fn a_rack_is_a_row_of_fixed_discs_that_overlap() {
    for (count, pitch) in [(22, 0.03), (22, 0.0), (200, 0.003)] {
        for objective in ["far_from_target", "short_moves"] {
            let body = with_settings(behind(count, pitch), json!({"objective": objective}));
            let request = read(&body).unwrap();
            assert_eq!(request.warnings, []);
            let stated = answered(&request, &format!("{count} discs {pitch} m apart"));
            keeps_apart(&request.scene, stated.steps(), objective);
        }
    }
    let rack = read(&behind(22, 0.03)).unwrap();
    assert_eq!(verdict(&answered(&rack, "a rack")), "relocate");
}
