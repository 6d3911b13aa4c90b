//! The headline, and the lines below it, word for word.

use super::rows::{DropOff, all, any, dropped, placed, plan, row, sound};
use super::*;
use crate::render::lines::description;
use singulate_planner::scene::Destination;

const FOUR: &[(&str, f64)] = &[("a", 0.08), ("b", 0.08), ("c", 0.08), ("d", 0.08)];
const TRAY: &[DropOff<'_>] = &[("tray", Some(3.0), None)];

fn least(stated: Statement) -> Statement {
    Statement { optimal: Some(true), lower_bound: stated.cost, ..stated }
}

fn words(scene: &Scene, stated: Statement) -> String {
    headline(scene, &answer(stated))
}

#[test]
fn a_plan_says_what_it_is_for_and_what_leaves_the_table() {
    let target = sound(row(FOUR, GoalDraft::Target("a".into()), TRAY));
    let of_target = |steps| words(&target, least(plan(Verdict::Relocate, steps)));
    assert_eq!(of_target(vec![placed(&target, 1)]), "relocate 1 object (proven least)");
    let mixed = vec![placed(&target, 1), dropped(&target, 2, "tray"), placed(&target, 3)];
    assert_eq!(of_target(mixed), "relocate 3 objects, 1 of them off the table (proven least)");
    let both = vec![dropped(&target, 1, "tray"), dropped(&target, 2, "tray")];
    assert_eq!(of_target(both), "relocate 2 objects off the table (proven least)");

    let candidates = sound(row(FOUR, any(&["a", "b", "c"]), &[]));
    let chosen = |stated| Statement { target: Some("c".into()), ..stated };
    let moved = plan(Verdict::Relocate, vec![placed(&candidates, 3)]);
    let text = words(&candidates, chosen(least(moved.clone())));
    assert_eq!(text, "relocate 1 object to reach c, one of 3 (proven least)");
    let unproven = Statement { lower_bound: Some(Cost::ZERO), ..chosen(moved) };
    assert_eq!(words(&candidates, unproven), "relocate 1 object to reach c, one of 3 (not proven least)");
    let free = chosen(plan(Verdict::Graspable, Vec::new()));
    assert_eq!(words(&candidates, free), "graspable: c, one of 3, nothing has to move");

    let wanted = sound(row(FOUR, all(&["a", "b"]), TRAY));
    let away = || vec![dropped(&wanted, 0, "tray"), dropped(&wanted, 1, "tray")];
    let text = words(&wanted, least(plan(Verdict::Relocate, away())));
    assert_eq!(text, "take away 2 objects (proven least)");
    let more = [vec![placed(&wanted, 2)], away()].concat();
    let text = words(&wanted, Statement { lower_bound: Some(Cost::new(2)), ..plan(Verdict::Relocate, more) });
    assert_eq!(text, "take away 2 objects in 3 steps (at least 2 steps are needed)");
}

#[test]
fn without_a_plan_it_says_what_is_not_reached() {
    let lock = |scene: &Scene| Statement {
        verdict: Some(Verdict::Deadlock),
        deadlock: Some(Deadlock { blocked: ids(scene, &[0, 1]), core: ids(scene, &[0, 1]) }),
        ..Statement::default()
    };
    let none = Statement { lower_bound: Some(Cost::new(1)), verdict: Some(Verdict::NoSpace), ..Statement::timed_out() };
    let destination = |destination| Some(destination);
    for (goal, drop_offs, to, deadlock, no_space) in [
        (GoalDraft::Target("a".into()), &[][..], None, "no pick-and-place can free the target", "no place found"),
        (
            GoalDraft::Target("a".into()),
            TRAY,
            None,
            "nothing can free the target",
            "neither a place nor room in a drop-off found",
        ),
        (
            any(&["a", "b"]),
            TRAY,
            destination(Destination::DropOff),
            "none of 2 candidates can be freed",
            "no room in the drop-offs",
        ),
        (
            all(&["a", "b"]),
            TRAY,
            destination(Destination::Table),
            "not all of 2 wanted objects can be taken away",
            "neither a place nor room in a drop-off found",
        ),
        (
            all(&["a"]),
            TRAY,
            None,
            "the wanted object can't be taken away",
            "neither a place nor room in a drop-off found",
        ),
    ] {
        let scene = sound(SceneDraft { destination: to, ..row(FOUR, goal, drop_offs) });
        assert_eq!(words(&scene, lock(&scene)), format!("deadlock: 2 objects hold each other, {deadlock}"));
        let needed = if drop_offs.is_empty() { "at least 1 relocation is needed" } else { "at least 1 step is needed" };
        let expected = format!("no space: {no_space} for what has to move ({needed})");
        assert_eq!(words(&scene, none.clone()), expected);
    }
}

#[test]
fn a_clearing_says_how_many_went_and_whether_more_can() {
    let scene = sound(row(FOUR, GoalDraft::Clear, TRAY));
    let cleared = |steps: usize, left: &[usize], proven| {
        let verdict = if left.is_empty() { Verdict::Cleared } else { Verdict::PartlyCleared };
        let steps = (0..steps).map(|at| dropped(&scene, at, "tray")).collect();
        words(&scene, Statement { left: Some(ids(&scene, left)), proven: Some(proven), ..plan(verdict, steps) })
    };
    assert_eq!(cleared(4, &[], true), "cleared: 4 objects taken away");
    assert_eq!(cleared(1, &[], true), "cleared: 1 object taken away");
    assert_eq!(cleared(0, &[], true), "cleared: there is nothing to take away");
    assert_eq!(cleared(3, &[3], true), "partly cleared: 3 of 4 objects taken away, no order takes more");
    let unproven = "partly cleared: 3 of 4 objects taken away (not proven that no order takes more)";
    assert_eq!(cleared(3, &[3], false), unproven);
}

#[test]
fn the_description_tells_the_order_what_is_left_the_scene_and_the_drop_offs() {
    let objects = [FOUR, &[("wide", 0.15), ("fixed", 0.08)]].concat();
    let bin = ("bin", None, Some(&["a", "wide"][..]));
    let mut draft = row(&objects, GoalDraft::Clear, &[TRAY[0], bin]);
    draft.gripper.max_opening = Some(0.2);
    let scene = sound(draft);
    let steps = vec![dropped(&scene, 1, "tray"), dropped(&scene, 2, "tray"), dropped(&scene, 0, "bin")];
    let stated = Statement {
        stuck: Some(Deadlock { blocked: ids(&scene, &[3]), core: ids(&scene, &[3]) }),
        left: Some(ids(&scene, &[3, 4])),
        proven: Some(true),
        ..plan(Verdict::PartlyCleared, steps)
    };
    let expected = "in order: b, c to tray; a to bin. left: d (locked); wide (too wide for the hand). goal: clear the \
                    table; 6 objects (1 fixed, 1 too wide for the hand); 3 fingers, 20 mm wide, 50 mm clearance, \
                    greatest opening 200 mm. drop-offs: tray (takes 3), bin (accepts 2 of 6)";
    assert_eq!(description(&scene, &answer(stated)), expected);
}

#[test]
fn long_lists_are_cut_short() {
    let ids: Vec<String> = (0..9).map(|n| format!("o{n}")).collect();
    let ids: Vec<&str> = ids.iter().map(String::as_str).collect();
    let objects: Vec<(&str, f64)> = ids.iter().map(|id| (*id, 0.08)).collect();
    let slots: Vec<_> = ids.iter().map(|id| (*id, None, None)).collect();
    let mut draft = row(&objects, any(&ids), &slots);
    draft.destination = Some(Destination::DropOff);
    let text = description(&sound(draft), &answer(Statement::timed_out()));
    let expected = "goal: any of o0, o1, o2, o3, o4, o5 and 3 more; 9 objects; 3 fingers, 20 mm wide, 50 mm clearance. \
                    drop-offs: o0, o1, o2, o3, o4, o5 and 3 more; what is in the way leaves the table";
    assert_eq!(text, expected);
}
