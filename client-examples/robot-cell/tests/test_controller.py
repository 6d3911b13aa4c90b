"""The controller against a service that says what the test wants."""

import json
from typing import Any

import httpx
import numpy as np
import pytest
from test_judge import TABLE, scene

from robot_cell.client import service as calls
from robot_cell.client.controller import Controller, Episode
from robot_cell.client.service import Service
from robot_cell.physics.camera import Camera
from robot_cell.physics.cell import Outcome, Spot
from robot_cell.physics.gantry import Gantry
from robot_cell.physics.world import build

STEP: dict[str, Any] = {
    "action": "pick_place",
    "object": "plate",
    "from": {"x": 0.56, "y": 0.35},
    "to": {"x": 1.0, "y": 0.3},
    "grasp": {"yaw": 0.0},
    "release": {"yaw": 0.5},
}
RELOCATE: dict[str, Any] = {
    "verdict": "relocate",
    "target": "cup",
    "relocations": [STEP],
    "target_grasp": {"yaw": 0.1},
    "cost": 1,
    "deadlock": None,
    "needed": None,
    "warnings": [],
}
DROP: dict[str, Any] = {
    "action": "pick_drop",
    "object": "plate",
    "from": {"x": 0.56, "y": 0.35},
    "grasp": {"yaw": 0.0},
    "drop_off": "tray",
}
AWAY: dict[str, Any] = {**RELOCATE, "target": None, "relocations": [DROP], "target_grasp": None}
PARTLY: dict[str, Any] = {
    **AWAY,
    "verdict": "partly_cleared",
    "left": ["cup"],
    "stuck": {"blocked": ["cup", "vase"], "core": ["cup", "vase"]},
    "proven": False,
}
GRASPABLE = {**RELOCATE, "verdict": "graspable", "relocations": [], "cost": 0}


class StillCell:
    """Carries out nothing, and remembers what it should have."""

    def __init__(self) -> None:
        table = scene(("cup", 0.4, 0.35), ("plate", 0.56, 0.35))
        self.world = build({**table, "drop_offs": [{"id": "tray"}]}, Gantry(TABLE))
        self.done: list[str] = []

    def relocate(self, name: str, _grasp: Spot, _release: Spot) -> Outcome:
        self.done.append(f"relocate {name}")
        return Outcome(name)

    def take_away(self, name: str, _grasp: Spot, drop_off: str) -> Outcome:
        self.done.append(f"take {name} to {drop_off}")
        return Outcome(name)

    def take(self, name: str, _grasp: Spot) -> Outcome:
        self.done.append(f"take {name}")
        return Outcome(name)


def run(*answers: Any, **options: Any) -> tuple[Episode, StillCell, list[str]]:
    """An episode with these answers in turn: a body, or a status with a body. Also the paths that were asked for."""
    left, asked = list(answers), []

    def answer(request: httpx.Request) -> httpx.Response:
        asked.append(request.url.path)
        body = left.pop(0)
        status, body = body if isinstance(body, tuple) else (200, body)
        seen = json.loads(request.content)
        if request.url.path == "/v1/plans":
            body = {"scene_id": seen["scene_id"], **body}
        return httpx.Response(status, json=body, headers={"retry-after": "0"})

    cell = StillCell()
    camera = Camera(cell.world, 0.0, np.random.default_rng(0))
    with Service("http://service", transport=httpx.MockTransport(answer)) as service:
        episode = Controller(service, cell, camera, **options).run()  # type: ignore[arg-type]
    return episode, cell, asked


def test_one_step_then_a_look_and_another_plan() -> None:
    episode, cell, asked = run(RELOCATE, GRASPABLE)
    assert episode.end == "in_hand" and cell.done == ["relocate plate", "take cup"]
    assert asked == ["/v1/plans", "/v1/plans"]


def test_a_plan_that_still_holds_is_not_asked_for_again() -> None:
    episode, cell, asked = run(RELOCATE, {"valid": True, "replan": False}, position_tolerance=0.006)
    assert cell.done == ["relocate plate", "take cup"] and asked == ["/v1/plans", "/v1/plans/verify"]
    assert (episode.plans, episode.verifications) == (1, 1)


def test_a_plan_that_no_longer_holds_is_made_anew() -> None:
    _, cell, asked = run(RELOCATE, {"valid": False, "replan": True}, GRASPABLE, position_tolerance=0.006)
    assert cell.done == ["relocate plate", "take cup"]
    assert asked == ["/v1/plans", "/v1/plans/verify", "/v1/plans"]


def test_a_verdict_without_a_plan_ends_the_episode_and_says_why() -> None:
    none = {**GRASPABLE, "cost": None, "target_grasp": None}
    episode, cell, _ = run({**none, "verdict": "deadlock", "deadlock": {"core": ["cup", "plate"]}})
    assert (episode.end, episode.detail, cell.done) == ("deadlock", "cup, plate hold each other", [])
    episode, cell, _ = run({**none, "verdict": "no_space", "needed": ["plate"]})
    assert (episode.end, episode.detail, cell.done) == ("no_space", "plate would have to go", [])


def test_what_is_taken_away_ends_with_its_last_step() -> None:
    for tolerance in (None, 0.006):
        episode, cell, asked = run(AWAY, position_tolerance=tolerance)
        assert (episode.end, cell.done, asked) == ("all_away", ["take plate to tray"], ["/v1/plans"])


def test_a_clearing_ends_with_what_is_left() -> None:
    episode, cell, _ = run(PARTLY)
    assert (episode.end, cell.done) == ("partly_cleared", ["take plate to tray"])
    assert episode.detail == "cup left, as far as is known; cup, vase hold each other"
    episode, cell, _ = run({**PARTLY, "relocations": [], "stuck": None, "proven": True})
    assert (episode.end, episode.detail, cell.done) == ("partly_cleared", "cup left", [])
    assert run({**AWAY, "verdict": "cleared"})[0].end == "cleared"


def test_a_target_is_grasped_after_what_was_in_its_way_is_taken_away() -> None:
    episode, cell, asked = run({**RELOCATE, "relocations": [DROP]}, GRASPABLE)
    assert (episode.end, cell.done) == ("in_hand", ["take plate to tray", "take cup"])


def test_a_drop_off_that_accepts_what_is_away_is_no_fault_and_an_unknown_one_is_refused() -> None:
    gone = {**AWAY, "warnings": [{"code": "unknown_object", "pointer": "/drop_offs/0/accepts/1"}]}
    assert run(gone)[0].end == "all_away"
    episode, cell, _ = run({**AWAY, "relocations": [{**DROP, "drop_off": "shelf"}]})
    assert (episode.end, cell.done) == ("refused", [])


def test_more_time_is_asked_for_once() -> None:
    late = {**GRASPABLE, "verdict": "timed_out", "cost": None}
    assert run(late, GRASPABLE)[0].end == "in_hand"
    assert run(late, late)[0].end == "timed_out"


def test_a_busy_service_is_asked_again_and_at_last_given_up() -> None:
    busy = (503, {"title": "Busy"})
    assert run(busy, busy, GRASPABLE)[0].end == "in_hand"
    with pytest.raises(calls.GaveUp):
        run(*[busy] * calls.TRIES)


def test_a_key_that_is_refused_is_no_outcome_of_the_episode() -> None:
    with pytest.raises(calls.Refused, match="Not authorized"):
        run((401, {"title": "Not authorized"}))


def test_a_fault_of_the_service_is_asked_again_once() -> None:
    fault = (500, {"title": "Fault"})
    assert run(fault, GRASPABLE)[0].end == "in_hand"
    assert run(fault, fault)[0].end == "refused"


def test_a_scene_that_is_refused_is_looked_at_again() -> None:
    refused = (422, {"title": "No", "errors": []})
    assert run(refused, GRASPABLE)[0].end == "in_hand"
    assert run(*[refused] * 5)[0].end == "refused"


def test_unknown_verdicts_and_actions_and_faulty_plans_are_refused() -> None:
    unknown = {**RELOCATE, "relocations": [{**STEP, "action": "push"}]}
    faulty = {**RELOCATE, "warnings": [{"code": "release_blocked", "pointer": "/objects/1"}]}
    assert run({**GRASPABLE, "verdict": "perhaps"})[0].end == "refused"
    assert run(unknown)[0].end == "refused"
    assert run(faulty)[0].end == "refused"
    assert run(faulty, GRASPABLE, trusting=True)[0].end == "in_hand"


def test_a_cost_that_does_not_fall_ends_it() -> None:
    assert run(*[RELOCATE] * 4)[0].end == "no_progress"
