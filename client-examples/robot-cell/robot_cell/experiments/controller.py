"""The controller with the margins of `docs/robot-controllers.md`, with and without asking whether its plan still holds."""

import argparse

from ..physics.camera import e_place
from . import Figures
from .arguments import add_jobs, not_negative, positive, whole
from .episodes import Task, each
from .noise import OBJECTS, with_margins
from .server import generate
from .tally import tally
from .text import share

SIGMA = 0.001


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_jobs(parser)
    parser.add_argument("--episodes", type=positive, default=200, help="(default: 200)")
    parser.add_argument("--seed", type=whole, default=0, help="of the first scene (default: 0)")
    parser.add_argument("--sigma", type=not_negative, default=SIGMA, help="of the camera, m (default: 0.001)")


def measure(options: argparse.Namespace, url: str) -> Figures:
    seeds = range(options.seed, options.seed + options.episodes)
    # The gantry's own error is 0.01 mm and radii are exact, so twice e_place is left of the rule.
    margin = 2 * e_place(options.sigma)
    scenes = [with_margins(generate(OBJECTS, seed), options.sigma, margin, 0.0) for seed in seeds]
    figures: Figures = {
        "objects": OBJECTS,
        "episodes": options.episodes,
        "seed": options.seed,
        "sigma": options.sigma,
        "margin": margin,
    }
    # Two pictures of one dish are off by e_place each.
    for name, tolerance in {"plans_only": None, "asks_first": 2 * e_place(options.sigma)}.items():
        tasks = [
            Task(url, scene, sigma=options.sigma, seed=seed, position_tolerance=tolerance)
            for seed, scene in zip(seeds, scenes)
        ]
        figures[name] = tally(list(each(tasks, options.jobs, name)))
    return figures


def text(figures: Figures) -> str:
    lines = [f"sigma {1e3 * figures['sigma']:g} mm, margin {1e3 * figures['margin']:g} mm"]
    for name, words in {
        "plans_only": "plans after each step",
        "asks_first": "asks first whether its plan holds",
    }.items():
        of = figures[name]
        tried = of["episodes"]
        lines.append(
            f"{words}: success {share(of['success'], of['judged'])}, ends {of['ends']}, "
            f"{of['plans'] / tried:.2f} plans and {of['verifications'] / tried:.2f} verifications an episode, "
            f"{of['relocations']} relocations, contacts {of['contacts'] or 'none'}, dishes pressed against others in "
            f"{of['pressed']} episodes, {of['pictures'] / tried:.2f} pictures an episode"
        )
    return "\n".join(lines)
