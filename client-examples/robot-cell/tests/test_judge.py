"""Each judge is seen to fail, on a plan that is wrong in one way."""

import math

from robot_cell.physics.cell import Cell, Outcome, Spot
from robot_cell.physics.gantry import Gantry
from robot_cell.physics.judge import Contact, Phase
from robot_cell.physics.world import Scene, build

RADIUS = 0.075
TABLE = {"x_min": 0.0, "y_min": 0.0, "x_max": 1.2, "y_max": 0.7}
CUP = (0.4, 0.35)
BESIDE = (0.4 + 2 * RADIUS + 0.01, 0.35)
"""10 mm of room: a finger at yaw 0 does not fit, one at π/3 on either side does."""


def scene(*dishes: tuple[str, float, float], height: float = 0.08) -> Scene:
    return {
        "table": TABLE,
        "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
        "objects": [{"id": name, "x": x, "y": y, "radius": RADIUS, "height": height} for name, x, y in dishes],
        "target": "cup",
    }


def cell(*dishes: tuple[str, float, float]) -> Cell:
    return Cell(build(scene(*dishes), Gantry(TABLE)))


def hits(outcome: Outcome) -> list[tuple[Phase, str, str]]:
    return [(c.phase, c.part, c.other) for c in outcome.contacts if not c.is_touch]


def test_a_right_plan_meets_nothing() -> None:
    outcome = cell(("cup", *CUP), ("plate", *BESIDE)).relocate("cup", Spot(*CUP, math.pi / 3), Spot(0.9, 0.3, 0.0))
    assert not outcome.contacts and not outcome.disturbed and not outcome.dropped
    assert outcome.place_error is not None and outcome.place_error < 1e-4


def test_a_yaw_turned_into_a_neighbour_hits_it_at_the_descent() -> None:
    outcome = cell(("cup", *CUP), ("plate", *BESIDE)).relocate("cup", Spot(*CUP, 0.0), Spot(0.9, 0.3, 0.0))
    assert (Phase.DESCENT, "finger", "plate") in hits(outcome)


def test_a_release_yaw_turned_into_a_neighbour_hits_it() -> None:
    at = cell(("cup", 0.9, 0.3), ("plate", *BESIDE))
    outcome = at.relocate("cup", Spot(0.9, 0.3, 0.0), Spot(*CUP, 0.0))
    assert {part for phase, part, other in hits(outcome) if other == "plate"} >= {"finger"}


def test_a_place_3_mm_into_another_dish_makes_the_dishes_meet_and_disturbs_the_other() -> None:
    at = cell(("cup", 0.9, 0.3), ("plate", *BESIDE))
    into = Spot(BESIDE[0] - 2 * RADIUS + 0.003, BESIDE[1], math.pi / 3)
    outcome = at.relocate("cup", Spot(0.9, 0.3, 0.0), into)
    assert (Phase.CARRYING, "dish", "plate") in hits(outcome)
    assert "plate" in outcome.disturbed or (outcome.place_error or 0) > 1e-3


def test_a_skipped_step_leaves_the_obstacle_where_the_fingers_come_down() -> None:
    at = cell(("cup", *CUP), ("plate", *BESIDE))
    assert (Phase.DESCENT, "finger", "plate") in hits(at.take("cup", Spot(*CUP, 0.0)))
    at = cell(("cup", *CUP), ("plate", *BESIDE))
    at.relocate("plate", Spot(*BESIDE, 0.0), Spot(1.0, 0.3, 0.0))
    assert not at.take("cup", Spot(*CUP, 0.0)).contacts


def test_a_dish_that_was_never_grasped_is_dropped() -> None:
    at = cell(("cup", *CUP))
    assert at.take("cup", Spot(CUP[0] + 0.3, CUP[1], 0.0)).dropped


def test_a_palm_hits_a_neighbour_that_is_taller_than_the_fingers_are_long() -> None:
    made = scene(("cup", *CUP), ("vase", CUP[0] + RADIUS + 0.025, CUP[1]), height=0.05)
    made["objects"][1] |= {"radius": 0.02, "height": 0.12}
    assert not Cell(build(made, Gantry(TABLE))).take("cup", Spot(*CUP, math.pi)).contacts
    made["gripper"]["finger_length"] = 0.06
    assert (Phase.DESCENT, "palm", "vase") in hits(Cell(build(made, Gantry(TABLE))).take("cup", Spot(*CUP, math.pi)))


def test_a_touch_is_lighter_than_what_friction_holds() -> None:
    light = Contact(Phase.DESCENT, "finger", "plate", depth=1e-5, force=0.9, holds=1.0)
    assert light.is_touch and not Contact(Phase.DESCENT, "finger", "plate", 1e-5, 1.1, 1.0).is_touch
