//! Goals, drop-offs and openings: answers that hold with one thing made wrong, each caught for that thing.

use singulate_planner::budget::Budget;
use singulate_planner::check::FaultCode::{self, *};
use singulate_planner::cost::Cost;
use singulate_planner::plan::{Settings, plan};
use singulate_planner::scene::{Destination, GoalDraft, Opening, Scene};
use singulate_planner::search::SILENT;
use singulate_planner::statement::{Deadlock, PickDrop, StatedGrasp, Statement, Step, Verdict};

use super::scenes::*;

fn posts() -> Builder {
    gate().fix("north").fix("south")
}

fn named(ids: &[&str]) -> Vec<Option<String>> {
    ids.iter().map(|id| Some((*id).to_owned())).collect()
}

/// A tray for three objects and a box for two of them, so that all five that are not fixed have room.
fn served_by(builder: Builder) -> Builder {
    builder.drop_off("tray", Some(3), None).drop_off("box", None, Some(&["east", "far"]))
}

fn planned(scene: &Scene) -> Statement {
    let stated = plan(scene, &Settings::default(), &Budget::unlimited(), SILENT).unwrap().statement;
    assert_valid(scene, &stated);
    stated
}

fn cleared() -> (Scene, Statement) {
    let scene = served_by(posts()).wanting(GoalDraft::Clear);
    let stated = planned(&scene);
    assert_eq!((stated.verdict, stated.steps().len()), (Some(Verdict::Cleared), 5));
    (scene, stated)
}

fn position(stated: &Statement, object: &str) -> usize {
    stated.steps().iter().position(|step| step.object() == object).unwrap()
}

fn steps(stated: &mut Statement) -> &mut Vec<Step> {
    stated.relocations.as_mut().unwrap()
}

fn drop_mut<'a>(stated: &'a mut Statement, object: &str) -> &'a mut PickDrop {
    let at = position(stated, object);
    match &mut steps(stated)[at] {
        Step::PickDrop(step) => step,
        Step::PickPlace(_) => panic!("'{object}' is put aside"),
    }
}

#[track_caller]
fn caught(scene: &Scene, stated: &Statement, expected: &[FaultCode]) {
    let report = judge(scene, stated);
    assert_eq!(codes(&report), expected, "{:#?}", report.faults);
}

#[track_caller]
fn mutant(mutate: impl FnOnce(&mut Statement), expected: &[FaultCode]) {
    let (scene, mut stated) = cleared();
    mutate(&mut stated);
    caught(&scene, &stated, expected);
}

#[test]
fn an_object_that_goes_before_what_is_in_its_way_is_seen() {
    mutant(
        |stated| {
            let (cap, west) = (position(stated, "cap"), position(stated, "west"));
            assert!(cap < west);
            steps(stated).swap(cap, west);
        },
        &[GraspBlocked],
    );
}

#[test]
fn an_object_that_is_missing_is_seen() {
    mutant(
        |stated| {
            steps(stated).pop();
        },
        &[WrongCost, WrongLeft, WrongVerdict, WrongProven],
    );
}

#[test]
fn a_drop_off_that_is_full_unknown_or_does_not_accept_is_seen() {
    mutant(|stated| drop_mut(stated, "cap").drop_off = "box".into(), &[NotAccepted]);
    mutant(|stated| drop_mut(stated, "cap").drop_off = "shelf".into(), &[UnknownDropOff]);
    mutant(
        |stated| {
            for object in ["cap", "west", "far", "target"] {
                drop_mut(stated, object).drop_off = "tray".into();
            }
        },
        &[OverCapacity],
    );
}

#[test]
fn what_is_gone_can_not_go_again() {
    mutant(
        |stated| {
            let again = stated.steps()[0].clone();
            steps(stated).push(again);
            stated.cost = None;
        },
        &[AlreadyGone],
    );
}

#[test]
fn nothing_is_put_aside_in_a_clearing() {
    mutant(
        |stated| {
            let far = position(stated, "far");
            steps(stated)[far] = step("far", [1.7, 1.3], 0.0, 0.0);
        },
        &[WrongDestination, WrongLeft, WrongVerdict, WrongProven],
    );
}

#[test]
fn an_object_wider_than_the_hand_is_not_lifted() {
    let (_, stated) = cleared();
    let narrow = served_by(posts()).opening(0.2, Opening::Fit).wanting(GoalDraft::Clear);
    let parts = Statement { relocations: stated.relocations, ..Statement::default() };
    // Where a wide object stays, others are blocked.
    assert!(codes(&judge(&narrow, &parts)).contains(&TooWide));
    let stated = planned(&narrow);
    assert_eq!(stated.left, Some(ids(&["target", "west", "east"])));
}

#[test]
fn the_end_of_a_clearing_is_compared_with_the_table() {
    mutant(|stated| stated.verdict = Some(Verdict::PartlyCleared), &[WrongVerdict]);
    mutant(|stated| stated.verdict = Some(Verdict::Relocate), &[WrongVerdict]);
    mutant(|stated| stated.left = Some(ids(&["far"])), &[WrongLeft]);
    mutant(|stated| stated.left = Some(ids(&["nobody"])), &[UnknownObject]);
    mutant(|stated| stated.proven = Some(false), &[]);
    mutant(|stated| stated.cost = Some(Cost::new(4)), &[WrongCost]);
    mutant(|stated| stated.lower_bound = Some(Cost::new(5)), &[UnexpectedPart, BoundUnproven]);
    mutant(|stated| stated.needed = Some(Vec::new()), &[UnexpectedPart]);
}

#[test]
fn an_order_that_takes_more_away_refutes_the_proof() {
    let scene = posts().drop_off("tray", Some(1), None).wanting(GoalDraft::Clear);
    let stated = planned(&scene);
    assert_eq!((stated.steps().len(), stated.proven), (1, Some(true)));
    let idle = Statement {
        relocations: Some(Vec::new()),
        left: Some(ids(&["target", "west", "east", "cap", "far"])),
        cost: Some(Cost::ZERO),
        ..stated
    };
    caught(&scene, &idle, &[WrongProven]);
    caught(&scene, &Statement { proven: Some(false), ..idle }, &[]);
}

/// `north` and `south` are taken away only when `west` and `east` are; a tray that takes three of them leaves one choice.
#[test]
fn a_choice_that_is_too_greedy_is_seen() {
    let far = || posts().drop_off("box", Some(1), Some(&["west"])).drop_off("tray", Some(1), Some(&["cap", "far"]));
    let scene = far().wanting(GoalDraft::Clear);
    let stated = planned(&scene);
    let order: Vec<&str> = stated.steps().iter().map(Step::object).collect();
    assert_eq!((order, stated.proven), (vec!["cap", "west"], Some(true)));
    let greedy = Statement {
        relocations: Some(vec![Step::PickDrop(PickDrop {
            object: "far".into(),
            from: None,
            grasp: grasp(0.0, 1.0),
            drop_off: "tray".into(),
        })]),
        left: Some(ids(&["target", "west", "east", "cap"])),
        cost: None,
        ..stated
    };
    caught(&scene, &greedy, &[WrongProven]);
}

#[test]
fn a_lock_of_what_is_stuck_is_checked_like_a_deadlock() {
    let scene = gate().fix("cap").fix("south").fix("north").fix("east").drop_off("tray", None, None);
    let scene = scene.wanting(GoalDraft::Clear);
    let stated = planned(&scene);
    let lock = stated.stuck.clone().unwrap();
    assert_eq!((stated.left.as_deref(), stated.proven), (Some(&ids(&["target", "west"])[..]), Some(true)));
    let with = |stuck: Option<Deadlock>| Statement { stuck, ..stated.clone() };
    let free = Deadlock { core: ids(&["far"]), blocked: [lock.blocked.clone(), ids(&["far"])].concat() };
    caught(&scene, &with(Some(free)), &[LockMemberFree, ProvenUnconfirmed]);
    let fixed = Deadlock { core: ids(&["cap"]), blocked: ids(&["cap"]) };
    caught(&scene, &with(Some(fixed)), &[LockWithoutTarget, ProvenUnconfirmed]);
    // Without its lock the proof is found by trying every order.
    caught(&scene, &with(None), &[]);
}

fn taken_away(destination: Destination) -> (Scene, Statement) {
    let goal = GoalDraft::AllOf(named(&["far", "east"]));
    let scene = posts().drop_off("tray", None, None).destination(destination).wanting(goal);
    let stated = planned(&scene);
    assert_eq!((stated.verdict, stated.cost), (Some(Verdict::Relocate), Some(Cost::new(2))));
    (scene, stated)
}

#[test]
fn an_object_that_is_wanted_away_and_left_is_seen() {
    let (scene, stated) = taken_away(Destination::Table);
    let far = position(&stated, "far");
    let mut without = stated.clone();
    steps(&mut without).remove(far);
    (without.cost, without.lower_bound, without.optimal, without.landmarks) = (None, None, None, None);
    caught(&scene, &without, &[WantedLeft]);
    steps(&mut without).insert(far, step("far", [1.7, 1.3], 0.0, 0.0));
    caught(&scene, &without, &[WantedLeft]);
    caught(
        &scene,
        &Statement { verdict: Some(Verdict::Graspable), ..stated },
        &[WrongVerdict, UnexpectedPart, WrongCost],
    );
}

#[test]
fn the_destination_is_kept() {
    let (scene, mut stated) = taken_away(Destination::Table);
    let cap = PickDrop { object: "cap".into(), from: None, grasp: grasp(0.64, 0.0), drop_off: "tray".into() };
    steps(&mut stated).push(Step::PickDrop(cap));
    stated.cost = None;
    (stated.optimal, stated.lower_bound) = (None, None);
    caught(&scene, &stated, &[WrongDestination]);
    let (either, _) = taken_away(Destination::TableThenDropOff);
    caught(&either, &stated, &[]);

    let (scene, mut stated) = taken_away(Destination::DropOff);
    steps(&mut stated).push(step("cap", [1.7, 0.3], 0.64, 0.0));
    stated.cost = None;
    (stated.optimal, stated.lower_bound) = (None, None);
    caught(&scene, &stated, &[WrongDestination]);
}

#[test]
fn a_landmark_of_what_is_wanted_away_holds() {
    let (scene, stated) = taken_away(Destination::Table);
    assert_eq!(stated.lower_bound, Some(Cost::new(2)));
    let with = |landmarks: &[&[&str]]| Statement {
        landmarks: Some(landmarks.iter().map(|set| ids(set)).collect()),
        ..stated.clone()
    };
    caught(&scene, &with(&[&["far"], &["east"]]), &[]);
    caught(&scene, &with(&[&["far"], &["cap"]]), &[LandmarkRefuted, BoundUnproven]);
}

#[test]
fn one_of_several_candidates_is_named_and_all_are_bounded() {
    let scene = posts().wanting(GoalDraft::AnyOf(named(&["target", "west"])));
    let stated = planned(&scene);
    assert_eq!((stated.target.as_deref(), stated.cost), (Some("west"), Some(Cost::new(1))));
    caught(&scene, &Statement { target: None, ..stated.clone() }, &[MissingPart]);
    caught(&scene, &Statement { target: Some("nobody".into()), ..stated.clone() }, &[UnknownObject]);
    caught(&scene, &Statement { target: Some("target".into()), ..stated.clone() }, &[WrongAxis, TargetBlocked]);
    caught(&scene, &Statement { target: Some("cap".into()), ..stated.clone() }, &[WrongTarget]);
    let with = |set: &[&str]| Statement { landmarks: Some(vec![ids(set)]), ..stated.clone() };
    // What holds for one candidate alone proves nothing.
    caught(&scene, &with(&["east"]), &[LandmarkRefuted, BoundUnproven]);
    caught(&scene, &with(&["west"]), &[BadLandmark, BoundUnproven]);
}

#[test]
fn a_lock_holds_every_candidate() {
    let scene = gate().fix("cap").fix("south").fix("north").fix("east");
    let scene = scene.wanting(GoalDraft::AnyOf(named(&["target", "west"])));
    let stated = planned(&scene);
    assert_eq!((stated.verdict, stated.target.as_deref()), (Some(Verdict::Deadlock), None));
    let mut thinner = stated.clone();
    thinner.deadlock.as_mut().unwrap().core.retain(|id| id != "target");
    caught(&scene, &thinner, &[LockWithoutTarget, LockMemberFree]);
}

#[test]
fn a_hand_that_always_opens_all_the_way_meets_more() {
    let table = || Builder::new(2).disc("cup", 1.0, 1.0, 0.05).disc("can", 1.22, 1.0, 0.05);
    let along_x = Statement {
        verdict: Some(Verdict::Graspable),
        target_grasp: Some(StatedGrasp { at: None, yaw: 0.0, slack: None }),
        ..Statement::default()
    };
    caught(&table().opening(0.3, Opening::Fit).build("cup"), &along_x, &[]);
    // The fingers reach 0.15 + 0.05 m from the axis, the can begins at 0.17 m.
    caught(&table().opening(0.3, Opening::Full).build("cup"), &along_x, &[TargetBlocked]);
    caught(&table().opening(0.22, Opening::Full).build("cup"), &along_x, &[]);
}
