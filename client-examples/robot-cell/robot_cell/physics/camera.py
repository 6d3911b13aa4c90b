"""A camera over the table: the scene as it sees it, each centre off by a normal error."""

from typing import Any

import numpy as np

from .world import Scene, World

GREATEST_ERROR = 3.0
"""In sigmas: [`e_place`] is the distance that 98.9 % of the seen centres keep to."""


LONGEST_ID = 240
"""Of a scene's own id, so that the number of the picture has room."""


def e_place(sigma: float) -> float:
    """The greatest error of a centre that the margins count on, m."""
    return GREATEST_ERROR * sigma


def asked_for(scene: Scene) -> Scene:
    """The scene as the service takes it. Heights and finger lengths are for the physics alone."""
    if not isinstance(scene, dict):
        return scene
    asked = dict(scene)
    if isinstance(gripper := scene.get("gripper"), dict):
        asked["gripper"] = {name: value for name, value in gripper.items() if name != "finger_length"}
    if isinstance(objects := scene.get("objects"), list):
        asked["objects"] = [_without_height(item) for item in objects]
    return asked


def _without_height(item: Any) -> Any:
    if not isinstance(item, dict):
        return item
    return {name: value for name, value in item.items() if name != "height"}


class Camera:
    """`sigma` is the standard deviation along x and along y, m. Each picture has errors of its own."""

    def __init__(self, world: World, sigma: float, random: np.random.Generator) -> None:
        self._world, self._sigma, self._random = world, sigma, random
        self.pictures = 0

    def look(self) -> Scene:
        """The scene as a request, with a new `scene_id`."""
        self.pictures += 1
        scene = asked_for(self._world.scene)
        scene["scene_id"] = f"{(scene.get('scene_id') or 'cell')[:LONGEST_ID]}/{self.pictures}"
        for item in scene["objects"]:
            x, y = self._world.place(item["id"])[:2] + self._random.normal(0, 1, 2) * self._sigma
            item["x"], item["y"] = float(x), float(y)
        return scene
