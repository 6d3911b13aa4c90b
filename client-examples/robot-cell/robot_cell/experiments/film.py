"""One episode as PNG frames and an animated picture, without a screen."""

import argparse
from pathlib import Path

import mujoco
import numpy as np
from PIL import Image

from ..client.service import Service
from ..physics.judge import Phase
from ..physics.world import Scene, World, dish
from . import Figures, own_scene
from .episodes import Task, run
from .server import generate

OBJECTS = 20
SIZE = (480, 300)
"""Width and height, pixels."""
RATE = 10
"""Frames a second of the picture."""
FASTER = 4
"""How much faster than in the cell things happen in the picture."""
COLOURS = 64
SUFFIXES = (".gif", ".webp", ".png")
"""Of animated pictures."""
RED, ORANGE = [0.85, 0.2, 0.15, 1], [0.95, 0.6, 0.2, 1]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scene", type=Path, nargs="?", help="a scene (default: a generated one)")
    parser.add_argument("--frames", type=Path, help="a folder for the frames")
    parser.add_argument("--picture", type=_picture, default=Path("film.gif"), help="(default: film.gif)")
    own_scene.add_cell_arguments(parser)


def measure(options: argparse.Namespace, url: str) -> Figures:
    scene = own_scene.read(options.scene, url) if options.scene else _generated(url)
    film = Film()
    figures = run(Task(url, scene, options.mechanism, options.sigma, options.seed), film.see)
    if options.frames:
        options.frames.mkdir(parents=True, exist_ok=True)
        for number, frame in enumerate(film.frames):
            frame.save(options.frames / f"{number:04}.png")
    film.save(options.picture)
    return {**figures, "frames": len(film.frames), "picture": str(options.picture)}


def status(figures: Figures) -> int:
    return own_scene.status(figures)


def text(figures: Figures) -> str:
    return f"{own_scene.text(figures)}\n{figures['frames']} frames, {figures['picture']}"


def _picture(text: str) -> Path:
    path = Path(text)
    if path.suffix not in SUFFIXES or not path.absolute().parent.is_dir():
        raise argparse.ArgumentTypeError(f"{path} can't be written: {' or '.join(SUFFIXES)} in a folder that is there")
    return path


def _generated(url: str) -> Figures:
    """The first scene whose target needs two relocations."""
    with Service(url) as service:
        for seed in range(1000):
            scene = generate(OBJECTS, seed)
            if service.plan(scene)["cost"] == 2:
                return scene
    raise RuntimeError("no scene needs two relocations")


class Film:
    def __init__(self) -> None:
        self.frames: list[Image.Image] = []
        self._renderer: mujoco.Renderer | None = None
        self._next = 0.0

    def see(self, world: World, phase: Phase, name: str) -> None:
        """Takes a frame where one is due. The dish that the step is about is orange, what is wanted red."""
        if world.data.time < self._next:
            return
        if self._renderer is None:
            self._renderer = mujoco.Renderer(world.model, SIZE[1], SIZE[0])
        self._next = world.data.time + FASTER / RATE
        self._colour(world, name)
        self._renderer.update_scene(world.data, _camera(world))
        self.frames.append(Image.fromarray(self._renderer.render()))

    def save(self, path: Path) -> None:
        frames = [frame.quantize(COLOURS, dither=Image.Dither.NONE) for frame in self.frames]
        frames[0].save(path, save_all=True, append_images=frames[1:], duration=1000 // RATE, loop=0, optimize=True)

    def _colour(self, world: World, name: str) -> None:
        wanted = _wanted(world.scene)
        for item in world.scene["objects"]:
            grey = [0.35, 0.35, 0.35, 1] if item.get("fixed") else [0.93, 0.93, 0.9, 1]
            colour = RED if item["id"] in wanted else ORANGE if item["id"] == name else grey
            world.model.geom(dish(item["id"])).rgba = colour


def _wanted(scene: Scene) -> list[str]:
    """The ids that the goal names."""
    goal = scene.get("goal", {})
    named: list[str] = goal.get("any_of", []) + goal.get("all_of", [])
    return [scene["target"]] if "target" in scene else named


def _camera(world: World) -> mujoco.MjvCamera:
    table = world.scene["table"]
    corners = [(table["x_min"], table["y_min"]), (table["x_max"], table["y_max"])]
    seen = np.array([*corners, *world.drop_offs.values()])
    low, high = seen.min(axis=0), seen.max(axis=0)
    camera = mujoco.MjvCamera()
    camera.lookat = np.array([*(low + high) / 2, 0.05])
    camera.distance = 1.4 * max(high - low)
    camera.azimuth, camera.elevation = -62, -40
    return camera
