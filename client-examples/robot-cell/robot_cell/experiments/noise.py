"""How many millimetres of error a plan survives: the camera's errors against the margin that is planned with."""

import argparse
import copy
from itertools import product

from ..physics.camera import e_place
from ..physics.world import Scene
from . import Figures
from .arguments import add_jobs, not_negative, positive, whole
from .episodes import Task, each
from .server import GREATEST_OVERLAP, generate
from .tally import tally
from .text import rows, share

OBJECTS = 20
SIGMAS = [0.0005, 0.001, 0.002, 0.003, 0.005]
MARGINS = [0.0, 0.001, 0.002, 0.003, 0.004, 0.006, 0.008, 0.010]
YAW_TOLERANCES = [0.0, 0.05]
LEAST_OVERLAP = 0.001
"""The service's own `overlap_tolerance`, m."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_jobs(parser)
    parser.add_argument("--episodes", type=positive, default=100, help="episodes a cell of the table (default: 100)")
    parser.add_argument("--seed", type=whole, default=0, help="of the first scene (default: 0)")
    lists = {"sigmas": (SIGMAS, "m"), "margins": (MARGINS, "m"), "yaw-tolerances": (YAW_TOLERANCES, "rad")}
    for name, (values, unit) in lists.items():
        default = " ".join(f"{value:g}" for value in values)
        parser.add_argument(
            f"--{name}", type=not_negative, nargs="+", default=values, help=f"{unit} (default: {default})"
        )


def measure(options: argparse.Namespace, url: str) -> Figures:
    seeds = range(options.seed, options.seed + options.episodes)
    scenes = {seed: generate(OBJECTS, seed) for seed in seeds}
    cells = list(product(options.sigmas, options.margins, options.yaw_tolerances))
    # Every cell has the same scenes and the same errors, so that cells differ by what is asked of them alone.
    tasks = [
        Task(url, with_margins(scenes[seed], sigma, margin, yaw), sigma=sigma, seed=seed)
        for sigma, margin, yaw in cells
        for seed in seeds
    ]
    episodes = each(tasks, options.jobs, "noise")
    found = []
    for sigma, margin, yaw in cells:
        done = [next(episodes) for _ in seeds]
        found.append({"sigma": sigma, "margin": margin, "yaw_tolerance": yaw, **tally(done)})
    return {"objects": OBJECTS, "episodes": options.episodes, "seed": options.seed, "cells": found}


def with_margins(scene: Scene, sigma: float, margin: float, yaw_tolerance: float) -> Scene:
    """The scene with a gripper that keeps these, and a service that takes two seen centres for as wrong as they may be."""
    made = copy.deepcopy(scene)
    made["gripper"] |= {"margin": margin, "yaw_tolerance": yaw_tolerance}
    tolerance = min(max(LEAST_OVERLAP, 2 * e_place(sigma)), GREATEST_OVERLAP)
    made["settings"] = {"overlap_tolerance": tolerance}
    return made


def text(figures: Figures) -> str:
    head = ["sigma", "margin", "yaw tolerance", "success", "clean", "deadlock", "no space", "relocations", "mean error"]
    body = [
        [
            f"{1e3 * cell['sigma']:g} mm",
            f"{1e3 * cell['margin']:g} mm",
            f"{cell['yaw_tolerance']:g}",
            share(cell["success"], cell["judged"]),
            share(cell["clean"], cell["judged"]),
            str(cell["ends"].get("deadlock", 0)),
            str(cell["ends"].get("no_space", 0)),
            str(cell["relocations"]),
            f"{1e3 * cell['place_error_mean']:.2f} mm" if cell["place_error_mean"] is not None else "-",
        ]
        for cell in figures["cells"]
    ]
    return rows(head, body)
