from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest
from geometry_msgs.msg import Pose
from table import SETTINGS, detection, detections, no_warning, planning_scene, table, vase

from singulate_ros.answer import Grip, Plan, read_answer, read_warnings, to_poses
from singulate_ros.failure import Failure
from singulate_ros.mapping import to_scene

BOX = detection("box", "carton", 0.7, 0.1, 0.06, 0.08)
SCENE = to_scene(detections(BOX), planning_scene(table(), vase()), SETTINGS, no_warning)
MOVE = {
    "action": "pick_place",
    "object": "plate-2",
    "from": {"x": 0.4, "y": 0.36},
    "to": {"x": 0.1, "y": 0.2},
    "grasp": {"x": 0.4, "y": 0.36, "yaw": 0.5},
    "release": {"x": 0.1, "y": 0.2, "yaw": 0},
}
TURN = {
    "action": "pick_place",
    "object": "box",
    "from": {"x": 0.7, "y": 0.1, "yaw": 0.3},
    "to": {"x": 0.1, "y": 0.4, "yaw": 1.8},
    "grasp": {"x": 0.71, "y": 0.12, "yaw": 1.25},
    "release": {"x": 0.08, "y": 0.41, "yaw": 2.75},
    "turn": 1.5,
}
DROP = {
    "action": "pick_drop",
    "object": "plate-1",
    "from": {"x": 0.5, "y": 0.29},
    "grasp": {"x": 0.5, "y": 0.29, "yaw": 0.5},
    "drop_off": "tray",
}
PLACES = {"tray": (1.2, 0.3)}
GRASP = {"x": 0.4, "y": 0.25, "yaw": 0.25}
RELOCATE = {"verdict": "relocate", "target": "cup", "relocations": [MOVE], "target_grasp": GRASP}
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


def test_the_gripper_stands_where_the_answer_says_beside_the_middle_too() -> None:
    plan = read_answer({**RELOCATE, "relocations": [TURN], "target_grasp": {**GRASP, "x": 0.42}}, SCENE, PLACES)
    assert plan.grips == [Grip(0.71, 0.12, 1.25), Grip(0.08, 0.41, 2.75), Grip(0.42, 0.25, 0.25)]
    assert plan.words == "move box turned by 1.500 to yaw 1.800, then grasp cup"


def test_over_what_is_higher_than_the_fingers_are_long_the_tool_stays_up() -> None:
    short = replace(SETTINGS, finger_length=0.06, palm_radius=0.03, tip_height=0.01)
    scene = to_scene(detections(BOX), planning_scene(table()), short, no_warning)
    plan = read_answer({**RELOCATE, "relocations": [DROP, TURN]}, scene, PLACES)
    assert [grip.lift for grip in plan.grips] == pytest.approx(5 * [0.03])
    heights = [pose.position.z for pose in to_poses(plan, 0.9, 1.0, Pose)]
    assert heights == pytest.approx([0.93, 1.03, 0.93, 0.93, 0.93])


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
        {**RELOCATE, "target_grasp": {"yaw": 0.25}},
        {**RELOCATE, "relocations": [{**MOVE, "object": "spoon"}]},
        {**RELOCATE, "relocations": [{**MOVE, "grasp": {"yaw": 0.5}}]},
        {**RELOCATE, "relocations": [{**TURN, "turn": "half"}]},
        {**RELOCATE, "relocations": [{**TURN, "to": {"x": 0.1, "y": 0.4}}]},
        {"verdict": "no_space"},
        {**AWAY, "relocations": [{**DROP, "drop_off": "shelf"}]},
        {"verdict": "cleared"},
        *({name: part for name, part in PARTLY.items() if name != missing} for missing in ("left", "stuck", "proven")),
        {**PARTLY, "proven": None},
    ],
)
def test_an_answer_of_another_shape_is_refused(answer: Any) -> None:
    refused("not understood", answer)


def test_warnings_are_read_in_the_words_of_the_service() -> None:
    warning = {"code": "no_grasp", "pointer": "/objects/7", "detail": "'napkin' has no grasp"}
    assert read_warnings({"warnings": [warning]}) == ["no_grasp /objects/7: 'napkin' has no grasp"]
    for torn in (None, {}, {"warnings": None}, {"warnings": [{"code": "no_grasp"}]}):
        with pytest.raises(Failure, match="not understood"):
            read_warnings(torn)
