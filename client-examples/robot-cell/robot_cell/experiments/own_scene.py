"""A scene of yours, carried out: what became of each step."""

import argparse
import json
from pathlib import Path

from ..client.service import Service
from ..physics.camera import asked_for
from ..physics.world import Scene
from . import Figures
from .arguments import not_negative, whole
from .episodes import Task, run
from .tally import is_hit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "scene",
        type=Path,
        help="the body of POST /v1/plans; objects may have a `height`, the gripper a `finger_length`, m",
    )
    add_cell_arguments(parser)


def add_cell_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--mechanism", choices=["arm", "gantry"], default="arm", help="what carries the hand (default: arm)"
    )
    parser.add_argument("--sigma", type=not_negative, default=0.0, help="of the camera, m (default: 0)")
    parser.add_argument("--seed", type=whole, default=0, help="of the camera's errors (default: 0)")


def measure(options: argparse.Namespace, url: str) -> Figures:
    scene = read(options.scene, url)
    return run(Task(url, scene, options.mechanism, options.sigma, options.seed))


def read(path: Path, url: str) -> Scene:
    """A scene that the service takes. Raises ValueError, OSError, or Refused with the service's faults."""
    try:
        scene: Scene = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path} is no JSON: {error}") from error
    with Service(url) as service:
        service.plan(asked_for(scene))
    if not scene["objects"]:
        raise ValueError("there is nothing on the table")
    if any("\0" in item["id"] for item in scene["objects"]):
        raise ValueError("the simulator takes no id with U+0000 in it")
    return scene


STATUSES = {
    "in_hand": 0,
    "all_away": 0,
    "cleared": 0,
    "refused": 2,
    "deadlock": 3,
    "no_space": 4,
    "timed_out": 5,
    "partly_cleared": 7,
}


def status(figures: Figures) -> int:
    """The exit status, as that of the other client examples."""
    return STATUSES.get(figures["end"], 1)


def text(figures: Figures) -> str:
    lines = [_line(step) for step in figures["steps"]]
    detail = f": {figures['detail']}" if figures["detail"] else ""
    return "\n".join([*lines, f"{figures['end']}{detail}"])


def _line(step: Figures) -> str:
    place = step["place_error"]
    done = f"taken away to {step['drop_off']}" if step["drop_off"] else "moved"
    done = "lifted" if place is None else f"{done}, {1e3 * place:.2f} mm off its place"
    what = step["failure"].replace("_", " ") or done
    words = [f"{step['object']}: {what}, {step['seconds']:.1f} s"]
    for contact in step["contacts"]:
        how = "hits" if is_hit(contact) else "meets"
        words.append(
            f"{contact['part']} {how} {contact['other']} at {contact['phase']} "
            f"({1e3 * contact['depth']:.3f} mm, {contact['force']:.1f} N)"
        )
    words += [f"{name} disturbed by {1e3 * way:.1f} mm" for name, way in step["disturbed"].items()]
    return "; ".join([*words, *(["dropped"] if step["dropped"] else [])])
