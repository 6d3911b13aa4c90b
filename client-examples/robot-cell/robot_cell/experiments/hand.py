"""What a hand makes of an error: how far a dish that was seen beside its place stands beside its new one."""

import argparse
import math
from dataclasses import dataclass

import numpy as np

from ..physics.cell import Cell, Spot
from ..physics.gantry import Gantry
from ..physics.robotiq import CLEARANCE, FINGER_WIDTH
from ..physics.world import Scene, build
from . import Figures
from .arguments import positive, whole

OFFSETS = [0.001, 0.003, 0.005]
"""Between where the dish stands and where it was seen, m."""
HEIGHT = 0.03
"""Of the dish, m: as low as the 2F-85 wants it."""
TABLE = {"x_min": 0.0, "y_min": 0.0, "x_max": 1.0, "y_max": 1.0}


@dataclass(frozen=True)
class Kind:
    name: str
    radius: float
    gripper: dict[str, float]


def pads(fingers: int, width: float) -> dict[str, float]:
    return {"fingers": fingers, "finger_width": width, "clearance": 0.05}


JAWS = {"fingers": 2, "finger_width": FINGER_WIDTH, "clearance": CLEARANCE}
KINDS = [
    Kind("two jaws (2F-85), dish of 60 mm", 0.03, JAWS),
    Kind("three pads 10 mm wide, dish of 60 mm", 0.03, pads(3, 0.01)),
    Kind("three pads 20 mm wide, dish of 60 mm", 0.03, pads(3, 0.02)),
    Kind("three pads 20 mm wide, dish of 100 mm", 0.05, pads(3, 0.02)),
    Kind("three pads 20 mm wide, dish of 150 mm", 0.075, pads(3, 0.02)),
    Kind("four pads 20 mm wide, dish of 150 mm", 0.075, pads(4, 0.02)),
]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--grasps", type=positive, default=50, help="of each hand and offset (default: 50)")
    parser.add_argument("--seed", type=whole, default=0, help="(default: 0)")


def measure(options: argparse.Namespace, _url: str) -> Figures:
    rows = []
    for kind in KINDS:
        for offset in OFFSETS:
            random = np.random.default_rng(options.seed)
            left = [place_error(kind, offset, random) for _ in range(options.grasps)]
            rows.append({"hand": kind.name, "offset": offset, "mean": sum(left) / len(left), "worst": max(left)})
    return {"grasps": options.grasps, "seed": options.seed, "rows": rows}


def place_error(kind: Kind, offset: float, random: np.random.Generator) -> float:
    """Of one dish that stands `offset` beside where it was seen, after it was carried, m."""
    way, grasp, release = random.uniform(0, 2 * math.pi, 3)
    seen = np.array([0.3, 0.3])
    x, y = seen + offset * np.array([math.cos(way), math.sin(way)])
    cell = Cell(build(alone(kind, float(x), float(y)), Gantry(TABLE)))
    outcome = cell.relocate("dish", Spot(float(seen[0]), float(seen[1]), grasp), Spot(0.6, 0.6, release))
    assert outcome.place_error is not None
    return outcome.place_error


def alone(kind: Kind, x: float, y: float) -> Scene:
    dish = {"id": "dish", "x": x, "y": y, "radius": kind.radius, "height": HEIGHT}
    return {"table": TABLE, "gripper": kind.gripper, "objects": [dish], "target": "dish"}


def text(figures: Figures) -> str:
    return "\n".join(
        f"{row['hand']}, seen {1e3 * row['offset']:g} mm off: "
        f"{1e3 * row['mean']:.2f} mm off its new place, worst {1e3 * row['worst']:.2f} mm"
        for row in figures["rows"]
    )
