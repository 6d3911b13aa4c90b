"""How deep the simulator says things are in each other that certainly touch nothing."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import mujoco
import numpy as np

from .centric_hand import CentricHand
from .gantry import Gantry
from .mechanism import ToolPose
from .world import HEIGHT, Scene, World, build, dish

GREATEST_GAP = 1e-5
"""Gaps are drawn from 0 to this, m."""
CLEARANCE = 0.05
FINGER_WIDTH = 0.02


@dataclass(frozen=True)
class Tolerance:
    pairs: int
    reported: int
    """Pairs apart that are reported as overlapping."""
    deepest: float
    """Of those, m."""

    def to_json(self) -> dict[str, object]:
        return {"pairs": self.pairs, "reported": self.reported, "deepest": self.deepest}


def of_pads(pairs: int, seed: int) -> Tolerance:
    """Pads of an open hand beside a dish, its side or an edge towards it."""
    return _measure(pairs, seed, _beside_a_pad)


def of_dishes(pairs: int, seed: int) -> Tolerance:
    """A dish in the hand beside another one."""
    return _measure(pairs, seed, _beside_a_dish)


def _measure(pairs: int, seed: int, draw: Callable[[np.random.Generator], float | None]) -> Tolerance:
    random = np.random.default_rng(seed)
    depths = [depth for _ in range(pairs) if (depth := draw(random)) is not None]
    return Tolerance(pairs, len(depths), max(depths, default=0.0))


def _beside_a_pad(random: np.random.Generator) -> float | None:
    grasped, radius, yaw = random.uniform(0.02, 0.09), random.uniform(0.02, 0.09), random.uniform(0, 2 * math.pi)
    gap = random.uniform(0, GREATEST_GAP)
    world = build(_scene([("a", 0.0, 0.0, grasped), ("b", 1.0, 1.0, radius)]), Gantry(_TABLE))
    hand = world.hand
    assert isinstance(hand, CentricHand)
    inner = hand.open_for(grasped)
    # A point on the pad's border and the direction away from it.
    middle, half = np.array([inner + hand.thickness / 2, 0]), np.array([hand.thickness, FINGER_WIDTH]) / 2
    way = random.uniform(0, 2 * math.pi)
    out = np.array([math.cos(way), math.sin(way)])
    corner = middle + half * np.sign(out)
    border = _on_the_face(random, middle, half) if random.random() < 0.5 else (corner, out)
    centre = border[0] + border[1] * (radius + gap)
    turn = np.array([[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]])
    return _depth(world, ToolPose(0, 0, 0.005, yaw), inner, {"b": turn @ centre}, "finger0")


def _on_the_face(random: np.random.Generator, middle: np.ndarray, half: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    axis, side = random.integers(2), random.choice([-1.0, 1.0])
    out = np.zeros(2)
    out[axis] = side
    along = random.uniform(-1, 1) * half[1 - axis]
    point = middle + out * half[axis]
    point[1 - axis] += along
    return point, out


def _beside_a_dish(random: np.random.Generator) -> float | None:
    one, other, way = random.uniform(0.02, 0.09), random.uniform(0.02, 0.09), random.uniform(0, 2 * math.pi)
    apart = one + other + random.uniform(0, GREATEST_GAP)
    world = build(_scene([("a", 0.0, 0.0, one), ("b", 1.0, 1.0, other)]), Gantry(_TABLE))
    place = apart * np.array([math.cos(way), math.sin(way)])
    return _depth(world, ToolPose(0.5, 0.5, 0.4, 0), 0.1, {"a": np.zeros(2), "b": place}, dish("a"))


def _depth(world: World, tool: ToolPose, opening: float, places: dict[str, np.ndarray], mine: str) -> float | None:
    model, data = world.model, world.data
    for axis, value in zip(("x", "y", "z", "yaw"), (tool.x, tool.y, tool.z, tool.yaw)):
        data.joint(f"gantry_{axis}").qpos[0] = value
    for finger in range(world.hand.fingers):
        data.joint(f"finger{finger}").qpos[0] = opening
    for name, place in places.items():
        data.joint(dish(name)).qpos[:2] = place
    mujoco.mj_forward(model, data)
    pair = {model.geom(mine).id, model.geom(dish("b")).id}
    depths = [-c.dist for c in data.contact[: data.ncon] if set(map(int, c.geom)) == pair and c.dist < 0]
    return max(depths, default=None)


_TABLE = {"x_min": -0.5, "y_min": -0.5, "x_max": 1.5, "y_max": 1.5}


def _scene(dishes: list[tuple[str, float, float, float]]) -> Scene:
    return {
        "table": _TABLE,
        "gripper": {"fingers": 3, "finger_width": FINGER_WIDTH, "clearance": CLEARANCE},
        "objects": [{"id": name, "x": x, "y": y, "radius": radius, "height": HEIGHT} for name, x, y, radius in dishes],
        "target": "a",
    }
