"""A camera over the table: the scene as it sees it, each centre off by a normal error."""

import copy

import numpy as np

from .world import Scene, World

GREATEST_ERROR = 3.0
"""In sigmas: [`e_place`] is the distance that 98.9 % of the seen centres keep to."""


def e_place(sigma: float) -> float:
    """The greatest error of a centre that the margins count on, m."""
    return GREATEST_ERROR * sigma


class Camera:
    """`sigma` is the standard deviation along x and along y, m. Each picture has errors of its own."""

    def __init__(self, world: World, sigma: float, random: np.random.Generator) -> None:
        self._world, self._sigma, self._random = world, sigma, random
        self._pictures = 0

    def look(self) -> Scene:
        """The scene as a request, with a new `scene_id`. Heights are for the physics alone: the service takes no such
        fields."""
        self._pictures += 1
        scene = copy.deepcopy(self._world.scene)
        scene["gripper"].pop("finger_length", None)
        scene["scene_id"] = f"{scene.get('scene_id', 'cell')}/{self._pictures}"
        for item in scene["objects"]:
            x, y = self._world.place(item["id"])[:2] + self._random.normal(0, 1, 2) * self._sigma
            item["x"], item["y"] = float(x), float(y)
            item.pop("height", None)
        return scene
