"""Relocations by a gantry on exact data: what goes wrong with a plan that the robot carries out without an error."""

import argparse
from collections.abc import Generator
from contextlib import closing
from dataclasses import dataclass, field
from itertools import count

from tqdm import tqdm

from ..client.service import Service
from ..physics.robotiq import CLEARANCE, FINGER_WIDTH, TALLEST
from ..physics.world import HEIGHT, Scene
from . import Figures
from .arguments import add_jobs, positive, whole
from .episodes import Task, run, workers
from .server import generate
from .tally import is_clean, tally

JAWS = {"fingers": "2", "finger_width": str(FINGER_WIDTH), "clearance": str(CLEARANCE)}


@dataclass(frozen=True)
class Kind:
    """What `singulate generate` is asked for, and how high the dishes are, m."""

    objects: int
    recipe: dict[str, str] = field(default_factory=dict)
    height: float = HEIGHT


KINDS: dict[str, Kind] = {
    "paper, 16 dishes": Kind(16),
    "paper, 18 dishes": Kind(18),
    "paper, 20 dishes": Kind(20),
    "mixed, 24 dishes": Kind(24, {"radius": "0.03..0.08"}),
    "mixed, 40 dishes": Kind(40, {"radius": "0.02..0.07", "table": "1.4 0.7"}),
    "mixed, two jaws, 64 dishes": Kind(64, {"radius": "0.02..0.035", "table": "0.8 0.5", **JAWS}, TALLEST),
}
"""The paper's dishes are all alike, the mixed ones are not."""
SEEDS = 20
"""Scenes of each kind that are drawn at a time."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_jobs(parser)
    parser.add_argument("--count", type=positive, default=1000, help="relocations to carry out (default: 1000)")
    parser.add_argument("--seed", type=whole, default=0, help="of the first scene of each kind (default: 0)")


def measure(options: argparse.Namespace, url: str) -> Figures:
    kinds: list[str] = []
    episodes: list[Figures] = []
    relocations = 0
    with (
        tqdm(total=options.count, desc="relocations", leave=False, disable=None) as bar,
        closing(episodes_of(options, url)) as drawn,
    ):
        for kind, episode in drawn:
            kinds.append(kind)
            episodes.append(episode)
            done = sum(step["place_error"] is not None for step in episode["steps"])
            relocations += done
            bar.update(done)
            if relocations >= options.count:
                break
    by_kind = {kind: tally([e for e, of in zip(episodes, kinds) if of == kind]) for kind in KINDS}
    return {
        "count": options.count,
        "seed": options.seed,
        **tally(episodes),
        "by_kind": by_kind,
        "remarkable": [episode for episode in episodes if not is_clean(episode)],
    }


def episodes_of(options: argparse.Namespace, url: str) -> Generator[tuple[str, Figures], None, None]:
    """One episode after the other, without an end."""
    with workers(options.jobs) as pool:
        for seed in count(options.seed, SEEDS):
            drawn = [scene for at in range(seed, seed + SEEDS) for scene in draw(url, at)]
            tasks = [Task(url, scene) for _, scene in drawn]
            yield from zip([kind for kind, _ in drawn], pool.map(run, tasks))


def draw(url: str, seed: int) -> list[tuple[str, Scene]]:
    """A scene of each kind. Its target is the object that needs the most relocations and can be freed."""
    scenes = []
    with Service(url) as service:
        for name, kind in KINDS.items():
            scene = generate(kind.objects, seed, **kind.recipe)
            scene["scene_id"] = f"{name}/{seed}"
            free = [item for item in service.survey(scene)["objects"] if item["verdict"] == "relocate"]
            if free:
                target = max(free, key=lambda item: item["lower_bound"])["id"]
                objects = [{**item, "height": kind.height} for item in scene["objects"]]
                scenes.append((name, {**scene, "target": target, "objects": objects}))
    return scenes


def text(figures: Figures) -> str:
    lines = [
        f"{figures['relocations']} relocations in {figures['episodes']} episodes: {figures['ends']}",
        f"contacts {figures['contacts'] or 'none'}, disturbances above 1 mm {figures['disturbances']}, "
        f"drops {figures['drops']}",
        f"place error: mean {1e3 * figures['place_error_mean']:.3f} mm, worst {1e3 * figures['place_error_max']:.3f} mm",
    ]
    for kind, of in figures["by_kind"].items():
        lines.append(f"{kind}: {of['relocations']} relocations, contacts {of['contacts'] or 'none'}, ends {of['ends']}")
    return "\n".join(lines)
