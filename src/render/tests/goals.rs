//! Goals, and hands that do not span everything.

use super::rows::{GRASP, THREE, all, any, drawn, dropped, groups, number, placed, plan, row, sound};
use super::*;
use crate::experiments::{varied, wanting};
use singulate_planner::budget::Budget;
use singulate_planner::plan::{Settings, plan as planned};
use singulate_planner::scene::{Destination, Opening};
use singulate_planner::search::SILENT;

#[test]
fn the_chosen_candidate_is_marked_as_a_target_and_the_others_as_candidates() {
    let scene = sound(row(THREE, any(&["a", "c"]), &[]));
    let chosen = Statement {
        target: Some("c".into()),
        target_grasp: Some(GRASP),
        ..plan(Verdict::Relocate, vec![placed(&scene, 1)])
    };
    let drawing = drawn(&scene, chosen);
    assert_eq!((groups(&drawing, "object target").len(), groups(&drawing, "object candidate").len()), (1, 1));
    assert!(groups(&drawing, "object target")[0].contains("<title>c</title>"), "{drawing}");
    assert_eq!(groups(&drawing, "fingers target-grasp").len(), 1);
    assert!(drawing.contains("other candidate"));
    let unknown = drawn(&scene, Statement::timed_out());
    assert_eq!((groups(&unknown, "object target").len(), groups(&unknown, "object candidate").len()), (2, 0));
    assert!(unknown.contains("one of these is wanted") && !unknown.contains("other candidate"));
}

#[test]
fn what_is_wanted_away_is_gold_where_it_stood_and_where_it_stays() {
    let scene = sound(row(THREE, all(&["a", "c"]), &[("tray", None, None)]));
    let drawing = drawn(&scene, plan(Verdict::Relocate, vec![dropped(&scene, 1, "tray"), dropped(&scene, 2, "tray")]));
    assert_eq!(drawing.matches(paint::GHOST_OF_WANTED.fill).count(), 1, "b is not wanted");
    assert_eq!(groups(&drawing, "object target").len(), 1);
}

/// A scene with everything that a clearing may leave, and its answer: d is taken away.
fn partly() -> (Scene, Statement) {
    let objects = [
        ("a", 0.08),
        ("b", 0.08),
        ("c", 0.08),
        ("d", 0.08),
        ("wide", 0.15),
        ("fixed", 0.08),
        ("odd", 0.08),
        ("e", 0.08),
    ];
    let accepted = &["a", "b", "c", "d", "e", "wide"][..];
    let mut draft =
        row(&objects, GoalDraft::Clear, &[("tray", Some(1.0), Some(accepted)), ("bin", None, Some(&["e"]))]);
    draft.gripper.max_opening = Some(0.2);
    let scene = sound(draft);
    let stated = Statement {
        stuck: Some(Deadlock { blocked: ids(&scene, &[0, 1]), core: ids(&scene, &[0]) }),
        left: Some(ids(&scene, &[0, 1, 2, 4, 6, 7])),
        proven: Some(true),
        ..plan(Verdict::PartlyCleared, vec![dropped(&scene, 3, "tray")])
    };
    (scene, stated)
}

#[test]
fn what_a_clearing_leaves_shows_why() {
    let (scene, stated) = partly();
    let drawing = drawn(&scene, stated);
    let twice = [
        paint::CORE.fill,
        paint::BLOCKED.fill,
        paint::NO_ROOM.fill,
        paint::NOT_REACHED.fill,
        paint::TOO_WIDE.fill,
        paint::NOT_ACCEPTED.fill,
    ];
    for fill in twice {
        assert_eq!(drawing.matches(&format!("fill=\"{fill}\"")).count(), 2, "{fill}: one object and the legend");
    }
    for hatch in ["too-wide", "not-accepted"] {
        assert!(drawing.contains(&format!("<pattern height=\"5\" id=\"{hatch}\"")), "{hatch}: {drawing}");
    }
    for title in
        ["c: no room in a drop-off", "wide: too wide for the hand", "odd: accepted by no drop-off", "e: not reached"]
    {
        assert!(drawing.contains(title), "{title}");
    }
}

#[test]
fn what_is_too_wide_is_seen_in_a_lock_too() {
    let mut draft = row(&[("a", 0.08), ("wide", 0.15), ("fixed", 0.08)], GoalDraft::Clear, &[("tray", None, None)]);
    draft.gripper.max_opening = Some(0.2);
    let scene = sound(draft);
    let lock = Some(Deadlock { blocked: ids(&scene, &[0, 1, 2]), core: ids(&scene, &[0, 1, 2]) });
    let left = Some(ids(&scene, &[0, 1]));
    let drawing = drawn(&scene, Statement { stuck: lock, left, ..plan(Verdict::PartlyCleared, Vec::new()) });
    let circles = drawing.split("<circle ").skip(1).map(|rest| rest.split("/>").next().unwrap());
    let rings: Vec<&str> = circles.filter(|circle| circle.contains("fill=\"none\"")).collect();
    let count = |line: &str| rings.iter().filter(|ring| ring.contains(&format!("stroke=\"{line}\""))).count();
    // The wide and the fixed object; the others are in the legend.
    assert_eq!((count(paint::TOO_WIDE_HATCH), count(paint::CORE.line)), (1, 1), "{rings:?}");
}

#[test]
fn fingers_that_open_fully_reach_as_far_at_a_small_object() {
    let mut draft = row(THREE, GoalDraft::Target("a".into()), &[]);
    draft.gripper = GripperDraft { max_opening: Some(0.3), opening: Some(Opening::Full), ..draft.gripper };
    let scene = sound(draft);
    let stated = Statement { target_grasp: Some(GRASP), ..plan(Verdict::Graspable, Vec::new()) };
    let view = View::new(&scene, &stated, &Roles::new(&scene, &stated), 0.0);
    // From the object's edge to half the opening and the clearance.
    let corners = [(0.28, 0.29), (0.4, 0.29), (0.4, 0.31), (0.28, 0.31)].map(|(x, y)| view.point(Point2::new(x, y)));
    assert!(drawn(&scene, stated).contains(&paint::points(corners)));
}

#[test]
fn the_lines_above_end_above_the_table() {
    let (scene, stated) = partly();
    let judged = answer(stated);
    let (roles, lines) = (Roles::new(&scene, judged.statement()), Lines::new(&scene, &judged));
    let view = View::new(&scene, judged.statement(), &roles, lines.added);
    let drawn = lines.drawn(&view).to_string();
    assert_eq!(drawn.matches("<text").count(), 5, "{drawn}");
    let last = number(drawn.rsplit_once("<text").unwrap().1, "y");
    assert!(last < view.frame().1, "{last} is not above {}", view.frame().1);
}

#[test]
fn a_scene_where_all_leaves_the_table_shows_what_can_not() {
    let mut draft = row(THREE, any(&["a", "b"]), &[("bin", None, Some(&[]))]);
    draft.destination = Some(Destination::DropOff);
    let drawing = drawn(&sound(draft), Statement::timed_out());
    // Candidates are only grasped: no drop-off has to accept them.
    assert_eq!(drawing.matches(&format!("fill=\"{}\"", paint::NOT_ACCEPTED.fill)).count(), 2);
    assert_eq!(groups(&drawing, "object target").len(), 2);
    let says = |id: &str| drawing.contains(&format!("<title>{id}: accepted by no drop-off</title>"));
    assert_eq!(["a", "b", "c"].map(says), [false, false, true]);
}

#[test]
fn the_answer_to_any_goal_is_drawn_the_same_each_time() {
    let mut verdicts = std::collections::HashMap::new();
    for seed in 0..120 {
        let (scene, _) = Scene::new(wanting(&varied(seed), seed), &SceneLimits::default()).unwrap();
        let planned = planned(&scene, &Settings::default(), &Budget::unlimited(), SILENT).unwrap();
        *verdicts.entry(planned.statement.verdict_name()).or_insert(0) += 1;
        let judged = Judged::from(planned);
        let drawing = svg(&scene, &judged);
        parse(&drawing);
        assert!(!drawing.contains("NaN") && !drawing.contains("inf"), "{seed}");
        let dropped = judged.statement().steps().iter().filter(|step| step.rests_at().is_none()).count();
        let steps = judged.statement().steps().len() - dropped + dropped.min(100);
        assert_eq!(groups(&drawing, "route").len(), steps, "{seed}");
        assert!(drawing == svg(&scene, &judged), "{seed}");
    }
    for verdict in ["graspable", "relocate", "deadlock", "cleared", "partly_cleared"] {
        assert!(verdicts.contains_key(verdict), "{verdicts:?}");
    }
}
