from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from table import DROPPING, SETTINGS, detections, mesh, no_warning, planning_scene, pose, table, tray, vase

from singulate_ros.failure import Failure
from singulate_ros.mapping import Scene, drop_places, to_scene
from singulate_ros.settings import Settings

SEEN = planning_scene(table(), tray(), vase())


def scene(**changes: Any) -> Scene:
    return to_scene(detections(), SEEN, replace(DROPPING, **changes), no_warning)


def refused(words: str, settings: Settings) -> None:
    with pytest.raises(Failure, match=words):
        to_scene(detections(), SEEN, settings, no_warning)


def test_a_drop_off_accepts_what_is_of_its_classes_and_is_no_obstacle_beside_the_table() -> None:
    made = scene()
    assert made["drop_offs"] == [{"id": "tray", "capacity": 2, "accepts": ["plate-1", "plate-2", "plate-3"]}]
    assert [each["id"] for each in made["objects"]] == ["cup", "plate-1", "plate-2", "plate-3", "vase"]


def test_a_drop_off_without_limits_has_none_in_the_scene_and_a_full_one_is_left_out() -> None:
    two: dict[str, Any] = {"drop_offs": ["tray", "bin"], "drop_off_classes": ["", ""]}
    assert scene(**two, drop_off_capacities=[-1, 0])["drop_offs"] == [{"id": "tray"}]
    assert "drop_offs" not in scene(**two, drop_off_capacities=[0, 0])


def test_a_drop_off_is_in_the_middle_of_its_solids() -> None:
    assert drop_places(SEEN, DROPPING) == {"tray": pytest.approx((1.25, 0.35))}
    dish = mesh("tray", [(0.0, 0.0, 0.0), (0.2, 0.0, 0.0), (0.2, 0.1, 0.0), (0.0, 0.1, 0.0)], pose(1.2, 0.3, 0.5))
    assert drop_places(planning_scene(table(), dish), DROPPING) == {"tray": pytest.approx((1.3, 0.35))}
    with pytest.raises(Failure, match="no solid of the drop-off 'tray'"):
        drop_places(planning_scene(table()), DROPPING)


def test_half_a_drop_off_is_refused() -> None:
    refused("one entry for each of drop_offs", replace(DROPPING, drop_off_capacities=[2, 3]))
    refused("one entry for each of drop_offs", replace(DROPPING, drop_off_classes=[]))
    refused("'tray' has a capacity of -2", replace(DROPPING, drop_off_capacities=[-2]))
    refused("drop_z is not set", replace(DROPPING, drop_z=SETTINGS.drop_z))


def test_a_goal_stands_where_the_target_would() -> None:
    assert "goal" not in scene()
    for wish, goal in (
        ({"any_of": ["cup", "plate-1"]}, {"any_of": ["cup", "plate-1"]}),
        ({"all_of": ["plate-1", "plate-3"]}, {"all_of": ["plate-1", "plate-3"]}),
        ({"clear": True}, {"clear": True}),
    ):
        made = scene(target="", **wish)
        assert made["goal"] == goal and "target" not in made


def test_of_several_wanted_ones_those_that_are_not_on_the_table_are_left_out() -> None:
    assert scene(target="", any_of=["spoon", "cup"])["goal"] == {"any_of": ["cup"]}
    assert scene(target="", all_of=["plate-1", "spoon"])["goal"] == {"all_of": ["plate-1"]}
    refused("none of spoon, fork is on the table", replace(DROPPING, target="", any_of=["spoon", "fork"]))


def test_exactly_one_thing_is_wanted() -> None:
    refused("one of the parameters", replace(DROPPING, target=""))
    refused("one of the parameters", replace(DROPPING, any_of=["cup"]))
    refused("one of the parameters", replace(DROPPING, clear=True))


def test_a_hand_and_a_destination_go_with_the_scene_where_they_are_set() -> None:
    assert not {"max_opening", "opening"} & scene()["gripper"].keys() and "destination" not in scene()["settings"]
    assert not {"finger_length", "palm_radius", "tip_height"} & scene()["gripper"].keys()
    made = scene(max_opening=0.16, opening="full", destination="drop_off")
    assert (made["gripper"]["max_opening"], made["gripper"]["opening"]) == (0.16, "full")
    palm = scene(finger_length=0.12, palm_radius=0.05, tip_height=0.005)["gripper"]
    assert (palm["finger_length"], palm["palm_radius"], palm["tip_height"]) == (0.12, 0.05, 0.005)
    assert made["settings"]["destination"] == "drop_off"
