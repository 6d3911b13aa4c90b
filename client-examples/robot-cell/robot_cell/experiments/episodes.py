"""Episodes in other processes: each is a task of plain figures, so that the same task gives the same episode."""

import signal
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import get_context
from typing import Any

import numpy as np
from tqdm import tqdm

from ..client.controller import Controller
from ..client.service import Service
from ..physics.camera import Camera
from ..physics.cell import Cell, Watcher
from ..physics.gantry import Gantry
from ..physics.mechanism import Mechanism
from ..physics.world import Scene, build


@dataclass(frozen=True)
class Task:
    """One episode: the scene as it really is, with the gripper and the settings that the plan is made for."""

    url: str
    scene: Scene
    mechanism: str = "gantry"
    """`gantry` or `arm`."""
    sigma: float = 0.0
    """Of the camera, m."""
    seed: int = 0
    """Of the camera's errors."""
    position_tolerance: float | None = None
    """With it the controller asks whether its plan still holds, m."""
    trusting: bool = False
    """Carries out plans that have a fault by the service's own checker."""


def mechanism(name: str, table: dict[str, float]) -> Mechanism:
    if name == "arm":
        # Its libraries take a second to load, and a gantry needs none of them.
        from ..physics.arm import Arm

        return Arm(table)
    return Gantry(table)


def run(task: Task, watch: Watcher | None = None) -> dict[str, Any]:
    """The episode as JSON. `watch` sees every step of the physics."""
    scene = task.scene
    cell = Cell(build(scene, mechanism(task.mechanism, scene["table"])), watch)
    camera = Camera(cell.world, task.sigma, np.random.default_rng(task.seed))
    with Service(task.url) as service:
        controller = Controller(
            service, cell, camera, position_tolerance=task.position_tolerance, trusting=task.trusting
        )
        episode = controller.run()
    return {"scene_id": scene.get("scene_id"), **episode.to_json()}


def each(tasks: list[Task], jobs: int, what: str) -> Iterator[dict[str, Any]]:
    """The episodes in the order of their tasks, `jobs` at a time, with a bar on stderr."""
    with workers(jobs) as pool:
        yield from tqdm(pool.map(run, tasks), total=len(tasks), desc=what, unit="episode", leave=False, disable=None)


@contextmanager
def workers(jobs: int) -> Iterator[ProcessPoolExecutor]:
    """Processes that end with what they are needed for, early or not."""
    # A process that is forked keeps the renderer's and the solver's threads in a state that they don't survive.
    pool = ProcessPoolExecutor(jobs, mp_context=get_context("spawn"), initializer=_leave_interrupts)
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)


def _leave_interrupts() -> None:
    """Ctrl-C goes to every process of a terminal. The one that started the others ends them."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
