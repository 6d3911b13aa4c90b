"""A gantry: three slides and a hinge carry the hand. It reaches everything, so it shows the plan alone."""

import math

import mujoco
import numpy as np

from .hand import Hand
from .mechanism import Motion, ToolPose

AXES = ("x", "y", "z", "yaw")
STIFFNESS = 2.5e5
"""Of the drives, N/m and N m/rad. The hand's weight is balanced, so a dish of 3 N bends them by 12 µm."""
ARMATURE = 10.0
"""Motors and carriages, kg and kg m²."""
CARRIED = 1.2
"""About what hangs on it, kg. For the damping."""
DAMPING = 2 * math.sqrt(STIFFNESS * (ARMATURE + CARRIED))
"""Critical, N s/m. It is the drive's, not the joint's: Euler's method takes a joint's damping implicitly, after the contact
forces were computed without it, and a held dish slides by millimetres."""
SPEED = np.array([0.5, 0.5, 0.4, 2.0])
"""Greatest speed, m/s and rad/s."""
ACCELERATION = np.array([2.0, 2.0, 2.0, 8.0])
"""Greatest acceleration, m/s² and rad/s²."""
HOME_HEIGHT = 0.4
"""Of the fingertips before an episode, m."""


class Gantry:
    def __init__(self, table: dict[str, float]) -> None:
        middle = (table["x_min"] + table["x_max"]) / 2, (table["y_min"] + table["y_max"]) / 2
        self._home = np.array([*middle, HOME_HEIGHT, 0.0])
        self._commanded = self._home
        self.geoms: set[int] = set()

    def add_to(self, spec: mujoco.MjSpec, hand: Hand) -> None:
        self._fingers = hand.fingers
        carriage = spec.worldbody.add_body(name="gantry", gravcomp=1)
        slide, hinge = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE
        directions = {"x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1], "yaw": [0, 0, 1]}
        for axis in AXES:
            kind = hinge if axis == "yaw" else slide
            carriage.add_joint(name=f"gantry_{axis}", type=kind, axis=directions[axis], armature=ARMATURE)
            drive = spec.add_actuator(name=f"gantry_{axis}", target=f"gantry_{axis}", trntype=mujoco.mjtTrn.mjTRN_JOINT)
            drive.set_to_position(kp=STIFFNESS, kv=DAMPING)
        hand.add_to(spec, carriage)
        carriage.add_geom(
            name="ram",
            type=mujoco.mjtGeom.mjGEOM_CYLINDER,
            size=[0.02, 0.3, 0],
            pos=[0, 0, hand.height + 0.3],
            mass=0.1,
            contype=0,
            conaffinity=0,
            rgba=[0.6, 0.6, 0.62, 1],
        )

    def bind(self, model: mujoco.MjModel) -> None:
        self._step = model.opt.timestep
        self._qpos = [model.joint(f"gantry_{axis}").qposadr[0] for axis in AXES]
        self._ctrl = [model.actuator(f"gantry_{axis}").id for axis in AXES]

    def home(self, data: mujoco.MjData) -> None:
        data.qpos[self._qpos] = data.ctrl[self._ctrl] = self._commanded = self._home

    def line(self, data: mujoco.MjData, to: ToolPose) -> Motion:
        way = np.array([to.x, to.y, to.z, to.yaw]) - self._commanded
        # The nearest of the yaws that look the same.
        way[3] = math.remainder(way[3], 2 * math.pi / self._fingers)
        return along(self._commanded, way, duration(way, SPEED, ACCELERATION), self._step)

    def travel(self, data: mujoco.MjData, to: ToolPose, held: int | None) -> Motion:
        """Straight, at the height where it is: nothing reaches up there."""
        return self.line(data, to)

    def command(self, data: mujoco.MjData, motion: Motion, step: int) -> None:
        self._commanded = motion.positions[step]
        # The drive's damping pulls back by damping * velocity; it is sent ahead by as much.
        data.ctrl[self._ctrl] = self._commanded + motion.velocities[step] * (DAMPING / STIFFNESS)


def duration(way: np.ndarray, speed: np.ndarray, acceleration: np.ndarray) -> float:
    """Of the shortest motion of [`along`]'s form within the limits, s: its greatest speed is 15/8 of the mean one, its
    greatest acceleration 10/√3 of the way over the time squared."""
    by_speed = np.max(15 / 8 * np.abs(way) / speed)
    by_acceleration = math.sqrt(np.max(10 / math.sqrt(3) * np.abs(way) / acceleration))
    return float(max(by_speed, by_acceleration))


def along(start: np.ndarray, way: np.ndarray, seconds: float, step: float) -> Motion:
    """From `start` by `way` with the least jerk: the quintic that begins and ends at rest."""
    steps = max(1, math.ceil(seconds / step))
    s = np.arange(1, steps + 1)[:, None] / steps
    share = s**3 * (10 - 15 * s + 6 * s**2)
    rate = 30 * s**2 * (1 - s) ** 2 / (steps * step)
    return Motion(start + share * way, rate * way)
