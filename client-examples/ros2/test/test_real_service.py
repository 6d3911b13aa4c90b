import os

import pytest
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Pose
from table import SETTINGS, detections, planning_scene, table, vase

from singulate_ros.planning import plan


@pytest.mark.skipif("SINGULATE_URL" not in os.environ, reason="SINGULATE_URL names no service")
def test_a_real_service_frees_the_cup_of_the_example() -> None:
    poses, words = plan(detections(), planning_scene(table(), vase()), SETTINGS, Time, Pose)
    assert words == "move plate-2, plate-1, then grasp"
    starts = [(pose.position.x, pose.position.y) for pose in poses[::2]]
    assert starts == [(0.4, 0.36), (0.5, 0.29), (0.4, 0.25)]
