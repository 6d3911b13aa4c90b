from __future__ import annotations

import math
from typing import Any

import pytest
from geometry_msgs.msg import Pose
from table import SETTINGS, detections, planning_scene, table, vase

from singulate_ros.answer import Grip, Plan, read_answer, to_poses
from singulate_ros.failure import Failure
from singulate_ros.mapping import to_scene

SCENE = to_scene(detections(), planning_scene(table(), vase()), SETTINGS)
MOVE = {
    "action": "pick_place",
    "object": "plate-2",
    "from": {"x": 0.4, "y": 0.36},
    "to": {"x": 0.1, "y": 0.2},
    "grasp": {"yaw": 0.5},
    "release": {"yaw": 0},
}
DROP = {
    "action": "pick_drop",
    "object": "plate-1",
    "from": {"x": 0.5, "y": 0.29},
    "grasp": {"yaw": 0.5},
    "drop_off": "tray",
}
PLACES = {"tray": (1.2, 0.3)}
RELOCATE = {"verdict": "relocate", "target": "cup", "relocations": [MOVE], "target_grasp": {"yaw": 0.25}}
AWAY = {"verdict": "relocate", "target": None, "relocations": [DROP], "target_grasp": None}
PARTLY = {
    "verdict": "partly_cleared",
    "relocations": [DROP],
    "left": ["cup", "plate-2"],
    "stuck": {"blocked": ["cup", "plate-2", "vase"], "core": ["cup", "vase"]},
    "proven": False,
}


def refused(words: str, answer: Any) -> None:
    with pytest.raises(Failure, match=words):
        read_answer(answer, SCENE, PLACES)


def test_each_relocation_has_a_grasp_and_a_release_and_the_targets_grasp_comes_last() -> None:
    plan = read_answer(RELOCATE, SCENE, PLACES)
    assert plan.grips == [Grip(0.4, 0.36, 0.5), Grip(0.1, 0.2, 0.0), Grip(0.4, 0.25, 0.25)]
    assert plan.words == "move plate-2, then grasp cup"


def test_what_is_taken_away_is_released_over_its_drop_off_at_the_yaw_of_its_grasp() -> None:
    plan = read_answer({**RELOCATE, "relocations": [DROP, MOVE]}, SCENE, PLACES)
    assert plan.grips[:3] == [Grip(0.5, 0.29, 0.5), Grip(1.2, 0.3, 0.5, over_drop_off=True), Grip(0.4, 0.36, 0.5)]
    assert plan.words == "take plate-1 to tray, move plate-2, then grasp cup"


def test_goals_without_a_target_end_without_a_grasp() -> None:
    both = [Grip(0.5, 0.29, 0.5), Grip(1.2, 0.3, 0.5, over_drop_off=True)]
    assert read_answer(AWAY, SCENE, PLACES) == Plan(both, "take plate-1 to tray, then all taken away")
    cleared = {"verdict": "cleared", "relocations": [DROP]}
    assert read_answer(cleared, SCENE, PLACES) == Plan(both, "take plate-1 to tray, then cleared")
    assert read_answer({**cleared, "relocations": []}, SCENE, PLACES) == Plan([], "cleared")
    left = "partly cleared: cup, plate-2 left, as far as is known; cup, vase hold each other"
    assert read_answer(PARTLY, SCENE, PLACES) == Plan(both, f"take plate-1 to tray, then {left}")
    proven = {**PARTLY, "relocations": [], "stuck": None, "proven": True}
    assert read_answer(proven, SCENE, PLACES) == Plan([], "partly cleared: cup, plate-2 left")


def test_a_target_that_can_be_grasped_has_its_grasp_alone() -> None:
    graspable = {**RELOCATE, "verdict": "graspable", "relocations": []}
    assert read_answer(graspable, SCENE, PLACES) == Plan([Grip(0.4, 0.25, 0.25)], "grasp cup")


def test_poses_are_turned_about_z_alone_and_are_all_at_one_height() -> None:
    upright, quarter = to_poses(Plan([Grip(0.1, 0.2, 0.0), Grip(0.3, 0.4, math.pi / 2)], ""), 0.9, 1.0, Pose)
    assert (upright.position.x, upright.position.y, upright.position.z) == (0.1, 0.2, 0.9)
    assert (quarter.position.x, quarter.position.y, quarter.position.z) == (0.3, 0.4, 0.9)
    turns = [upright.orientation, quarter.orientation]
    assert [(turn.x, turn.y) for turn in turns] == [(0.0, 0.0), (0.0, 0.0)]
    assert [turn.z for turn in turns] == pytest.approx([0.0, math.sqrt(0.5)])
    assert [turn.w for turn in turns] == pytest.approx([1.0, math.sqrt(0.5)])


def test_over_a_drop_off_the_tool_has_a_height_of_its_own() -> None:
    (over,) = to_poses(Plan([Grip(1.2, 0.3, 0.5, over_drop_off=True)], ""), 0.9, 1.0, Pose)
    assert (over.position.x, over.position.y, over.position.z) == (1.2, 0.3, 1.0)


def test_a_lock_and_what_would_have_to_go_are_named() -> None:
    refused("^deadlock: a, b hold each other$", {"verdict": "deadlock", "deadlock": {"core": ["a", "b"]}})
    refused("^deadlock$", {"verdict": "deadlock", "deadlock": None})
    refused("^no space: a, b would have to go$", {"verdict": "no_space", "needed": ["a", "b"]})
    refused("^timed out: a would have to go$", {"verdict": "timed_out", "needed": ["a"]})
    refused("^timed out$", {"verdict": "timed_out", "needed": None})


def test_a_verdict_or_an_action_that_is_not_known_is_refused() -> None:
    refused("unknown verdict: maybe", {"verdict": "maybe"})
    refused("unknown action: push", {**RELOCATE, "relocations": [MOVE, {**MOVE, "action": "push"}]})


@pytest.mark.parametrize(
    "answer",
    [
        None,
        [],
        {},
        {**RELOCATE, "relocations": []},
        {**RELOCATE, "verdict": "graspable"},
        {**RELOCATE, "target_grasp": None},
        {**RELOCATE, "target": None},
        {**RELOCATE, "target": "spoon"},
        {"verdict": "no_space"},
        {**AWAY, "relocations": [{**DROP, "drop_off": "shelf"}]},
        {"verdict": "cleared"},
        *({name: part for name, part in PARTLY.items() if name != missing} for missing in ("left", "stuck", "proven")),
        {**PARTLY, "proven": None},
    ],
)
def test_an_answer_of_another_shape_is_refused(answer: Any) -> None:
    refused("not understood", answer)
