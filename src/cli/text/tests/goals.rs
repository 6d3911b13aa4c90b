//! Goals, drop-offs, and what a clearing leaves.

use super::*;

/// Four cups, a wide plate and a fixed vase, with this goal, these drop-offs and this destination.
fn request(goal: &str, drop_offs: &str, destination: &str) -> PlanRequest {
    let objects = ["a", "b", "c", "d\\u001b"].iter().enumerate();
    let cup = |(at, id): (usize, &&str)| {
        format!(r#"{{"id": "{id}", "x": {}, "y": 0.5, "radius": 0.05}}, "#, 0.2 + 0.3 * at as f64)
    };
    let objects: String = objects.map(cup).collect();
    let scene = format!(
        r#"{{"table": {{"x_min": 0, "y_min": 0, "x_max": 2, "y_max": 1}},
        "gripper": {{"fingers": 3, "finger_width": 0.02, "clearance": 0.05, "max_opening": 0.15}},
        "objects": [{objects} {{"id": "wide", "x": 1.5, "y": 0.5, "radius": 0.08}},
            {{"id": "vase", "x": 1.8, "y": 0.5, "radius": 0.05, "fixed": true}}],
        {goal}, "drop_offs": {drop_offs}, "settings": {{"destination": "{destination}"}}}}"#
    );
    read_scene(scene.as_bytes(), &RequestLimits::default()).unwrap()
}

fn text(request: &PlanRequest, statement: Statement) -> String {
    let request = PlanRequest { warnings: Vec::new(), ..request.clone() };
    let text = answer(&request, &Answer { statement, statistics: Statistics::default() }.into());
    text.rsplit_once("\n0.00 ms in all").unwrap().0.to_owned()
}

fn placed(id: &str) -> Step {
    let pose = |y| StatedPose::from(Point2::new(0.2, y));
    Step::PickPlace(PickPlace {
        object: id.to_owned(),
        from: Some(pose(0.5)),
        to: pose(0.9),
        grasp: GRASP,
        release: GRASP,
        turn: None,
        gap: Some(0.01),
    })
}

fn dropped(id: &str, drop_off: &str) -> Step {
    let from = Some(Point2::new(0.5, 0.5).into());
    Step::PickDrop(PickDrop { object: id.to_owned(), from, grasp: GRASP, drop_off: drop_off.to_owned() })
}

fn least(steps: Vec<Step>, landmarks: &[&[&str]]) -> Statement {
    let cost = Some(Cost::of_each(steps.len()));
    Statement {
        verdict: Some(Verdict::Relocate),
        relocations: Some(steps),
        cost,
        lower_bound: cost,
        optimal: Some(true),
        landmarks: Some(landmarks.iter().map(|set| names(set)).collect()),
        ..Statement::default()
    }
}

fn names(ids: &[&str]) -> Vec<String> {
    ids.iter().map(|&id| id.to_owned()).collect()
}

#[test]
fn a_plan_that_places_and_drops_shows_both_ends() {
    let request =
        request(r#""goal": {"all_of": ["b", "c"]}"#, r#"[{"id": "tray", "capacity": 4}, {"id": "b\u001b"}]"#, "table");
    let steps = vec![placed("a"), dropped("b", "tray"), dropped("c", "b\u{1b}")];
    let expected = "take away 2 objects in 3 steps (proven least)\n\
                    goal: take away all of b, c\n\
                    drop-offs: tray (1 of 4), b\\u{1b} (1 object)\n\
                    \n\
                    #  object      from (m)           to (m)  drop-off    grasp yaw  release yaw      gap\n\
                    1  a       0.200, 0.500  →  0.200, 0.900            28.6° ±5.7°  28.6° ±5.7°  10.0 mm\n\
                    2  b       0.500, 0.500  →                tray      28.6° ±5.7°\n\
                    3  c       0.500, 0.500  →                b\\u{1b}   28.6° ±5.7°\n\
                    \n\
                    Every plan moves: a, b, c\n\
                    So 3 steps are the least.\n";
    assert_eq!(text(&request, least(steps, &[&["a"], &["b"], &["c"]])), expected);
}

#[test]
fn of_several_candidates_the_chosen_one_is_grasped() {
    let request = request(r#""goal": {"any_of": ["a", "d\u001b", "wide"]}"#, r#"[{"id": "tray"}]"#, "drop_off");
    let stated = Statement {
        target: Some("d\u{1b}".to_owned()),
        target_grasp: Some(GRASP),
        ..least(vec![dropped("b", "tray")], &[&["b", "c"]])
    };
    let expected = "relocate 1 object off the table to reach d\\u{1b}, one of 2 (proven least)\n\
                    goal: any of a, d\\u{1b}\n\
                    drop-offs: tray (1 object)\n\
                    \n\
                    #  object      from (m)     to      grasp yaw\n\
                    1  b       0.500, 0.500  →  tray  28.6° ±5.7°\n\
                    \n\
                    Then grasp d\\u{1b} at yaw 28.6° ±5.7°.\n\
                    \n\
                    Every plan moves at least one of: b, c\n\
                    So 1 step is the least.\n";
    assert_eq!(text(&request, stated.clone()), expected);
    let unproven = text(&request, Statement { lower_bound: None, ..stated });
    assert!(unproven.ends_with("Whether fewer steps suffice is not known.\n"), "{unproven}");
    let free = Statement {
        target: Some("a".to_owned()),
        target_grasp: Some(GRASP),
        verdict: Some(Verdict::Graspable),
        ..Statement::default()
    };
    assert!(text(&request, free).ends_with("\n\nGrasp a at yaw 28.6° ±5.7°.\n"));
}

#[test]
fn a_clearing_tells_what_is_left_and_why() {
    let drop_offs =
        r#"[{"id": "tray", "capacity": 1, "accepts": ["a", "b", "wide"]}, {"id": "bin", "accepts": ["d\u001b"]}]"#;
    let request = request(r#""goal": {"clear": true}"#, drop_offs, "table");
    let lock = Deadlock { blocked: names(&["d\u{1b}", "wide", "vase"]), core: names(&["d\u{1b}", "vase"]) };
    let partly = Statement {
        verdict: Some(Verdict::PartlyCleared),
        relocations: Some(vec![dropped("a", "tray")]),
        left: Some(names(&["b", "c", "d\u{1b}", "wide"])),
        stuck: Some(lock),
        proven: Some(true),
        ..Statement::default()
    };
    let expected = "partly cleared: 1 of 5 objects taken away, no order takes more\n\
                    goal: clear the table\n\
                    drop-offs: tray (1 of 1), bin (empty)\n\
                    \n\
                    #  object      from (m)     to      grasp yaw\n\
                    1  a       0.500, 0.500  →  tray  28.6° ±5.7°\n\
                    \n\
                    why left                 objects\n\
                    locked                   d\\u{1b}\n\
                    no room in a drop-off    b\n\
                    accepted by no drop-off  c\n\
                    too wide for the hand    wide\n\
                    \n\
                    These objects lock each other: at every yaw of each that can be moved, another of them is in the way.\n\
                    \n\
                    object\n\
                    d\\u{1b}\n\
                    vase     fixed\n\
                    \n\
                    Also locked: wide\n\
                    \n\
                    No order takes more away.\n";
    assert_eq!(text(&request, partly.clone()), expected);
    let unproven = Statement { proven: Some(false), stuck: None, ..partly };
    let text = text(&request, unproven);
    assert!(text.contains("\nnot reached              d\\u{1b}\n") && !text.contains("lock each other"), "{text}");
    assert!(text.ends_with("\nWhether an order takes more away is not known.\n"), "{text}");
}

#[test]
fn a_cleared_table_leaves_nothing_to_tell() {
    let request = request(r#""goal": {"clear": true}"#, r#"[{"id": "tray"}]"#, "table");
    let nothing = Statement {
        verdict: Some(Verdict::Cleared),
        relocations: Some(Vec::new()),
        left: Some(Vec::new()),
        proven: Some(true),
        ..Statement::default()
    };
    let expected = "cleared: there is nothing to take away\ngoal: clear the table\ndrop-offs: tray (empty)\n";
    assert_eq!(text(&request, nothing), expected);
}

#[test]
fn a_lock_says_what_its_objects_are_to_the_goal() {
    let drop_offs = r#"[{"id": "tray", "accepts": ["a", "b"]}]"#;
    let member = |goal: &str| {
        let core = names(&["a", "b", "c", "wide", "vase"]);
        let deadlock = Some(Deadlock { blocked: core.clone(), core });
        let request = request(goal, drop_offs, "drop_off");
        let text = text(&request, Statement { verdict: Some(Verdict::Deadlock), deadlock, ..Statement::default() });
        text.split_once("\nobject\n").unwrap().1.to_owned()
    };
    let others = "wide    too wide for the hand\nvase    fixed\n";
    let unaccepted = "c       accepted by no drop-off\n";
    assert_eq!(member(r#""target": "a""#), format!("a       the target\nb\n{unaccepted}{others}"));
    let candidates = member(r#""goal": {"any_of": ["a", "c"]}"#);
    assert_eq!(candidates, format!("a       a candidate\nb\nc       a candidate\n{others}"));
    let wanted = member(r#""goal": {"all_of": ["a", "b"]}"#);
    assert_eq!(wanted, format!("a       wanted\nb       wanted\n{unaccepted}{others}"));
}

#[test]
fn without_room_it_says_for_what_there_is_none() {
    let stated = |target: Option<&str>| Statement {
        verdict: Some(Verdict::NoSpace),
        target: target.map(str::to_owned),
        needed: Some(names(&["b"])),
        ..Statement::timed_out()
    };
    let tray = r#"[{"id": "tray", "capacity": 1}]"#;
    let any = text(&request(r#""goal": {"any_of": ["a", "c"]}"#, tray, "drop_off"), stated(Some("c")));
    assert!(any.contains("\nWould free c, moved in this order: b\n"), "{any}");
    assert!(any.contains("only the objects that were tried do not fit the drop-offs"), "{any}");
    let all = text(&request(r#""goal": {"all_of": ["a", "c"]}"#, tray, "table"), stated(None));
    assert!(all.contains("\nWould reach the goal, moved in this order: b\n"), "{all}");
    assert!(all.contains("only the places that were tried do not suffice"), "{all}");
}

#[test]
fn long_lists_of_ids_and_drop_offs_are_cut_short() {
    let ids: Vec<String> = (0..100).map(|n| format!(r#"{{"id": "slot-{n}"}}"#)).collect();
    let request = request(r#""goal": {"clear": true}"#, &format!("[{}]", ids.join(",")), "table");
    let uncleared = |steps: usize| Statement {
        verdict: Some(Verdict::PartlyCleared),
        relocations: Some((0..steps).map(|at| dropped("a", &format!("slot-{at}"))).collect()),
        left: Some(Vec::new()),
        ..Statement::default()
    };
    assert!(text(&request, uncleared(0)).contains("\ndrop-offs: 100, none used\n"));
    assert!(text(&request, uncleared(2)).contains("\ndrop-offs: slot-0 (1 object), slot-1 (1 object) and 98 more\n"));
    let many = text(&request, uncleared(60));
    assert!(many.contains("slot-39 (1 object) and 60 more\n") && !many.contains("slot-40 ("), "{many}");
}

#[test]
fn only_where_something_is_grasped_in_the_end_that_is_the_last_step() {
    let fault = Fault { code: FaultCode::GraspBlocked, step: Some(1), object: None, detail: "why".to_owned() };
    let report = Report { faults: vec![fault], first_failing_step: Some(1), ..Report::default() };
    let text = |goal: &str| {
        let request = request(goal, r#"[{"id": "tray"}]"#, "table");
        verification(&request.scene, &VerificationBody::new(&report))
    };
    let last = "The grasp of the target counts as the last step.";
    assert!(text(r#""goal": {"any_of": ["a"]}"#).contains(last));
    assert!(text(r#""goal": {"clear": true}"#).ends_with("Plan again: step 2 fails.\n"));
}

#[test]
fn a_survey_with_drop_offs_says_that_it_does_not_count_what_they_take() {
    let scene = request(r#""target": "a""#, r#"[{"id": "tray"}]"#, "table").scene;
    assert!(survey(&scene, &[]).contains("neither places nor how much a drop-off takes"));
}
