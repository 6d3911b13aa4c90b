"""Palms over neighbours of different heights: how long the fingers have to be."""

import argparse
from typing import Any

import numpy as np

from ..physics.world import Scene
from . import Figures
from .arguments import add_jobs, positive, whole
from .episodes import Task, each
from .server import generate
from .text import rows, share

OBJECTS = 24
RADIUS = "0.03..0.08"
HEIGHTS = 0.04, 0.12
"""The lowest dish and the tallest one, m."""
LENGTHS = [0.07, 0.09, 0.11, 0.13]
"""Of the fingers, m. Only the last is longer than the tallest dish is high."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_jobs(parser)
    parser.add_argument("--episodes", type=positive, default=60, help="of each length (default: 60)")
    parser.add_argument("--seed", type=whole, default=0, help="of the first scene (default: 0)")


def measure(options: argparse.Namespace, url: str) -> Figures:
    seeds = range(options.seed, options.seed + options.episodes)
    tasks = [Task(url, scene_with(length, seed)) for length in LENGTHS for seed in seeds]
    episodes = each(tasks, options.jobs, "palm")
    found = []
    for length in LENGTHS:
        steps = [step for _ in seeds for step in next(episodes)["steps"]]
        found.append({"finger_length": length, "steps": len(steps), "palm_meets": sum(map(meets_palm, steps))})
    return {"objects": OBJECTS, "heights": HEIGHTS, "episodes": options.episodes, "seed": options.seed, "rows": found}


def scene_with(finger_length: float, seed: int) -> Scene:
    """Only dishes that go under the palm are ever grasped; the taller ones are fixed."""
    scene = generate(OBJECTS, seed, radius=RADIUS)
    random = np.random.default_rng(seed)
    for item in scene["objects"]:
        item["height"] = float(random.uniform(*HEIGHTS))
        item["fixed"] = item["height"] > finger_length - 0.01
    low = [item["id"] for item in scene["objects"] if not item["fixed"]]
    scene["gripper"]["finger_length"] = finger_length
    return {**scene, "target": low[0]}


def meets_palm(step: dict[str, Any]) -> bool:
    return any(contact["part"] == "palm" for contact in step["contacts"])


def text(figures: Figures) -> str:
    body = [[f"{1e3 * row['finger_length']:g} mm", share(row["palm_meets"], row["steps"])] for row in figures["rows"]]
    return rows(["fingers", "steps in which the palm meets a neighbour"], body)
