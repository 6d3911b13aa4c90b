"""The service's answer, and the poses that follow from it. Needs no ROS."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Callable

from singulate_ros.failure import Failure
from singulate_ros.mapping import Scene

if TYPE_CHECKING:
    from geometry_msgs.msg import Pose


@dataclass(frozen=True)
class Grip:
    """Where the gripper closes or opens; yaw is the direction of finger 0, counter-clockwise from the frame's x."""

    x: float
    y: float
    yaw: float


@dataclass(frozen=True)
class Plan:
    """Grasp and release of each relocation in turn; then the target's grasp."""

    grips: list[Grip]
    words: str


def read_answer(answer: Any, scene: Scene) -> Plan:
    """Refuses what it does not understand, above all verdicts and actions of later versions."""
    try:
        return _read(answer, scene)
    except (KeyError, TypeError, ValueError) as error:
        raise Failure(f"the answer is not understood: {error!r}") from error


def to_poses(plan: Plan, z: float, new_pose: Callable[[], Pose]) -> list[Pose]:
    """One pose for each grip, its tool upright: only turned about z."""
    poses = []
    for grip in plan.grips:
        pose = new_pose()
        pose.position.x, pose.position.y, pose.position.z = grip.x, grip.y, z
        pose.orientation.x, pose.orientation.y = 0.0, 0.0
        pose.orientation.z, pose.orientation.w = math.sin(grip.yaw / 2), math.cos(grip.yaw / 2)
        poses.append(pose)
    return poses


def _read(answer: Any, scene: Scene) -> Plan:
    verdict = answer["verdict"]
    if verdict in ("graspable", "relocate"):
        grips = [grip for relocation in answer["relocations"] for grip in _relocation(relocation)]
        if verdict == "relocate" and not grips:
            raise Failure("the answer is not understood: relocate without a relocation")
        target = next(each for each in scene["objects"] if each["id"] == scene["target"])
        grips.append(Grip(target["x"], target["y"], float(answer["target_grasp"]["yaw"])))
        moved = [relocation["object"] for relocation in answer["relocations"]]
        return Plan(grips, f"move {', '.join(moved)}, then grasp" if moved else "grasp")
    if verdict == "deadlock":
        core = answer["deadlock"]["core"] if answer["deadlock"] else []
        raise Failure(f"deadlock: {', '.join(core)} hold each other" if core else "deadlock")
    if verdict in ("no_space", "timed_out"):
        words = verdict.replace("_", " ")
        needed = answer["needed"] or []
        raise Failure(f"{words}: {', '.join(needed)} would have to go" if needed else words)
    raise Failure(f"unknown verdict: {verdict}")


def _relocation(relocation: Any) -> list[Grip]:
    if relocation["action"] != "pick_place":
        raise Failure(f"unknown action: {relocation['action']}")
    return [
        Grip(float(relocation[place]["x"]), float(relocation[place]["y"]), float(relocation[grasp]["yaw"]))
        for place, grasp in (("from", "grasp"), ("to", "release"))
    ]
