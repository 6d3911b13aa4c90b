"""Each judge is seen to fail, on a plan that is wrong in one way."""

import math

from robot_cell.experiments.tally import went_wrong
from robot_cell.physics.cell import Cell, Outcome, Spot
from robot_cell.physics.gantry import Gantry
from robot_cell.physics.judge import Contact, Judge, Phase
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


def fails(outcome: Outcome) -> bool:
    return went_wrong({"steps": [outcome.to_json()]})


def test_a_right_plan_meets_nothing() -> None:
    outcome = cell(("cup", *CUP), ("plate", *BESIDE)).relocate("cup", Spot(*CUP, math.pi / 3), Spot(0.9, 0.3, 0.0))
    assert not outcome.contacts and not outcome.disturbed and not fails(outcome)
    assert outcome.place_error is not None and outcome.place_error < 1e-4


def test_a_yaw_turned_into_a_neighbour_hits_it_at_the_descent() -> None:
    outcome = cell(("cup", *CUP), ("plate", *BESIDE)).relocate("cup", Spot(*CUP, 0.0), Spot(0.9, 0.3, 0.0))
    assert (Phase.DESCENT, "finger", "plate") in hits(outcome) and fails(outcome)


def test_a_release_yaw_turned_into_a_neighbour_hits_it() -> None:
    at = cell(("cup", 0.9, 0.3), ("plate", *BESIDE))
    outcome = at.relocate("cup", Spot(0.9, 0.3, 0.0), Spot(*CUP, 0.0))
    assert "finger" in {part for _, part, other in hits(outcome) if other == "plate"} and fails(outcome)


def test_a_place_3_mm_into_another_dish_makes_the_dishes_meet_and_disturbs_the_other() -> None:
    at = cell(("cup", 0.9, 0.3), ("plate", *BESIDE))
    into = Spot(BESIDE[0] - 2 * RADIUS + 0.003, BESIDE[1], math.pi / 3)
    outcome = at.relocate("cup", Spot(0.9, 0.3, 0.0), into)
    assert (Phase.CARRYING, "dish", "plate") in hits(outcome)
    assert outcome.disturbed["plate"] > 1e-3 and fails(outcome)


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


def test_a_slender_dish_tips_before_it_slides() -> None:
    made = scene(("cup", *CUP), ("plate", 0.8, 0.35))
    made["objects"].append({"id": "post", "x": 0.8, "y": 0.6, "radius": 0.02, "height": 0.08})
    firm = Judge(build(made, Gantry(TABLE)))._holds
    mass = 200 * math.pi * 0.02**2 * 0.08
    assert firm["dish:post"] < 0.26 * mass * 9.81 and firm["dish:plate"] > 0.4 * 0.28 * 9.81


def test_pushes_that_are_small_by_themselves_add_up() -> None:
    at = cell(("cup", *CUP), ("plate", 0.8, 0.35))
    for _ in range(2):
        at.world.data.joint("dish:plate").qpos[0] += 0.0007
        outcome = at.relocate("cup", Spot(*CUP, 0.0), Spot(*CUP, 0.0))
    assert 0.0013 < outcome.disturbed["plate"] < 0.0016


def test_a_dish_that_leans_is_disturbed_and_one_beyond_the_edge_is_dropped() -> None:
    at = cell(("cup", *CUP), ("plate", 0.8, 0.35))
    outcome = Outcome("cup")
    at.world.data.joint("dish:plate").qpos[3:] = math.cos(0.05), math.sin(0.05), 0.0, 0.0
    at.judge.start("cup")
    at._judge(outcome)
    assert outcome.disturbed["plate"] > 0.005 and not outcome.dropped
    at.world.data.joint("dish:plate").qpos[0] = TABLE["x_max"] + 0.001
    at._judge(outcome)
    assert outcome.dropped


def test_a_touch_is_lighter_than_what_friction_holds() -> None:
    light = Contact(Phase.DESCENT, "finger", "plate", depth=1e-5, force=0.9, holds=1.0)
    assert light.is_touch and not Contact(Phase.DESCENT, "finger", "plate", 1e-5, 1.1, 1.0).is_touch
