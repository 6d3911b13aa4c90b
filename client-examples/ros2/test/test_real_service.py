import os
from dataclasses import replace

import pytest
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Pose
from table import DROPPING, SETTINGS, detection, detections, mesh, no_warning, planning_scene, pose, table, tray, vase

from singulate_ros.planning import plan


pytestmark = pytest.mark.skipif("SINGULATE_URL" not in os.environ, reason="SINGULATE_URL names no service")


def test_a_real_service_frees_the_cup_of_the_example() -> None:
    poses, words = plan(detections(), planning_scene(table(), vase()), SETTINGS, Time, Pose, no_warning)
    assert words == "move plate-2, move plate-1, then grasp cup"
    starts = [(pose.position.x, pose.position.y) for pose in poses[::2]]
    assert starts == [(0.4, 0.36), (0.5, 0.29), (0.4, 0.25)]


def test_a_real_service_takes_two_plates_away_and_says_what_is_left() -> None:
    clear = replace(DROPPING, target="", clear=True)
    poses, words = plan(detections(), planning_scene(table(), tray(), vase()), clear, Time, Pose, no_warning)
    assert words == "take plate-3 to tray, take plate-2 to tray, then partly cleared: cup, plate-1 left"
    assert [(pose.position.x, pose.position.y) for pose in poses[1::2]] == [pytest.approx((1.25, 0.35))] * 2


def test_a_real_service_takes_boxes_and_meshes_as_they_are() -> None:
    told: list[str] = []
    boxes = [detection("carton", "carton", 0.14, 0.1, 0.06, 0.08), detection("tin", "tin", 0.2, 0.1, 0.05, 0.07)]
    wedge = mesh("wedge", [(0.0, 0.0, 0.0), (0.05, 0.0, 0.0), (0.0, 0.04, 0.04)], pose(0.12, 0.15, 0.76))
    jaws = replace(SETTINGS, target="carton", fingers=2, clearance=0.02, finger_length=0.08, palm_radius=0.03)
    poses, words = plan(detections(*boxes), planning_scene(table(), wedge), jaws, Time, Pose, told.append)
    assert words == "move tin turned by 0.000 to yaw 0.000, then grasp carton"
    # Everything is 0.1 m high: 0.02 m more than the fingers are long.
    assert [each.position.z for each in poses] == pytest.approx([0.94] * 3)
    assert (poses[-1].position.x, poses[-1].position.y) == pytest.approx((0.14, 0.1))
    assert told[0] == "'wedge' is a mesh, planned as the convex hull of its footprint"
    assert told[1].startswith("default_grasps /objects: ") and told[1].endswith("'carton', 'tin'") and len(told) == 2
