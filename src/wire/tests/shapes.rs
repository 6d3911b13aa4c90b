//! Shapes, yaws, heights, listed grasps and palms: what is read and written, and what is only warned of.

use serde_json::{Value, json};

use super::wanted::{pair, refuses, warnings};
use super::{read, scene, with};
use crate::wire::*;
use singulate_planner::budget::Budget;
use singulate_planner::knowledge::known;
use singulate_planner::scene::{Grasps, Kind, Object};

/// A scene of every shape for two jaws; `a` is still a disc and the target.
pub(super) fn table() -> Value {
    let mut body = with("/gripper/fingers", json!(2));
    body["gripper"]["finger_length"] = json!(0.12);
    body["gripper"]["palm_radius"] = json!(0.05);
    body["gripper"]["tip_height"] = json!(0.005);
    let points =
        json!([{"x": -0.05, "y": -0.03}, {"x": 0.05, "y": -0.03}, {"x": 0.05, "y": 0.03}, {"x": -0.05, "y": 0.03}]);
    let others = json!([
        {"id": "tray", "x": 0.7, "y": 0.2, "yaw": 0.3, "height": 0.03,
            "shape": {"kind": "rectangle", "length": 0.3, "width": 0.2, "corner_radius": 0.02}},
        {"id": "knife", "x": 0.45, "y": 0.2, "yaw": 1.2, "shape": {"kind": "capsule", "length": 0.2, "radius": 0.01},
            "grasps": [{"x": 0.04, "y": 0, "yaw": 1.5, "tolerance": 0.1}]},
        {"id": "box", "x": 0.2, "y": 0.5, "shape": {"kind": "polygon", "points": points, "corner_radius": 0.004}},
        {"id": "cup", "x": 0.5, "y": 0.5, "radius": 0.04, "height": 0.09, "grasps": [{"yaw": 0.5}]}
    ]);
    body["objects"].as_array_mut().unwrap().extend(others.as_array().unwrap().clone());
    body["objects"].as_array_mut().unwrap().remove(1);
    body
}

/// The scene with this shape as its second object.
pub(super) fn shaped(shape: Value) -> Value {
    with("/objects/1", json!({"id": "b", "x": 0.6, "y": 0.2, "shape": shape}))
}

/// The scene with one field more of its second object, a rectangle.
pub(super) fn boxed(name: &str, value: Value) -> Value {
    let mut body = shaped(json!({"kind": "rectangle", "length": 0.1, "width": 0.06}));
    body["objects"][1][name] = value;
    body
}

fn object(body: &Value, id: &str) -> Object {
    let scene = read(&body.to_string()).unwrap().scene;
    scene.object(scene.find(id).unwrap()).clone()
}

/// The entry of this id in the body's list of objects.
fn named(body: &Value, id: &str) -> Value {
    let mut objects = body["objects"].as_array().unwrap().iter();
    objects.find(|object| object["id"] == id).unwrap().clone()
}

#[test]
fn every_shape_is_read() {
    let body = table();
    assert_eq!(object(&body, "tray").footprint().shape().kind(), Kind::Rectangle { length: 0.3, width: 0.2 });
    assert_eq!(object(&body, "knife").footprint().shape().kind(), Kind::Capsule { length: 0.2 });
    assert_eq!(object(&body, "box").footprint().shape().kind(), Kind::Polygon);
    let tray = object(&body, "tray");
    assert_eq!((tray.footprint().pose().yaw, tray.footprint().radius(), tray.height()), (0.3, 0.02, Some(0.03)));
    let knife = object(&body, "knife");
    let grasp = &knife.grasps().listed().unwrap()[0];
    assert_eq!((grasp.at().x, grasp.at().y, grasp.yaw(), grasp.tolerance()), (0.04, 0.0, 1.5, 0.1));
    let cup = object(&body, "cup");
    let grasp = &cup.grasps().listed().unwrap()[0];
    assert_eq!((grasp.at().x, grasp.at().y, grasp.yaw(), grasp.tolerance()), (0.0, 0.0, 0.5, 0.05));
    assert_eq!(*object(&body, "a").grasps(), Grasps::EveryYaw);
    let gripper = *read(&body.to_string()).unwrap().scene.gripper();
    let palm = gripper.palm().unwrap();
    assert_eq!((palm.finger_length, palm.radius, gripper.tip_height()), (0.12, 0.05, 0.005));
}

#[test]
fn a_radius_is_the_short_form_of_a_disc() {
    let long = shaped(json!({"kind": "disc", "radius": 0.075}));
    let debug = |body: &Value| format!("{:?}", read(&body.to_string()).unwrap().scene);
    assert_eq!(debug(&long), debug(&scene()));
    let mut both = long.clone();
    both["objects"][1]["radius"] = json!(0.075);
    refuses(&both, &[("conflicting_fields", "/objects/1/shape")]);
    both["objects"][1]["shape"] = Value::Null;
    assert_eq!(debug(&both), debug(&scene()), "null counts as absent");
    both["objects"][1] = json!({"id": "b", "x": 0.6, "y": 0.2});
    refuses(&both, &[("missing", "/objects/1/radius")]);
}

#[test]
fn what_is_assumed_is_a_warning() {
    let all = [pair("default_grasps", "/objects"), pair("unknown_height", "/objects")];
    assert_eq!(warnings(&table()), all);
    let items = read(&table().to_string()).unwrap().warnings;
    assert!(
        items[0].detail.ends_with("'tray', 'box'") && items[1].detail.ends_with("'a', 'vase', 'knife', 'box'"),
        "{items:?}"
    );
    // A notch: three fingers have no grasp of it by default.
    let notched =
        json!([{"x": -0.05, "y": -0.05}, {"x": 0.05, "y": -0.05}, {"x": 0.05, "y": 0.05}, {"x": 0.02, "y": -0.02}]);
    let hull = shaped(json!({"kind": "polygon", "points": notched}));
    assert_eq!(warnings(&hull), [pair("convex_hull", "/objects/1/shape/points"), pair("no_grasp", "/objects/1")]);
    let mut turned = boxed("yaw", json!(30));
    turned["objects"][1]["grasps"] = json!([]);
    assert_eq!(warnings(&turned), [pair("out_of_proportion", "/objects/1/yaw"), pair("no_grasp", "/objects/1")]);
}

#[test]
fn a_written_scene_reads_as_the_same_scene_whatever_its_shapes() {
    let round = json!({"kind": "rectangle", "length": 0.04, "width": 0.04, "corner_radius": 0.02});
    let more = [
        json!({"id": "ring", "x": 0.9, "y": 0.3, "yaw": -0.25, "shape": {"kind": "disc", "radius": 0.02}}),
        json!({"id": "mat", "x": 0.1, "y": 0.1, "shape": round, "grasps": []}),
    ];
    let mut body = table();
    body["objects"].as_array_mut().unwrap().extend(more);
    let read = |body: &Value| read(&body.to_string()).unwrap().scene;
    let again = serde_json::to_value(SceneBody::new(&read(&body), None)).unwrap();
    assert_eq!(format!("{:?}", read(&again)), format!("{:?}", read(&body)));
    let (object, stated) = (|id: &str| named(&again, id).to_string(), |id: &str| named(&body, id));
    assert_eq!(object("a"), stated("a").to_string());
    assert_eq!(object("ring"), json!({"id": "ring", "x": 0.9, "y": 0.3, "yaw": -0.25, "radius": 0.02}).to_string());
    let tray = json!({"id": "tray", "x": 0.7, "y": 0.2, "yaw": 0.3, "shape": stated("tray")["shape"], "height": 0.03});
    assert_eq!(object("tray"), tray.to_string());
    let knife = json!({"id": "knife", "x": 0.45, "y": 0.2, "yaw": 1.2, "shape": stated("knife")["shape"],
        "grasps": [{"x": 0.04, "y": 0.0, "yaw": 1.5, "tolerance": 0.1}]});
    assert_eq!(object("knife"), knife.to_string());
    let grasp = json!([{"x": 0.0, "y": 0.0, "yaw": 0.5, "tolerance": 0.05}]);
    let cup = json!({"id": "cup", "x": 0.5, "y": 0.5, "radius": 0.04, "height": 0.09, "grasps": grasp});
    assert_eq!(object("cup"), cup.to_string());
    assert_eq!(object("mat"), stated("mat").to_string());
    assert!(!object("box").contains("grasps"), "these go with the shape");
    assert_eq!(again["gripper"]["tip_height"], json!(0.005));
}

#[test]
fn knowledge_lists_grasps_with_their_blockers() {
    let mut body = table();
    // The knife across the end of the tray.
    for (name, value) in [("x", 0.535), ("y", 0.148), ("yaw", 1.8708)] {
        body["objects"][3][name] = json!(value);
    }
    let request = read(&body.to_string()).unwrap();
    let known = known(&request.scene, request.methods.grasp_model.model(), &Budget::unlimited()).unwrap();
    let written = serde_json::to_value(KnowledgeBody::new(&request.scene, &known, &[])).unwrap();
    let (disc, tray) = (named(&written, "a"), named(&written, "tray"));
    assert!(disc.get("grasps").is_none() && !disc["option_yaws"].as_array().unwrap().is_empty());
    assert_eq!((&tray["option_yaws"], &tray["shadows"]), (&json!([]), &json!([])));
    let grasps = tray["grasps"].as_array().unwrap();
    assert_eq!(grasps.len(), 2);
    assert!(!tray["options"].as_array().unwrap().is_empty());
    assert!(grasps.iter().any(|grasp| grasp["blockers"] == json!(["knife"])), "{tray}");
    let names: Vec<_> = grasps[0].as_object().unwrap().keys().collect();
    assert_eq!(names, ["x", "y", "yaw", "blockers"]);
    assert_eq!((&grasps[0]["x"], &grasps[0]["y"]), (&json!(0.7), &json!(0.2)));
}
