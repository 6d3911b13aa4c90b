"""The service's answer, and the poses that follow from it. Needs no ROS."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Callable, Dict, Tuple

from singulate_ros.failure import Failure
from singulate_ros.mapping import Item, Scene

if TYPE_CHECKING:
    from geometry_msgs.msg import Pose

Places = Dict[str, Tuple[float, float]]


@dataclass(frozen=True)
class Grip:
    """Where the gripper closes or opens: its axis, which may be beside the object's middle. Yaw is the direction of finger 0,
    counter-clockwise from the frame's x."""

    x: float
    y: float
    yaw: float
    lift: float = 0.0
    """How much higher than over a low object it stays: the palm stays over the object's top."""
    over_drop_off: bool = False


@dataclass(frozen=True)
class Plan:
    """Grasp and release of each step in turn; then the target's grasp, if one is grasped."""

    grips: list[Grip]
    words: str


def read_answer(answer: Any, scene: Scene, places: Places) -> Plan:
    """`places` are those of the drop-offs. Refuses what it does not understand, above all verdicts and actions of later
    versions."""
    try:
        return _read(answer, scene, places)
    except (KeyError, TypeError, ValueError) as error:
        raise Failure(f"the answer is not understood: {error!r}") from error


def read_warnings(answer: Any) -> list[str]:
    """What was assumed, and what looks odd, in the service's words."""
    try:
        return [f"{each['code']} {each['pointer']}: {each['detail']}" for each in answer["warnings"]]
    except (KeyError, TypeError) as error:
        raise Failure(f"the answer is not understood: {error!r}") from error


def to_poses(plan: Plan, tool_z: float, drop_z: float, new_pose: Callable[[], Pose]) -> list[Pose]:
    """One pose for each grip, its tool upright: only turned about z."""
    poses = []
    for grip in plan.grips:
        pose = new_pose()
        pose.position.x, pose.position.y = grip.x, grip.y
        pose.position.z = (drop_z if grip.over_drop_off else tool_z) + grip.lift
        pose.orientation.x, pose.orientation.y = 0.0, 0.0
        pose.orientation.z, pose.orientation.w = math.sin(grip.yaw / 2), math.cos(grip.yaw / 2)
        poses.append(pose)
    return poses


def _read(answer: Any, scene: Scene, places: Places) -> Plan:
    verdict = answer["verdict"]
    if verdict in ("graspable", "relocate"):
        return _to_goal(answer, scene, places)
    if verdict == "cleared":
        return _steps(answer, scene, places, "cleared")
    if verdict == "partly_cleared":
        return _steps(answer, scene, places, f"partly cleared: {_remains(answer)}")
    if verdict == "deadlock":
        core = answer["deadlock"]["core"] if answer["deadlock"] else []
        raise Failure(f"deadlock: {', '.join(core)} hold each other" if core else "deadlock")
    if verdict in ("no_space", "timed_out"):
        words = verdict.replace("_", " ")
        needed = answer["needed"] or []
        raise Failure(f"{words}: {', '.join(needed)} would have to go" if needed else words)
    raise Failure(f"unknown verdict: {verdict}")


def _to_goal(answer: Any, scene: Scene, places: Places) -> Plan:
    """Without a target, objects are taken away and none is grasped in the end."""
    if (answer["verdict"] == "relocate") != bool(answer["relocations"]):
        raise Failure("the answer is not understood: the relocations do not go with the verdict")
    if answer["target"] is None and answer["target_grasp"] is None:
        return _steps(answer, scene, places, "all taken away")
    target = _item(answer["target"], scene)
    plan = _steps(answer, scene, places, f"grasp {target['id']}")
    return Plan([*plan.grips, _grip(answer["target_grasp"], _lift(target, scene))], plan.words)


def _item(name: Any, scene: Scene) -> Item:
    item = next((each for each in scene["objects"] if each["id"] == name), None)
    if item is None:
        raise Failure(f"the answer is not understood: '{name}' is not in the scene")
    return item


def _lift(item: Item, scene: Scene) -> float:
    """How much higher the tips are than over a low object, so that the palm does not meet this one."""
    gripper = scene["gripper"]
    low = gripper.get("tip_height", 0.0) + gripper.get("finger_length", math.inf)
    return max(item["height"] - low, 0.0)


def _grip(grasp: Any, lift: float) -> Grip:
    return Grip(float(grasp["x"]), float(grasp["y"]), float(grasp["yaw"]), lift)


def _remains(answer: Any) -> str:
    """What a clearing leaves."""
    stuck = f"; {', '.join(answer['stuck']['core'])} hold each other" if answer["stuck"] is not None else ""
    if not isinstance(answer["proven"], bool):
        raise TypeError("'proven' is neither true nor false")
    return f"{', '.join(answer['left'])} left{'' if answer['proven'] else ', as far as is known'}{stuck}"


def _steps(answer: Any, scene: Scene, places: Places, end: str) -> Plan:
    """Their grips, and the plan in words with what comes of them."""
    read = [_step(step, scene, places) for step in answer["relocations"]]
    words = [step_words for _, step_words in read]
    return Plan([grip for grips, _ in read for grip in grips], f"{', '.join(words)}, then {end}" if words else end)


def _step(step: Any, scene: Scene, places: Places) -> tuple[list[Grip], str]:
    lift = _lift(_item(step["object"], scene), scene)
    grasp = _grip(step["grasp"], lift)
    if step["action"] == "pick_place":
        return [grasp, _grip(step["release"], lift)], f"move {step['object']}{_turn(step)}"
    if step["action"] == "pick_drop":
        drop_off = step["drop_off"]
        if drop_off not in places:
            raise Failure(f"the answer is not understood: there is no drop-off '{drop_off}'")
        x, y = places[drop_off]
        return [grasp, Grip(x, y, grasp.yaw, lift, over_drop_off=True)], f"take {step['object']} to {drop_off}"
    raise Failure(f"unknown action: {step['action']}")


def _turn(step: Any) -> str:
    """A disc that may be grasped at every yaw has none, and does not turn."""
    if "turn" not in step:
        return ""
    return f" turned by {float(step['turn']):.3f} to yaw {float(step['to']['yaw']):.3f}"
