"""The hand: its interface, for a centric one and for a 2F-85."""

from typing import Protocol

import mujoco


class Hand(Protocol):
    """The gripper of a scene as bodies. Its body is called `hand` and has its origin on the axis, at the open fingertips;
    z points up to where it is screwed on, x towards finger 0. Geoms that reach down between dishes are called `finger...`,
    all others `palm...`."""

    fingers: int
    height: float
    """From the fingertips to where it is screwed on, m."""

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody, **pose: list[float]) -> None:
        """Hangs it on `parent`, with its drives."""

    def bind(self, model: mujoco.MjModel) -> None:
        """Looks up its drives."""

    def open_for(self, radius: float) -> float:
        """The opening round an object of this radius, m: from the axis to the inner faces. Their outer ones are then
        `clearance` beyond the object's edge, as the service takes it."""

    def closed_on(self, radius: float) -> float:
        """The opening that holds it fast, m."""

    def drop(self, opening: float) -> float:
        """How far below the hand's origin the fingertips are at an opening, m. 0 for pads that slide."""

    def command(self, data: mujoco.MjData, opening: float) -> None:
        """Sends the drives to an opening."""
