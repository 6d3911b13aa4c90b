"""What carries the hand: its interface, for a gantry and an arm."""

from dataclasses import dataclass
from typing import Protocol

import mujoco
import numpy as np
import numpy.typing as npt

from .hand import Hand


class OutOfReach(Exception):
    """No joint angles put the hand there. The planner knows no reach, so this is counted apart."""


class NoPath(Exception):
    """No motion without a collision was found in time."""


@dataclass(frozen=True)
class ToolPose:
    """Where the hand's origin (on its axis, at the fingertips) is to be: m in the table's frame, z from the table's top,
    upright, finger 0 towards `yaw` (rad)."""

    x: float
    y: float
    z: float
    yaw: float


@dataclass(frozen=True)
class Motion:
    """Joint positions and velocities at each physics step: arrays of shape (steps, joints)."""

    positions: npt.NDArray[np.float64]
    velocities: npt.NDArray[np.float64]


class Mechanism(Protocol):
    """Carries the hand. `add_to` comes first, then `bind` with the compiled model, then `home` with its data."""

    geoms: set[int]
    """Its own geoms, known once bound, which must touch nothing. The hand's are not among them."""

    def add_to(self, spec: mujoco.MjSpec, hand: Hand) -> None:
        """Adds its bodies, joints and drives, and hangs the hand on them."""

    def bind(self, model: mujoco.MjModel) -> None:
        """Looks up its joints, drives and geoms."""

    def home(self, data: mujoco.MjData) -> None:
        """Puts it where every episode begins: the hand above the table, clear of everything."""

    def line(self, data: mujoco.MjData, to: ToolPose) -> Motion:
        """Straight from where it is commanded to be. Raises OutOfReach or NoPath."""

    def travel(self, data: mujoco.MjData, to: ToolPose, held: int | None) -> Motion:
        """Through the air to `to`, round everything, with the body `held` in the fingers. `to` may also be reached with any
        yaw that looks the same to the hand. Raises OutOfReach or NoPath."""

    def command(self, data: mujoco.MjData, motion: Motion, step: int) -> None:
        """Sends the drives where the motion is at this step."""
