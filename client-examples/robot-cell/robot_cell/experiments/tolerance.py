"""The simulator's own tolerance: what it reports where nothing touches."""

import argparse

from ..physics.apart import of_dishes, of_pads
from ..physics.judge import DEPTH_TOLERANCE
from . import Figures
from .arguments import positive, whole


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--pairs", type=positive, default=2000, help="of each kind (default: 2000)")
    parser.add_argument("--seed", type=whole, default=0, help="(default: 0)")


def measure(options: argparse.Namespace, _url: str) -> Figures:
    return {
        "kinds": {
            "pads beside dishes": of_pads(options.pairs, options.seed).to_json(),
            "dishes beside dishes": of_dishes(options.pairs, options.seed).to_json(),
        },
        "judged_from": DEPTH_TOLERANCE,
    }


def text(figures: Figures) -> str:
    lines = [
        f"{kind}: {of['reported']} of {of['pairs']} pairs that are up to 10 µm apart are reported to overlap, "
        f"the deepest by {1e6 * of['deepest']:.3f} µm"
        for kind, of in figures["kinds"].items()
    ]
    return "\n".join([*lines, f"the judge counts from {1e6 * figures['judged_from']:g} µm"])
