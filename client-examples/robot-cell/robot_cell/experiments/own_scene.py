"""A scene of yours, carried out: what became of each step."""

import argparse
import json
from pathlib import Path

from .episodes import Task, run
from .tally import is_hit
from . import Figures


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scene", type=Path, help="the body of POST /v1/plans; objects may have a `height`, m")
    add_cell_arguments(parser)


def add_cell_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--mechanism", choices=["arm", "gantry"], default="arm", help="what carries the hand")
    parser.add_argument("--sigma", type=float, default=0.0, help="of the camera, m (default: 0)")
    parser.add_argument("--seed", type=int, default=0, help="of the camera's errors (default: 0)")


def measure(options: argparse.Namespace, url: str) -> Figures:
    scene = json.loads(options.scene.read_text(encoding="utf-8"))
    return run(Task(url, scene, options.mechanism, options.sigma, options.seed))


def text(figures: Figures) -> str:
    lines = [_line(step) for step in figures["steps"]]
    detail = f": {figures['detail']}" if figures["detail"] else ""
    return "\n".join([*lines, f"{figures['end']}{detail}"])


def _line(step: Figures) -> str:
    place = step["place_error"]
    what = "lifted" if place is None else f"moved, {1e3 * place:.2f} mm off its place"
    words = [f"{step['object']}: {what}, {step['seconds']:.1f} s"]
    for contact in step["contacts"]:
        how = "hits" if is_hit(contact) else "meets"
        words.append(
            f"{contact['part']} {how} {contact['other']} at {contact['phase']} "
            f"({1e3 * contact['depth']:.3f} mm, {contact['force']:.1f} N)"
        )
    words += [f"{name} disturbed by {1e3 * way:.1f} mm" for name, way in step["disturbed"].items()]
    return "; ".join([*words, *(["dropped"] if step["dropped"] else [])])
