"""A table that is cleared, in physics: by the plans of the service that `SINGULATE` names, and by a wrong one."""

import json
import math
from pathlib import Path
from typing import Any

import pytest
from test_judge import BESIDE, CUP, RADIUS, TABLE, fails, hits, scene

from robot_cell.experiments.episodes import Task, run
from robot_cell.experiments.server import service
from robot_cell.experiments.tally import is_clean
from robot_cell.physics import drop_offs
from robot_cell.physics.cell import Cell, Spot
from robot_cell.physics.gantry import Gantry
from robot_cell.physics.judge import Phase
from robot_cell.physics.world import Scene, build

SCENES = Path(__file__).parents[2] / "scenes"


def carried_out(name: str, **options: Any) -> dict[str, Any]:
    task = json.loads((SCENES / f"{name}.json").read_text(encoding="utf-8"))
    with service() as url:
        return run(Task(url, task, **options))


def with_tray(*dishes: tuple[str, float, float], **gripper: Any) -> Cell:
    made: Scene = scene(*dishes)
    made["gripper"] |= gripper
    made["drop_offs"] = [{"id": "tray", "capacity": 2}]
    return Cell(build(made, Gantry(TABLE)))


@pytest.mark.parametrize("mechanism", ["gantry", "arm"])
def test_a_table_is_cleared_without_any_contact(mechanism: str) -> None:
    episode = carried_out("clear-table", mechanism=mechanism)
    assert is_clean(episode), episode
    taken = {step["object"]: step["drop_off"] for step in episode["steps"]}
    plates = dict.fromkeys(("plate-1", "plate-2", "plate-3"), "bin")
    assert taken == plates | dict.fromkeys(("cup-1", "cup-3", "glass-2"), "tray")
    assert episode["end"] == "partly_cleared" and episode["detail"].startswith("platter, cup-2, glass-1 left")


def test_what_is_left_of_a_plan_that_holds_is_carried_out_as_well() -> None:
    episode = carried_out("all-of", position_tolerance=0.006)
    assert is_clean(episode) and episode["end"] == "all_away"
    # After the last step nothing is asked.
    assert (episode["plans"], episode["verifications"], len(episode["steps"])) == (1, 4, 5)


def test_what_is_taken_away_too_early_is_hit() -> None:
    outcome = with_tray(("cup", *CUP), ("plate", *BESIDE)).take_away("cup", Spot(*CUP, 0.0), "tray")
    assert (Phase.DESCENT, "finger", "plate") in hits(outcome) and fails(outcome)


def test_what_is_away_is_neither_in_the_scene_nor_in_the_way() -> None:
    cell = with_tray(("cup", *CUP), ("plate", *BESIDE), ("bowl", 0.9, 0.3))
    for name, x, y in (("plate", *BESIDE), ("bowl", 0.9, 0.3)):
        outcome = cell.take_away(name, Spot(x, y, 0.0), "tray")
        assert not outcome.contacts and not fails(outcome)
        assert outcome.place_error is not None and outcome.place_error < 1e-4
    assert [item["id"] for item in cell.world.scene["objects"]] == ["cup"] and cell.world.scene["drop_offs"] == []
    assert not cell.take("cup", Spot(*CUP, 0.0)).contacts


def test_a_dish_that_is_lost_on_the_way_is_not_at_the_drop_off() -> None:
    cell = with_tray(("cup", *CUP))
    assert cell.take_away("cup", Spot(CUP[0] + 0.3, CUP[1], 0.0), "tray").dropped
    assert [item["id"] for item in cell.world.scene["objects"]] == ["cup"]
    assert cell.world.scene["drop_offs"] == [{"id": "tray", "capacity": 2}]


def test_a_hand_that_always_opens_in_full_needs_the_room_for_it() -> None:
    half_turn = math.pi
    narrow = [("cup", *CUP), ("plate", CUP[0] - 2 * RADIUS - 0.055, CUP[1])]
    fit = with_tray(*narrow, max_opening=0.25)
    assert not fit.take_away("cup", Spot(*CUP, half_turn), "tray").contacts
    full = with_tray(*narrow, max_opening=0.25, opening="full")
    assert (Phase.DESCENT, "finger", "plate") in hits(full.take_away("cup", Spot(*CUP, half_turn), "tray"))


def test_no_hand_opens_wider_than_it_can() -> None:
    """A cup that was seen 3 mm off its place has only 2 mm on each side."""
    tight = with_tray(("cup", CUP[0] + 0.003, CUP[1]), max_opening=2 * RADIUS + 0.004)
    assert (Phase.DESCENT, "finger", "cup") in hits(tight.take_away("cup", Spot(*CUP, 0.0), "tray"))
    wide = with_tray(("cup", CUP[0] + 0.003, CUP[1]), max_opening=2 * RADIUS + 0.008)
    assert not wide.take_away("cup", Spot(*CUP, 0.0), "tray").contacts


def test_drop_offs_stand_apart_on_both_sides_of_the_table() -> None:
    made = scene(("cup", *CUP))
    made["drop_offs"] = [{"id": str(at)} for at in range(4)]
    at = drop_offs.places(made)
    room = RADIUS + 0.05
    assert all(x > TABLE["x_max"] + room for x, _ in (at["0"], at["2"]))
    assert all(x < TABLE["x_min"] - room for x, _ in (at["1"], at["3"]))
    assert math.dist(at["0"], at["2"]) >= 2 * room and at["1"][1] == at["0"][1]
