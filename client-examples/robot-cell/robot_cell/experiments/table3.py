"""The paper's Table III: relocation plans carried out by an arm, by our methods and by the paper's."""

import argparse
from typing import Any

from ..client.service import Service
from ..physics.world import Scene
from . import Figures
from .arguments import add_jobs, positive, whole
from .episodes import Task, each
from .server import generate
from .tally import tally
from .text import rows, share

COLUMNS = {16: 0, 18: 1, 20: 2}
"""N, and which column of Table I it is."""
COLUMN_SEEDS = 1_000_000
"""Between the seeds of two columns, as in `singulate experiment table1`: these are its scenes."""
METHODS: dict[str, dict[str, Any]] = {
    "ours": {},
    "paper": {"grasp_model": "sector", "search": "lobs", "placement": "raster", "time_limit_ms": 60_000},
}
"""The `settings` of each."""
PAPER = {
    16: {"success": 1.0, "planning_s": 2.82, "execution_s": 77.99},
    18: {"success": 1.0, "planning_s": 3.09, "execution_s": 77.60},
    20: {"success": 1.0, "planning_s": 2.96, "execution_s": 76.49},
}
"""Table III as printed, another arm's figures."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_jobs(parser)
    parser.add_argument(
        "--episodes", type=positive, default=10, help="episodes a column that are no deadlock (default: 10)"
    )
    parser.add_argument("--seed", type=whole, default=0, help="that of `singulate experiment table1` (default: 0)")
    parser.add_argument("--mechanism", choices=["arm", "gantry"], default="arm", help="what carries the hand")


def measure(options: argparse.Namespace, url: str) -> Figures:
    drawn: list[tuple[int, str, int, list[Task]]] = []
    with Service(url) as service:
        for objects, column in COLUMNS.items():
            for method, settings in METHODS.items():
                first = options.seed + column * COLUMN_SEEDS
                deadlocks, scenes = without_deadlock(service, objects, first, settings, options.episodes)
                tasks = [Task(url, scene, options.mechanism, trusting=method == "paper") for scene in scenes]
                drawn.append((objects, method, deadlocks, tasks))
    episodes = each([task for *_, tasks in drawn for task in tasks], options.jobs, "table3")
    columns = []
    for objects, method, deadlocks, tasks in drawn:
        done = [next(episodes) for _ in tasks]
        columns.append(
            {
                "objects": objects,
                "method": method,
                "deadlocks_passed_over": deadlocks,
                "planning_s_mean": mean(episode["planning_s"] for episode in done),
                "service_s_mean": mean(episode["service_s"] for episode in done),
                "execution_s_mean": mean(sum(s["seconds"] for s in episode["steps"]) for episode in done),
                "faulty_plans": sum(episode["faulty_plans"] for episode in done),
                "paper": PAPER[objects],
                **tally(done),
            }
        )
    return {"mechanism": options.mechanism, "seed": options.seed, "episodes": options.episodes, "columns": columns}


def without_deadlock(
    service: Service, objects: int, first: int, settings: dict[str, Any], wanted: int
) -> tuple[int, list[Scene]]:
    """The first scenes that are no deadlock by these methods, and how many deadlocks come before the last of them."""
    deadlocks, seed = 0, first
    scenes: list[Scene] = []
    while len(scenes) < wanted:
        scene = papers_scene(service, objects, seed)
        scene["settings"] = settings
        if service.plan(scene)["verdict"] == "deadlock":
            deadlocks += 1
        else:
            scenes.append(scene)
        seed += 1
    return deadlocks, scenes


def papers_scene(service: Service, objects: int, seed: int) -> Scene:
    """Its target is the object whose least option by the sector model is the largest; ties go to the first."""
    scene = generate(objects, seed)
    base = service.knowledge({**scene, "settings": {"grasp_model": "sector"}})
    least = {item["id"]: min(map(len, item["options"])) for item in base["objects"]}
    return {**scene, "target": max(least, key=lambda name: least[name])}


def mean(values: Any) -> float | None:
    listed = list(values)
    return sum(listed) / len(listed) if listed else None


def text(figures: Figures) -> str:
    head = [
        "N",
        "methods",
        "deadlocks",
        "success",
        "clean",
        "planning",
        "in the service",
        "execution",
        "relocations",
        "out of reach",
    ]
    body = [
        [
            str(column["objects"]),
            column["method"],
            str(column["deadlocks_passed_over"]),
            share(column["success"], column["judged"]),
            share(column["clean"], column["judged"]),
            f"{1000 * column['planning_s_mean']:.1f} ms",
            f"{1000 * column['service_s_mean']:.2f} ms",
            f"{column['execution_s_mean']:.1f} s",
            str(column["relocations"]),
            str(column["ends"].get("out_of_reach", 0)),
        ]
        for column in figures["columns"]
    ]
    contacts = [f"N={c['objects']}, {c['method']}: {c['contacts']}" for c in figures["columns"] if c["contacts"]]
    ends = [f"N={c['objects']}, {c['method']}: {c['ends']}" for c in figures["columns"]]
    return "\n".join([rows(head, body), *ends, *(contacts or ["no contacts"])])
