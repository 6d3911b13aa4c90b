//! Turned and rounded shapes, listed grasps, the palm, and what has no grasp.

use core::f64::consts::FRAC_PI_2;

use nalgebra::Vector2;

use super::rows::{all, drawn, groups, number, plan, row, sound};
use super::*;
use crate::render::lines::description;
use singulate_planner::scene::{GraspDraft, Pose};

const TWO: &[(&str, f64)] = &[("a", 0.08), ("b", 0.08)];

fn capsule() -> ShapeDraft {
    ShapeDraft::Capsule { length: Some(0.2), radius: Some(0.01) }
}

fn rectangle_of(length: f64, width: f64, corner: f64) -> ShapeDraft {
    ShapeDraft::Rectangle { length: Some(length), width: Some(width), corner_radius: Some(corner) }
}

/// A triangle whose frame has its origin at a corner. No two of its edges are parallel, so it has no grasp by default.
fn triangle() -> ShapeDraft {
    let points = [[0.0, 0.0], [0.3, 0.0], [0.0, 0.3]];
    ShapeDraft::Polygon { points: points.map(|point| point.map(Some)).to_vec(), corner_radius: None }
}

/// For two jaws: a disc, and something of this shape at (0.6, 0.3), turned by `yaw`, with this list of grasps.
fn scene(shape: ShapeDraft, yaw: f64, grasps: Option<Vec<GraspDraft>>) -> SceneDraft {
    let mut draft = row(TWO, all(&["a"]), &[("tray", None, None)]);
    draft.gripper.fingers = Some(2.0);
    let object = &mut draft.objects[1];
    (object.shape, object.yaw, object.grasps) = (shape, Some(yaw), grasps);
    draft
}

/// That of the drawing, with all the lines above the table.
fn view(scene: &Scene, stated: &Statement) -> View {
    let lines = Lines::new(scene, &answer(stated.clone()));
    View::new(scene, stated, &Roles::new(scene, stated), lines.added)
}

/// The step that moves the second object to a pose, held at its grasp at a position of its list.
fn moved(scene: &Scene, to: Pose, grasp: usize) -> Statement {
    let object = &scene.objects()[1];
    let held = object.grasps().listed().unwrap()[grasp].clone();
    let grasp = |pose: Pose| {
        let at = pose.point(held.at());
        StatedGrasp { at: Some(at), yaw: pose.yaw + held.yaw(), slack: Some(0.05) }
    };
    let from = object.footprint().pose();
    let step = PickPlace {
        object: object.id().to_owned(),
        from: Some(from.into()),
        to: to.into(),
        grasp: grasp(from),
        release: grasp(to),
        turn: Some(to.yaw - from.yaw),
        gap: None,
    };
    plan(Verdict::Relocate, vec![Step::PickPlace(step)])
}

/// The corners that an outline names, px.
fn corners(path: &str) -> Vec<Point2<f64>> {
    let numbers: Vec<f64> = path.split(['M', 'L', 'Z', ' ']).filter_map(|number| number.parse().ok()).collect();
    numbers.chunks(2).map(|at| Point2::new(at[0], at[1])).collect()
}

fn path(drawing: &str) -> &str {
    drawing.split_once("<path d=\"").unwrap().1.split('"').next().unwrap()
}

#[test]
fn a_sharp_rectangle_is_four_turned_corners() {
    let scene = sound(scene(rectangle_of(0.2, 0.1, 0.0), 0.3, None));
    let (drawing, view) = (drawn(&scene, Statement::timed_out()), view(&scene, &Statement::timed_out()));
    let path = path(&drawing);
    assert!(!path.contains('A'), "{path}");
    // Each edge by both ends.
    let expected = [(-0.1, -0.05), (0.1, -0.05), (0.1, 0.05), (-0.1, 0.05)].map(|(x, y)| {
        let (cos, sin) = (libm::cos(0.3), libm::sin(0.3));
        view.point(Point2::new(0.6 + x * cos - y * sin, 0.3 + x * sin + y * cos))
    });
    let drawn = corners(path);
    assert!(expected.iter().all(|corner| drawn.iter().any(|at| distance(*at, *corner) < 0.02)), "{path}");
    assert!(drawn.iter().all(|at| expected.iter().any(|corner| distance(*at, *corner) < 0.02)), "{path}");
}

#[test]
fn rounded_corners_are_arcs_of_their_radius() {
    for (shape, arcs, radius) in [(rectangle_of(0.2, 0.1, 0.02), 4, 0.02), (capsule(), 2, 0.01)] {
        let scene = sound(scene(shape, 0.3, None));
        let drawing = drawn(&scene, Statement::timed_out());
        let radius = px(view(&scene, &Statement::timed_out()).length(radius));
        let arc = format!("A{radius} {radius} 0 0 0 ");
        assert_eq!(path(&drawing).matches(&arc).count(), arcs, "{}", path(&drawing));
        assert!(path(&drawing).ends_with('Z'));
    }
}

#[test]
fn fingers_of_a_listed_grasp_start_at_the_objects_edge_and_stand_round_its_axis() {
    let grasp = GraspDraft { x: Some(0.05), yaw: Some(FRAC_PI_2), tolerance: Some(0.0), ..GraspDraft::default() };
    let mut draft = scene(rectangle_of(0.2, 0.1, 0.0), 0.0, Some(vec![grasp]));
    draft.gripper.yaw_tolerance = Some(0.0);
    let scene = sound(draft);
    // Turned by a quarter its axis is above the origin, and the fingers close along x.
    let to = Pose { at: Point2::new(1.5, 0.5), yaw: FRAC_PI_2 };
    let stated = moved(&scene, to, 0);
    let view = view(&scene, &stated);
    let drawing = drawn(&scene, stated);
    let corners = |finger: [(f64, f64); 4]| paint::points(finger.map(|(x, y)| view.point(Point2::new(x, y))));
    for finger in [
        // Finger 0 points along +y of the table, 20 mm wide, open by the clearance of 50 mm beyond the edge.
        [(0.66, 0.35), (0.66, 0.4), (0.64, 0.4), (0.64, 0.35)],
        [(0.64, 0.25), (0.64, 0.2), (0.66, 0.2), (0.66, 0.25)],
        [(1.45, 0.56), (1.4, 0.56), (1.4, 0.54), (1.45, 0.54)],
        [(1.55, 0.54), (1.6, 0.54), (1.6, 0.56), (1.55, 0.56)],
    ] {
        assert!(drawing.contains(&corners(finger)), "{finger:?} in {drawing}");
    }
    assert!(drawing.contains("1: b, turned by +90.0°"));
}

#[test]
fn the_palm_is_drawn_round_the_axis_and_told_in_legend_and_lines() {
    let mut draft = scene(
        rectangle_of(0.2, 0.1, 0.0),
        0.0,
        Some(vec![GraspDraft { x: Some(0.05), yaw: Some(FRAC_PI_2), ..GraspDraft::default() }]),
    );
    let to = Pose { at: Point2::new(1.5, 0.5), yaw: 0.0 };
    let without = sound(draft.clone());
    let plain = drawn(&without, moved(&without, to, 0));
    assert!(!plain.contains("palm") && !plain.contains("turned by"));
    (draft.gripper.finger_length, draft.gripper.palm_radius) = (Some(0.1), Some(0.055));
    let scene = sound(draft.clone());
    let stated = moved(&scene, to, 0);
    let line = description(&scene, &answer(stated.clone()));
    assert!(
        line.contains("50 mm clearance. hand: palm 110 mm across, 100 mm above the fingertips. drop-off"),
        "{line}"
    );
    let view = view(&scene, &stated);
    let drawing = drawn(&scene, stated);
    let palms: Vec<&str> = drawing.split("<circle class=\"palm\"").skip(1).collect();
    let centres: Vec<_> = palms.iter().map(|palm| Point2::new(number(palm, "cx"), number(palm, "cy"))).collect();
    for (centre, x, y) in [(centres[0], 0.65, 0.3), (centres[1], 1.55, 0.5)] {
        assert!(distance(centre, view.point(Point2::new(x, y))) < 0.02, "{centre}");
    }
    assert_eq!((palms.len(), px(number(palms[0], "r"))), (2, px(view.length(0.055))));
    assert_eq!(groups(&drawing, "legend")[0].matches(">\npalm\n<").count(), 1);
    assert!(!drawn(&scene, Statement::timed_out()).contains("\npalm\n"), "no palm is drawn");
    draft.gripper.tip_height = Some(0.002);
    let text = description(&sound(draft), &answer(Statement::timed_out()));
    assert!(text.contains("100 mm above the fingertips; fingertips at least 2 mm above the table. "), "{text}");
}

#[test]
fn what_has_no_grasp_is_not_called_too_wide() {
    let mut draft = scene(triangle(), 0.0, None);
    draft.gripper.max_opening = Some(0.2);
    let unlike = |draft: SceneDraft| {
        let (scene, stated) = (sound(draft), Statement::timed_out());
        (description(&scene, &answer(stated.clone())), drawn(&scene, stated))
    };
    let (text, drawing) = unlike(draft.clone());
    assert!(text.contains("2 objects (1 without a grasp); 2 fingers"), "{text}");
    assert!(drawing.contains("b: without a grasp") && drawing.contains("without a grasp, as if fixed"));
    assert!(drawing.contains("id=\"no-grasp\"") && drawing.matches(paint::NO_GRASP.fill).count() == 2);
    assert!(!drawing.contains("too wide") && !drawing.contains("too-wide"));
    draft.objects[1].shape = rectangle_of(0.3, 0.25, 0.0);
    let (text, drawing) = unlike(draft);
    assert!(text.contains("(1 too wide for the hand)") && !drawing.contains("no-grasp"), "{text}");
}

#[test]
fn letters_have_a_halo_only_where_they_are_taller_than_the_object_is_thin() {
    let halo = |shape, yaw| drawn(&sound(scene(shape, yaw, None)), Statement::timed_out()).contains("paint-order");
    assert!(!halo(rectangle_of(0.2, 0.1, 0.0), 0.3));
    assert!(!halo(ShapeDraft::Capsule { length: Some(0.3), radius: Some(0.05) }, 0.3));
    // 4 mm of 4 m in 1,000 px.
    assert!(halo(ShapeDraft::Capsule { length: Some(0.3), radius: Some(0.002) }, 0.3));
    // Hatched.
    assert!(halo(triangle(), 0.3));
}

#[test]
fn a_name_is_level_where_it_fits_else_along_the_object() {
    let turns = |yaw, id: &str| {
        let mut draft = scene(ShapeDraft::Capsule { length: Some(0.3), radius: Some(0.03) }, yaw, None);
        draft.objects[1].id = Some(id.to_owned());
        let drawing = drawn(&sound(draft), Statement::timed_out());
        let turn = drawing.split_once("transform=\"rotate(");
        turn.map(|(_, rest)| rest.split(' ').next().unwrap().parse::<f64>().unwrap())
    };
    assert_eq!(turns(0.0, "knife-1"), None);
    assert_eq!(turns(FRAC_PI_2, "k"), None);
    // All that is nearly upright is read upwards.
    for (yaw, turn) in [(FRAC_PI_2, -90.0), (1.6, -(1.6_f64.to_degrees())), (-1.6, 1.6_f64.to_degrees() - 180.0)] {
        assert!((turns(yaw, "knife-1").unwrap() - turn).abs() < 0.02, "{yaw}");
    }
    // Counter-clockwise on the table is so in the drawing too, and no letters stand on their heads.
    for (yaw, turn) in [(1.0_f64, -1.0_f64), (1.0 + PI, -1.0), (-1.0, 1.0)] {
        assert!((turns(yaw, "knife-1").unwrap() - turn.to_degrees()).abs() < 0.01);
    }
}

#[test]
fn a_name_and_an_arrow_are_at_the_middle_wherever_the_frame_is() {
    let grasp = GraspDraft { x: Some(0.1), y: Some(0.1), yaw: Some(0.0), ..GraspDraft::default() };
    let scene = sound(scene(triangle(), 0.0, Some(vec![grasp])));
    let stated = moved(&scene, Pose { at: Point2::new(1.6, 0.3), yaw: 0.0 }, 0);
    let view = view(&scene, &stated);
    let drawing = drawn(&scene, stated);
    let middle = view.point(Point2::new(0.7, 0.4));
    assert!(drawing.matches(&format!("x=\"{}\"", px(middle.x))).count() > 0, "{drawing}");
    // The arrow leaves the triangle at its long side, where x + y = 0.9, and ends at its left side.
    let route = groups(&drawing, "route")[0];
    let line = &route[route.find("<line").unwrap()..];
    let start = view.point(Point2::new(0.8, 0.4));
    assert!((Vector2::new(number(line, "x1"), number(line, "y1")) - start.coords).norm() < 0.02, "{line}");
    let tip = corners(&route.split_once("points=\"").unwrap().1.split('"').next().unwrap().replace(',', " "))[0];
    assert!(distance(tip, view.point(Point2::new(1.6, 0.4))) < 0.02, "{tip}");
}

#[test]
fn the_number_of_a_thin_object_is_at_its_end() {
    let scene = sound(scene(capsule(), FRAC_PI_2, None));
    let stated = moved(&scene, Pose { at: Point2::new(1.6, 0.5), yaw: FRAC_PI_2 }, 0);
    let view = view(&scene, &stated);
    let drawing = drawn(&scene, stated);
    let route = groups(&drawing, "route")[0];
    let badge = groups(route.split("legend").next().unwrap(), "number")[1];
    let at = Point2::new(number(badge, "cx"), number(badge, "cy"));
    let expected = view.point(Point2::new(1.6, 0.5 + 0.85 * 0.09));
    assert!(distance(at, expected) < 0.02, "{at} for {expected}");
    // Nearly as small as a number may be: it does not hide the object.
    assert!((number(badge, "r") - 8.0).abs() < 0.01);
}

#[test]
fn a_drawing_is_no_larger_than_object_and_hand_need() {
    let grasp = GraspDraft { x: Some(0.2), yaw: Some(FRAC_PI_2), ..GraspDraft::default() };
    let scene = sound(scene(rectangle_of(0.5, 0.1, 0.0), 0.0, Some(vec![grasp])));
    let size = |x, y| {
        let stated = moved(&scene, Pose { at: Point2::new(x, y), yaw: 0.0 }, 0);
        let view = view(&scene, &stated);
        let (_, _, width, height) = view.frame();
        ((width - 6.0) / view.scale(), (height - 6.0) / view.scale())
    };
    // The jaws reach a little more than 0.1 m from their axis, which is 0.2 m beside the object's origin.
    let (width, height) = size(3.6, 0.85);
    assert!((width - 4.0).abs() < 1e-9 && (height - 1.0).abs() < 1e-9, "{width} × {height}");
    let (width, height) = size(3.8, 0.95);
    assert!(width > 4.1 && width < 4.12 && height > 1.05 && height < 1.07, "{width} × {height}");
}
