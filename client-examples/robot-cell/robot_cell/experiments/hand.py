"""What a hand makes of an error: how far a dish that was seen beside its place stands beside its new one."""

import argparse
import math

import numpy as np

from ..physics.cell import Cell, Spot
from ..physics.gantry import Gantry
from ..physics.robotiq import CLEARANCE, FINGER_WIDTH
from ..physics.world import Scene, build
from . import Figures

OFFSETS = [0.001, 0.003, 0.005]
"""Between where the dish stands and where it was seen, m."""
RADIUS, HEIGHT = 0.03, 0.03
TABLE = {"x_min": 0.0, "y_min": 0.0, "x_max": 1.0, "y_max": 1.0}
HANDS: dict[str, dict[str, float]] = {
    "two jaws (2F-85)": {"fingers": 2, "finger_width": FINGER_WIDTH, "clearance": CLEARANCE},
    "three pads 10 mm wide": {"fingers": 3, "finger_width": 0.01, "clearance": 0.03},
    "three pads 25 mm wide": {"fingers": 3, "finger_width": 0.025, "clearance": 0.03},
    "four pads 10 mm wide": {"fingers": 4, "finger_width": 0.01, "clearance": 0.03},
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--grasps", type=int, default=50, help="of each hand and offset (default: 50)")
    parser.add_argument("--seed", type=int, default=0, help="(default: 0)")


def measure(options: argparse.Namespace, _url: str) -> Figures:
    rows = []
    for name, gripper in HANDS.items():
        for offset in OFFSETS:
            random = np.random.default_rng(options.seed)
            left = [place_error(gripper, offset, random) for _ in range(options.grasps)]
            rows.append({"hand": name, "offset": offset, "mean": sum(left) / len(left), "worst": max(left)})
    return {"grasps": options.grasps, "seed": options.seed, "rows": rows}


def place_error(gripper: dict[str, float], offset: float, random: np.random.Generator) -> float:
    """Of one dish that stands `offset` beside where it was seen, after it was carried, m."""
    way, grasp, release = random.uniform(0, 2 * math.pi, 3)
    seen = np.array([0.3, 0.3])
    x, y = seen + offset * np.array([math.cos(way), math.sin(way)])
    cell = Cell(build(alone(gripper, float(x), float(y)), Gantry(TABLE)))
    outcome = cell.relocate("dish", Spot(float(seen[0]), float(seen[1]), grasp), Spot(0.6, 0.6, release))
    assert outcome.place_error is not None
    return outcome.place_error


def alone(gripper: dict[str, float], x: float, y: float) -> Scene:
    dish = {"id": "dish", "x": x, "y": y, "radius": RADIUS, "height": HEIGHT}
    return {"table": TABLE, "gripper": gripper, "objects": [dish], "target": "dish"}


def text(figures: Figures) -> str:
    return "\n".join(
        f"{row['hand']}, seen {1e3 * row['offset']:g} mm off: "
        f"{1e3 * row['mean']:.2f} mm off its new place, worst {1e3 * row['worst']:.2f} mm"
        for row in figures["rows"]
    )
