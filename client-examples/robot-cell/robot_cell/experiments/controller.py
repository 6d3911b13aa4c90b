"""The controller with the margins of `docs/robot-controllers.md`, with and without asking whether its plan still holds."""

import argparse

from ..physics.camera import e_place
from .episodes import Task, each
from .server import generate
from .tally import tally
from .text import share
from . import Figures
from .noise import OBJECTS, with_margins

SIGMA = 0.001
LEFT_BY_THE_HAND = 0.5
"""Of an error of the seen place, after three pads have closed on the dish, at most: see `run hand`."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--episodes", type=int, default=200, help="(default: 200)")
    parser.add_argument("--seed", type=int, default=0, help="of the first scene (default: 0)")
    parser.add_argument("--sigma", type=float, default=SIGMA, help="of the camera, m (default: 0.001)")


def measure(options: argparse.Namespace, url: str) -> Figures:
    seeds = range(options.seed, options.seed + options.episodes)
    # The gantry's own error is 0.01 mm and radii are exact, so of the rule are left the error of an obstacle's place and what
    # a moved dish keeps of its own.
    error = e_place(options.sigma)
    margin = error * (1 + LEFT_BY_THE_HAND)
    scenes = [with_margins(generate(OBJECTS, seed), options.sigma, margin, 0.0) for seed in seeds]
    figures: Figures = {
        "objects": OBJECTS,
        "episodes": options.episodes,
        "seed": options.seed,
        "sigma": options.sigma,
        "margin": margin,
    }
    # Two pictures of one dish are off by e_place each.
    for name, tolerance in {"plans_only": None, "asks_first": 2 * error}.items():
        tasks = [
            Task(url, scene, sigma=options.sigma, seed=seed, position_tolerance=tolerance)
            for seed, scene in zip(seeds, scenes)
        ]
        figures[name] = tally(list(each(tasks, options.jobs, name)))
    return figures


def text(figures: Figures) -> str:
    lines = [f"sigma {1e3 * figures['sigma']:g} mm, margin {1e3 * figures['margin']:g} mm"]
    for name in ("plans_only", "asks_first"):
        of = figures[name]
        tried = of["episodes"]
        lines.append(
            f"{name}: target in hand {share(of['success'], of['judged'])}, ends {of['ends']}, "
            f"{of['plans'] / tried:.2f} plans and {of['verifications'] / tried:.2f} verifications an episode, "
            f"{of['relocations']} relocations, contacts {of['contacts'] or 'none'}"
        )
    return "\n".join(lines)
