//! Objects that turn, that are grasped off their origin, and that have no grasp.

use core::f64::consts::{FRAC_PI_2, TAU};

use super::*;

/// A cup, a tray that is grasped at its rims, a knife, and a napkin without a grasp.
fn request() -> PlanRequest {
    let scene = r#"{"table": {"x_min": 0, "y_min": 0, "x_max": 2, "y_max": 1},
        "gripper": {"fingers": 2, "finger_width": 0.02, "clearance": 0.02, "max_opening": 0.3},
        "objects": [{"id": "cup", "x": 0.2, "y": 0.5, "radius": 0.05},
            {"id": "tray", "x": 0.6, "y": 0.5, "yaw": -0.1, "shape": {"kind": "rectangle", "length": 0.36, "width": 0.24},
             "grasps": [{"x": 0.15, "yaw": 1.5708, "tolerance": 0.03}]},
            {"id": "knife", "x": 1, "y": 0.5, "shape": {"kind": "capsule", "length": 0.2, "radius": 0.01}},
            {"id": "napkin", "x": 1.4, "y": 0.5, "shape": {"kind": "polygon", "points": [{"x": 0, "y": 0}, {"x": 0.1, "y": 0}, {"x": 0, "y": 0.2}]}}],
        "goal": {"clear": true}, "drop_offs": [{"id": "bin"}]}"#;
    read_scene(scene.as_bytes(), &RequestLimits::default()).unwrap()
}

fn text(request: &PlanRequest, statement: Statement) -> String {
    let request = PlanRequest { warnings: Vec::new(), ..request.clone() };
    let text = answer(&request, &Answer { statement, statistics: Statistics::default() }.into());
    text.rsplit_once("\n0.00 ms in all").unwrap().0.to_owned()
}

fn grasp(at: (f64, f64), yaw: f64) -> StatedGrasp {
    StatedGrasp { at: Some(Point2::new(at.0, at.1)), yaw, slack: Some(0.03) }
}

fn pose(at: (f64, f64), yaw: Option<f64>) -> StatedPose {
    StatedPose { at: Point2::new(at.0, at.1), yaw }
}

fn moved(id: &str, from: StatedPose, to: StatedPose, grasps: [StatedGrasp; 2], turn: Option<f64>) -> Step {
    let [grasp, release] = grasps;
    Step::PickPlace(PickPlace { object: id.to_owned(), from: Some(from), to, grasp, release, turn, gap: Some(0.01) })
}

fn cup() -> Step {
    moved("cup", pose((0.2, 0.5), None), pose((0.2, 0.9), None), [grasp((0.2, 0.5), 0.5), grasp((0.2, 0.9), 0.5)], None)
}

/// Moved by its middle, and turned by a quarter.
fn knife(turn: f64) -> Step {
    let (from, to) = (pose((1.0, 0.5), Some(0.0)), pose((1.5, 0.2), Some((turn + TAU) % TAU)));
    moved("knife", from, to, [grasp((1.0, 0.5), FRAC_PI_2), grasp((1.5, 0.2), FRAC_PI_2 + turn)], Some(turn))
}

fn table_of(steps: Vec<Step>) -> String {
    let stated = Statement { verdict: Some(Verdict::Cleared), relocations: Some(steps), ..Statement::default() };
    text(&request(), stated).split_once("\n\n").unwrap().1.to_owned()
}

#[test]
fn a_step_says_how_its_object_stands_and_how_far_it_turns() {
    let expected = "\
#  object            from (m)                   to (m)    turn    grasp yaw  release yaw      gap
1  cup           0.200, 0.500  →          0.200, 0.900          28.6° ±1.7°  28.6° ±1.7°  10.0 mm
2  knife   1.000, 0.500, 0.0°  →  1.500, 0.200, 270.0°  -90.0°  90.0° ±1.7°   0.0° ±1.7°  10.0 mm
";
    assert_eq!(table_of(vec![cup(), knife(-FRAC_PI_2)]), expected);
}

#[test]
fn where_nothing_turns_no_column_says_so_and_equal_directions_look_equal() {
    let from = pose((0.6, 0.5), Some(-0.1));
    let to = pose((0.6, 0.2), Some(TAU - 0.1));
    let grasps = [grasp((0.6, 0.5), 1.0), grasp((0.6, 0.2), 1.0)];
    let text = table_of(vec![moved("tray", from, to, grasps, Some(0.0)), knife(-1e-5)]);
    let expected = "\
#  object              from (m)                   to (m)    grasp yaw  release yaw      gap
1  tray    0.600, 0.500, 354.3°  →  0.600, 0.200, 354.3°  57.3° ±1.7°  57.3° ±1.7°  10.0 mm
2  knife     1.000, 0.500, 0.0°  →    1.500, 0.200, 0.0°  90.0° ±1.7°  90.0° ±1.7°  10.0 mm
";
    assert_eq!(text, expected);
}

#[test]
fn a_gripper_off_the_origin_of_its_object_is_told_for_every_step() {
    let from = pose((0.6, 0.5), Some(0.0));
    let grasp = grasp((0.75, 0.5), FRAC_PI_2);
    let drop = PickDrop { object: "tray".to_owned(), from: Some(from), grasp, drop_off: "bin".to_owned() };
    let drop = Step::PickDrop(drop);
    let expected = "\
#  object            from (m)     to   grasp at (m)    grasp yaw
1  tray    0.600, 0.500, 0.0°  →  bin  0.750, 0.500  90.0° ±1.7°
";
    assert_eq!(table_of(vec![drop.clone()]), expected);
    let expected = "\
#  object            from (m)           to (m)  drop-off  grasp at (m)    grasp yaw  release at (m)  release yaw      gap
1  cup           0.200, 0.500  →  0.200, 0.900            0.200, 0.500  28.6° ±1.7°    0.200, 0.900  28.6° ±1.7°  10.0 mm
2  tray    0.600, 0.500, 0.0°  →                bin       0.750, 0.500  90.0° ±1.7°
";
    assert_eq!(table_of(vec![cup(), drop]), expected);
}

#[test]
fn the_last_grasp_says_where_the_gripper_is_if_that_is_not_the_objects_origin() {
    let text = |at| {
        let stated = Statement {
            verdict: Some(Verdict::Graspable),
            target: Some("tray".to_owned()),
            target_grasp: Some(grasp(at, FRAC_PI_2)),
            ..Statement::default()
        };
        text(&request(), stated).rsplit_once("\n\n").unwrap().1.to_owned()
    };
    assert_eq!(text((0.749, 0.485)), "Grasp tray at yaw 90.0° ±1.7° over 0.749, 0.485.\n");
    assert_eq!(text((0.6001, 0.5)), "Grasp tray at yaw 90.0° ±1.7°.\n");
}

#[test]
fn what_has_no_grasp_is_not_called_too_wide_and_a_lock_speaks_of_grasps() {
    let names = |ids: &[&str]| ids.iter().map(|&id| id.to_owned()).collect::<Vec<_>>();
    let core = names(&["knife", "napkin"]);
    let stated = Statement {
        verdict: Some(Verdict::PartlyCleared),
        relocations: Some(Vec::new()),
        left: Some(names(&["knife", "napkin"])),
        stuck: Some(Deadlock { blocked: core.clone(), core }),
        proven: Some(true),
        ..Statement::default()
    };
    let expected = "\
why left         objects
locked           knife
without a grasp  napkin

These objects lock each other: in every grasp of each that can be moved, another of them is in the way.

object
knife
napkin  without a grasp

No order takes more away.
";
    assert_eq!(text(&request(), stated).split_once("\n\n").unwrap().1, expected);
}
