import os
from dataclasses import replace

import pytest
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Pose
from table import DROPPING, SETTINGS, detections, planning_scene, table, tray, vase

from singulate_ros.planning import plan


pytestmark = pytest.mark.skipif("SINGULATE_URL" not in os.environ, reason="SINGULATE_URL names no service")


def test_a_real_service_frees_the_cup_of_the_example() -> None:
    poses, words = plan(detections(), planning_scene(table(), vase()), SETTINGS, Time, Pose)
    assert words == "move plate-2, move plate-1, then grasp cup"
    starts = [(pose.position.x, pose.position.y) for pose in poses[::2]]
    assert starts == [(0.4, 0.36), (0.5, 0.29), (0.4, 0.25)]


def test_a_real_service_takes_two_plates_away_and_says_what_is_left() -> None:
    clear = replace(DROPPING, target="", clear=True)
    poses, words = plan(detections(), planning_scene(table(), tray(), vase()), clear, Time, Pose)
    assert words == "take plate-3 to tray, take plate-2 to tray, then partly cleared: cup, plate-1 left"
    assert [(pose.position.x, pose.position.y) for pose in poses[1::2]] == [pytest.approx((1.25, 0.35))] * 2
