from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import pytest
from geometry_msgs.msg import Pose, Quaternion
from moveit_msgs.msg import CollisionObject, PlanningScene
from shape_msgs.msg import Plane, SolidPrimitive
from std_msgs.msg import Header
from table import SETTINGS, detection, detections, mesh, no_warning, planning_scene, pose, solid, table, vase
from vision_msgs.msg import Detection3D

from singulate_ros.failure import Failure
from singulate_ros.mapping import Item, to_scene
from singulate_ros.settings import Settings


# A lid with an edge that leans out, 0.05 m high.
LID = [(0.0, 0.0, 0.0), (0.2, 0.0, 0.0), (0.1, 0.02, 0.05), (0.2, 0.1, 0.0), (0.0, 0.1, 0.05)]


def items(obstacle: CollisionObject, warn: Callable[[str], object] = no_warning) -> list[Item]:
    """What becomes of a collision object; the four detections come first."""
    return to_scene(detections(), planning_scene(table(), obstacle), SETTINGS, warn)["objects"][4:]


def seen(more: Detection3D) -> Item:
    return to_scene(detections(more), planning_scene(table()), SETTINGS, no_warning)["objects"][4]


def refused(words: str, scene: PlanningScene, settings: Settings = SETTINGS, *more: Detection3D) -> None:
    with pytest.raises(Failure, match=words):
        to_scene(detections(*more), scene, settings, no_warning)


def test_the_messages_of_the_example_give_the_scene_of_the_example() -> None:
    scene = to_scene(detections(), planning_scene(vase(), table()), SETTINGS, no_warning)
    assert scene["table"] == pytest.approx({"x_min": 0.0, "y_min": 0.0, "x_max": 0.8, "y_max": 0.5})
    assert scene["gripper"] == {
        "fingers": 3,
        "finger_width": 0.02,
        "clearance": 0.05,
        "margin": 0.0,
        "yaw_tolerance": 0.0,
    }
    low, high = pytest.approx(0.1), pytest.approx(0.3)
    assert scene["objects"] == [
        {"id": "cup", "x": 0.4, "y": 0.25, "height": low, "radius": 0.04, "fixed": False},
        {"id": "plate-1", "x": 0.5, "y": 0.29, "height": low, "radius": 0.06, "fixed": False},
        {"id": "plate-2", "x": 0.4, "y": 0.36, "height": low, "radius": 0.06, "fixed": False},
        {"id": "plate-3", "x": 0.31, "y": 0.2, "height": low, "radius": 0.06, "fixed": False},
        {"id": "vase", "x": 0.44, "y": 0.16, "height": high, "radius": 0.05, "fixed": True},
    ]
    assert (scene["target"], scene["settings"]) == ("cup", {"time_limit_ms": 1000})
    assert "goal" not in scene and "drop_offs" not in scene


def test_a_tolerance_for_overlaps_goes_with_the_scene_where_one_is_set() -> None:
    noisy = replace(SETTINGS, overlap_tolerance=0.005)
    scene = to_scene(detections(), planning_scene(vase(), table()), noisy, no_warning)
    assert scene["settings"] == {"time_limit_ms": 1000, "overlap_tolerance": 0.005}


def test_what_is_round_has_the_circle_inside_its_box_and_what_is_not_the_box() -> None:
    assert seen(detection("b", "bowl", 0.1, 0.1, 0.06, 0.08))["radius"] == pytest.approx(0.04)
    carton = seen(detection("c", "carton", 0.1, 0.1, 0.06, 0.08))
    assert "radius" not in carton and carton["yaw"] == 0.0
    assert carton["shape"] == {"kind": "rectangle", "length": pytest.approx(0.06), "width": pytest.approx(0.08)}


def test_a_detection_without_an_id_is_named_by_its_likeliest_class_and_its_index() -> None:
    assert seen(detection("", "bowl", 0.1, 0.1, 0.08))["id"] == "bowl-4"
    assert seen(replace(detection("", "bowl", 0.1, 0.1, 0.08), results=[]))["id"] == "object-4"


def test_a_table_turned_by_a_quarter_has_its_sides_exchanged() -> None:
    quarter = Quaternion(z=math.sin(math.pi / 4), w=math.cos(math.pi / 4))
    scene = to_scene(detections(), planning_scene(table(quarter)), SETTINGS, no_warning)
    assert scene["table"] == pytest.approx({"x_min": 0.15, "y_min": -0.15, "x_max": 0.65, "y_max": 0.65})


@pytest.mark.parametrize("turn", [Quaternion(z=0.1, w=0.995), Quaternion(x=0.1, w=0.995)])
def test_a_table_that_lies_askew_or_tilted_is_refused(turn: Quaternion) -> None:
    refused("don't lie along the axes", planning_scene(table(turn)))


def test_a_planning_scene_without_a_table_that_is_one_box_is_refused() -> None:
    refused("no table", planning_scene(vase()))
    refused("no table", planning_scene(replace(vase(), id="table")))
    legs = replace(table(), primitives=table().primitives * 2, primitive_poses=[Pose(), Pose()])
    refused("no table", planning_scene(legs))
    refused("no table", planning_scene(table(), table()))


def test_a_diff_is_refused() -> None:
    refused("diff", replace(planning_scene(table()), is_diff=True))


def test_every_message_must_be_in_the_frame_of_the_table() -> None:
    elsewhere = Header(frame_id="camera")
    refused("the detections: frame 'world'", planning_scene(table()), replace(SETTINGS, frame="base"))
    refused("table: frame 'camera'", planning_scene(replace(table(), header=elsewhere)))
    refused("vase: frame 'camera'", planning_scene(table(), replace(vase(), header=elsewhere)))
    bowl = detection("bowl", "bowl", 0.1, 0.1, 0.08)
    refused("bowl: frame 'camera'", planning_scene(table()), SETTINGS, replace(bowl, header=elsewhere))


def test_a_collision_object_that_is_detected_too_can_be_moved() -> None:
    assert items(solid("plate-1", SolidPrimitive.CYLINDER, [0.02, 0.06], pose(0.5, 0.29, 0.76))) == []


def test_cylinders_and_spheres_are_fixed_discs_with_their_height_over_the_table() -> None:
    at = pose(0.1, 0.1, 0.8)
    for kind, dimensions, radius, height in (
        (SolidPrimitive.CYLINDER, [0.1, 0.04], 0.04, 0.1),
        (SolidPrimitive.SPHERE, [0.03], 0.03, 0.08),
    ):
        (disc,) = items(solid("it", kind, dimensions, at))
        size = {"radius": pytest.approx(radius), "height": pytest.approx(height)}
        assert disc == {"id": "it", "x": 0.1, "y": 0.1, **size, "fixed": True}


def test_a_box_is_a_fixed_rectangle_with_its_yaw() -> None:
    turn = Quaternion(z=math.sin(0.2), w=math.cos(0.2))
    (rectangle,) = items(solid("it", SolidPrimitive.BOX, [0.06, 0.08, 0.1], pose(0.1, 0.1, 0.8, turn)))
    sides = {"length": pytest.approx(0.06), "width": pytest.approx(0.08)}
    where = {"x": 0.1, "y": 0.1, "yaw": pytest.approx(0.4), "height": pytest.approx(0.1)}
    assert rectangle == {"id": "it", **where, "shape": {"kind": "rectangle", **sides}, "fixed": True}


def test_a_mesh_is_the_polygon_of_its_hull_and_a_warning_says_so() -> None:
    told: list[str] = []
    quarter = Quaternion(z=math.sin(math.pi / 4), w=math.cos(math.pi / 4))
    (polygon,) = items(mesh("lid", LID, pose(0.2, 0.1, 0.76, quarter)), told.append)
    assert told == ["'lid' is a mesh, planned as the convex hull of its footprint"]
    assert (polygon["x"], polygon["y"], polygon["yaw"]) == pytest.approx((0.15, 0.2, 0.0))
    assert polygon["height"] == pytest.approx(0.06) and polygon["fixed"]
    corners = {(round(point["x"], 9), round(point["y"], 9)) for point in polygon["shape"]["points"]}
    assert corners == {(-0.05, -0.1), (0.05, -0.1), (0.05, 0.1), (-0.05, 0.1)}


def test_solids_and_meshes_of_one_object_are_numbered_through() -> None:
    told: list[str] = []
    both = replace(vase(), meshes=mesh("", LID, Pose()).meshes, mesh_poses=[pose(-0.3, 0.2, -0.1)])
    assert [each["id"] for each in items(both, told.append)] == ["vase/0", "vase/1"]


def test_of_a_mesh_that_is_left_out_there_is_no_warning() -> None:
    assert items(mesh("lid", LID, pose(-0.3, 0.1, 0.76))) == []
    # Its circle would reach over the table's corner; its hull does not.
    assert items(mesh("wedge", [(0.0, -0.3, 0.1), (-0.3, 0.0, 0.1), (-0.3, -0.3, 0.1)], pose(0.14, 0.14, 0.76))) == []


def test_each_solid_of_an_object_is_a_disc_where_its_own_pose_puts_it() -> None:
    quarter = Quaternion(z=math.sin(math.pi / 4), w=math.cos(math.pi / 4))
    ball = SolidPrimitive(type=SolidPrimitive.SPHERE, dimensions=[0.03])
    rack = solid("rack", SolidPrimitive.SPHERE, [0.03], pose(0.1, 0.1, 0.8, quarter))
    rack = replace(rack, primitives=[ball, ball], primitive_poses=[Pose(), pose(0.1, 0.0, 0.0)])
    first, second = items(rack)
    assert (first["id"], second["id"]) == ("rack/0", "rack/1")
    assert (first["x"], first["y"], second["x"], second["y"]) == pytest.approx((0.1, 0.1, 0.1, 0.2))


@pytest.mark.parametrize(
    "obstacle",
    [
        solid("it", SolidPrimitive.CONE, [0.1, 0.04], pose(0.1, 0.1, 0.8)),
        replace(vase(), planes=[Plane()]),
    ],
)
def test_what_no_shape_stands_for_is_refused(obstacle: CollisionObject) -> None:
    refused("boxes, cylinders, spheres and meshes are understood", planning_scene(table(), obstacle))


def test_solids_with_too_few_dimensions_or_poses_are_refused() -> None:
    refused("1 dimensions, not 3", planning_scene(table(), solid("it", SolidPrimitive.BOX, [0.1], Pose())))
    refused("not one pose for each", planning_scene(table(), replace(vase(), primitive_poses=[])))
    refused("not one pose for each", planning_scene(table(), replace(mesh("lid", LID, Pose()), mesh_poses=[])))


def test_what_stands_beside_the_table_or_under_its_top_is_left_out() -> None:
    assert items(solid("robot", SolidPrimitive.CYLINDER, [1.0, 0.1], pose(-0.1, 0.25, 0.9))) == []
    assert items(solid("corner", SolidPrimitive.CYLINDER, [1.0, 0.1], pose(-0.08, -0.08, 0.9))) == []
    assert items(solid("shelf", SolidPrimitive.BOX, [0.4, 0.4, 0.1], pose(0.4, 0.25, 0.3))) == []
    assert items(solid("mat", SolidPrimitive.BOX, [0.4, 0.4, 0.1], pose(0.4, 0.25, 0.7005))) == []
    assert items(solid("bench", SolidPrimitive.BOX, [0.4, 0.4, 0.2], pose(-0.2, 0.25, 0.8))) == []


def test_what_leans_over_the_table_from_beside_it_is_refused() -> None:
    robot = solid("robot", SolidPrimitive.CYLINDER, [1.0, 0.1], pose(-0.05, 0.25, 0.9))
    refused("'robot' reaches over the table", planning_scene(table(), robot))
    bench = solid("bench", SolidPrimitive.BOX, [0.4, 0.4, 0.2], pose(-0.1, 0.25, 0.8))
    refused("'bench' reaches over the table", planning_scene(table(), bench))


def test_an_id_that_two_objects_have_is_refused() -> None:
    refused("one id: cup", planning_scene(table()), SETTINGS, detection("cup", "cup", 0.1, 0.1, 0.08))


def test_a_target_that_is_not_on_the_table_is_refused() -> None:
    refused("target 'spoon'", planning_scene(table()), replace(SETTINGS, target="spoon"))
    beside = detection("bowl", "bowl", 2.0, 0.1, 0.08)
    refused("target 'bowl'", planning_scene(table()), replace(SETTINGS, target="bowl"), beside)
