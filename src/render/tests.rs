//! The drawing, read as XML.

mod goals;
mod rows;
mod shapes;
mod trays;
mod words;

use core::f64::consts::PI;

use nalgebra::Point2;

use super::*;
use crate::experiments::Recipe;
use singulate_planner::check::{Fault, FaultCode};
use singulate_planner::cost::Cost;
use singulate_planner::paper::Warning;
use singulate_planner::plan::{Answer, Statistics};
use singulate_planner::scene::{
    GoalDraft, GripperDraft, ObjectDraft, RectangleDraft, SceneDraft, SceneLimits, ShapeDraft, TableDraft, distance,
};
use singulate_planner::statement::{Deadlock, PickPlace, StatedGrasp, Step, Verdict};

fn rectangle(x_min: f64, y_min: f64, x_max: f64, y_max: f64) -> RectangleDraft {
    RectangleDraft { x_min: Some(x_min), y_min: Some(y_min), x_max: Some(x_max), y_max: Some(y_max) }
}

/// Objects `ids` in rows; the first one is the target, the last one is fixed.
fn scene(ids: &[&str]) -> Scene {
    let object = |(at, id): (usize, &&str)| ObjectDraft {
        id: Some((*id).to_owned()),
        x: Some(0.2 + 0.2 * (at % 100) as f64),
        y: Some(0.2 + 0.2 * (at / 100) as f64),
        shape: ShapeDraft::disc(0.08),
        fixed: at > 0 && at + 1 == ids.len(),
        ..ObjectDraft::default()
    };
    let draft = SceneDraft {
        table: TableDraft { top: rectangle(0.0, 0.0, 21.0, 21.0), keep_out: vec![rectangle(0.0, 0.0, 0.1, 0.1)] },
        gripper: Recipe::default().gripper,
        objects: ids.iter().enumerate().map(object).collect(),
        goal: Some(GoalDraft::Target(ids[0].to_owned())),
        ..SceneDraft::default()
    };
    Scene::new(draft, &SceneLimits::default()).unwrap().0
}

fn answer(statement: Statement) -> Judged {
    Answer { statement, statistics: Statistics::default() }.into()
}

fn ids(scene: &Scene, positions: &[usize]) -> Vec<String> {
    positions.iter().map(|&at| scene.objects()[at].id().to_owned()).collect()
}

fn graspable(slack: f64) -> Judged {
    let target_grasp = Some(StatedGrasp { at: None, yaw: 0.0, slack: Some(slack) });
    answer(Statement { verdict: Some(Verdict::Graspable), target_grasp, ..Statement::timed_out() })
}

fn locked(scene: &Scene, blocked: &[usize], core: &[usize]) -> Judged {
    let deadlock = Some(Deadlock { blocked: ids(scene, blocked), core: ids(scene, core) });
    answer(Statement { verdict: Some(Verdict::Deadlock), deadlock, ..Statement::default() })
}

fn relocate(scene: &Scene, moved: &[usize]) -> Judged {
    let grasp = StatedGrasp { at: None, yaw: 0.5, slack: Some(0.1) };
    let step = |object: &usize| {
        let object = &scene.objects()[*object];
        let from = object.footprint().at();
        Step::PickPlace(PickPlace {
            object: object.id().to_owned(),
            from: Some(from.into()),
            to: Point2::new(from.x, 1.0).into(),
            grasp,
            release: grasp,
            turn: None,
            gap: Some(0.01),
        })
    };
    let cost = Some(Cost::of_each(moved.len()));
    answer(Statement {
        verdict: Some(Verdict::Relocate),
        relocations: Some(moved.iter().map(step).collect()),
        target_grasp: Some(grasp),
        cost,
        lower_bound: cost,
        optimal: Some(true),
        landmarks: Some(Vec::new()),
        ..Statement::default()
    })
}

/// Panics if the text is not well-formed XML: tags nest, attributes are quoted, `<` and `&` are escaped.
fn parse(xml: &str) {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = xml;
    while let Some(start) = rest.find('<') {
        characters(&rest[..start]);
        let end = start + rest[start..].find('>').expect("a tag ends");
        let tag = &rest[start + 1..end];
        rest = &rest[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name));
            continue;
        }
        let parts: Vec<&str> = tag.split('"').collect();
        assert!(parts.len() % 2 == 1, "unquoted attribute in {tag}");
        parts.iter().skip(1).step_by(2).for_each(|value| characters(value));
        if !tag.ends_with('/') {
            open.push(tag.split_whitespace().next().unwrap());
        }
    }
    characters(rest);
    assert!(open.is_empty(), "{open:?} stay open");
}

fn characters(text: &str) {
    assert!(!text.contains('<') && text.chars().all(|c| c >= ' ' || c == '\n'), "{text:?}");
    for entity in text.split('&').skip(1) {
        let name = entity.split(';').next().unwrap();
        assert!(["amp", "lt", "gt", "quot", "apos"].contains(&name), "a bare & in {text:?}");
    }
}

#[test]
fn an_answer_that_does_not_pass_its_check_says_so() {
    let fault =
        Fault { code: FaultCode::TargetBlocked, step: None, object: Some("o0".into()), detail: "a finger".into() };
    let faulty = Judged { warnings: vec![Warning::Faulty(fault)], ..graspable(0.1) };
    let drawing = svg(&scene(&["o0"]), &faulty);
    assert!(drawing.contains("does not pass its check") && drawing.contains("warnings: target_blocked"));
}

#[test]
fn an_id_is_text_and_never_mark_up() {
    let scene = scene(&[r#"<a&"b>"#, "]]>", "<script>", "bell\u{7}\u{0}\u{ffff}", "o'5"]);
    for answer in [
        relocate(&scene, &[1, 2, 3]),
        graspable(PI / 3.0),
        locked(&scene, &[0, 1, 2, 4], &[0, 2]),
        answer(Statement {
            verdict: Some(Verdict::NoSpace),
            needed: Some(ids(&scene, &[3, 1])),
            ..Statement::timed_out()
        }),
        answer(Statement::timed_out()),
    ] {
        let drawing = svg(&scene, &answer);
        parse(&drawing);
        assert!(drawing.contains("&lt;a&amp;") && !drawing.contains("<script"));
        assert!(!drawing.contains(['\u{7}', '\u{0}', '\u{ffff}']));
    }
}

#[test]
fn every_relocation_is_one_group_with_a_ghost_and_fingers_at_both_places() {
    let scene = scene(&["t", "a", "b", "c"]);
    let drawing = svg(&scene, &relocate(&scene, &[2, 1]));
    assert_eq!(drawing.matches(r#"class="relocation""#).count(), 2);
    assert_eq!(drawing.matches(r#"class="fingers""#).count(), 4);
    assert_eq!(drawing.matches(r#"class="fingers target-grasp""#).count(), 1);
    assert!(drawing.contains("relocate 2 objects (proven least)") && drawing.contains("in order: b, a"));
}

#[test]
fn the_core_of_a_deadlock_is_red_and_the_rest_of_it_pale() {
    let scene = scene(&["t", "a", "b", "c", "d"]);
    let drawing = svg(&scene, &locked(&scene, &[0, 1, 2], &[0, 2]));
    // One more for the legend.
    assert_eq!(drawing.matches(paint::CORE.fill).count(), 3);
    assert_eq!(drawing.matches(paint::BLOCKED.fill).count(), 2);
    assert!(drawing.contains("deadlock: 2 objects hold each other"));
}

#[test]
fn the_same_answer_gives_the_same_bytes() {
    let scene = scene(&["t", "a", "b", "c"]);
    let answer = relocate(&scene, &[1, 2]);
    assert_eq!(svg(&scene, &answer), svg(&scene, &answer));
}

#[test]
fn ids_are_left_out_where_they_could_not_be_read() {
    let ids: Vec<String> = (0..10_000).map(|n| format!("o{n}")).collect();
    let ids: Vec<&str> = ids.iter().map(String::as_str).collect();
    let large = svg(&scene(&ids), &answer(Statement::timed_out()));
    assert!(large.len() < 4_000_000, "{} bytes", large.len());
    assert!(large.matches("<text").count() < 20);
}

#[test]
fn the_fingers_are_where_the_gripper_puts_them() {
    let scene = scene(&["t", "a"]);
    let answer = graspable(0.1);
    let stated = &answer.answer.statement;
    let view = View::new(&scene, stated, &Roles::new(&scene, stated), 0.0);
    let drawing = svg(&scene, &answer);
    // Finger 0 points along +x: from r to r + c, half a width to both sides.
    let corners = [(0.28, 0.19), (0.33, 0.19), (0.33, 0.21), (0.28, 0.21)].map(|(x, y)| view.point(Point2::new(x, y)));
    assert!(drawing.contains(&paint::points(corners)));
    assert!((distance(corners[0], corners[1]) - view.length(0.05)).abs() < 1e-9);
}

#[test]
fn a_tiny_or_a_lopsided_table_gives_finite_numbers() {
    for (width, height) in [(1e-3, 1e-3), (2e5, 1e-3), (1e-3, 2e5)] {
        let draft = SceneDraft {
            table: TableDraft {
                top: rectangle(-width / 2.0, -height / 2.0, width / 2.0, height / 2.0),
                keep_out: vec![],
            },
            gripper: GripperDraft {
                fingers: Some(2.0),
                finger_width: Some(1e-6),
                clearance: Some(1e3),
                margin: Some(0.0),
                yaw_tolerance: Some(0.0),
                ..GripperDraft::default()
            },
            objects: vec![ObjectDraft {
                id: Some("t".to_owned()),
                x: Some(0.0),
                y: Some(0.0),
                shape: ShapeDraft::disc(1e3),
                ..ObjectDraft::default()
            }],
            goal: Some(GoalDraft::Target("t".to_owned())),
            ..SceneDraft::default()
        };
        let scene = Scene::new(draft, &SceneLimits::default()).unwrap().0;
        let drawing = svg(&scene, &graspable(0.1));
        parse(&drawing);
        assert!(!drawing.contains("NaN") && !drawing.contains("inf"));
    }
}
