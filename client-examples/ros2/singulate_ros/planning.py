"""All from messages to plan. Needs no ROS; blocks its thread."""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Callable

from singulate_ros.answer import read_answer, read_warnings, to_poses
from singulate_ros.failure import Failure
from singulate_ros.mapping import drop_places, to_scene
from singulate_ros.service import ask
from singulate_ros.settings import Settings
from singulate_ros.wanted import is_reached

if TYPE_CHECKING:
    from builtin_interfaces.msg import Time
    from geometry_msgs.msg import Pose
    from moveit_msgs.msg import PlanningScene
    from vision_msgs.msg import Detection3DArray


def plan(
    detections: Detection3DArray,
    planning_scene: PlanningScene,
    settings: Settings,
    clock: Callable[[], Time],
    new_pose: Callable[[], Pose],
    warn: Callable[[str], object],
) -> tuple[list[Pose], str]:
    """The poses in order, and the plan in words. No poses where nothing is left to do. `warn` is told what was assumed.

    Asks the service at SINGULATE_URL with the key in SINGULATE_KEY: not parameters, which any node can read.
    """
    if not math.isfinite(settings.tool_z):
        raise Failure("the parameter tool_z is not set")
    _check_age(detections.header.stamp, clock(), settings.max_age)
    scene, places = to_scene(detections, planning_scene, settings, warn), drop_places(planning_scene, settings)
    if is_reached(scene):
        return [], "all taken away"
    url = os.environ.get("SINGULATE_URL", "http://127.0.0.1:8080")
    answer = ask(url, os.environ.get("SINGULATE_KEY", ""), scene)
    for warning in read_warnings(answer):
        warn(warning)
    found = read_answer(answer, scene, places)
    # A busy service may have answered minutes later.
    _check_age(detections.header.stamp, clock(), settings.max_age)
    return to_poses(found, settings.tool_z, settings.drop_z, new_pose), found.words


def _check_age(stamp: Time, now: Time, most: float) -> None:
    """A stamp of the future is of another clock, and so says nothing about the age."""
    age = now.sec - stamp.sec + 1e-9 * (now.nanosec - stamp.nanosec)
    if abs(age) > most:
        raise Failure(f"the detections are {age:.3f} s old")
