"""The joint angles of an arm of Universal Robots for an upright tool, and back, in closed form.

An upright tool fixes two of six joints: the fifth stands at -90° and the fourth balances the second and third. What is
left are four free angles, of which the second and third are a planar arm of two links. The same four are the space in
which ways are planned, so the tool stays upright on all of them. Of the branches one is used: elbow up, wrist outwards.
"""

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from .mechanism import OutOfReach

FREE = [0, 1, 2, 5]
"""Of six joints, those that an upright tool leaves free: pan, lift, elbow and the last of the wrist."""
SLACK = math.radians(2)
"""How far from stretched or folded the elbow has to stay. At the very end speeds of joints have no bound."""


@dataclass(frozen=True)
class Kinematics:
    """Lengths in m. Poses are x, y, z and yaw of the hand, as arrays of shape (..., 4), and so are the free angles."""

    base: np.ndarray
    """Foot of the first axis in the table's frame."""
    facing: float
    """Direction of the arm's own x axis, rad."""
    shoulder: float
    upper: float
    fore: float
    aside: float
    """From the first axis to the plane in which the hand moves."""
    wrist: float
    drop: float
    """From the wrist's centre down to the fingertips."""
    low: np.ndarray
    high: np.ndarray
    """Limits of the six joints, rad."""

    @classmethod
    def of(cls, model: mujoco.MjModel, prefix: str, facing: float, hand_height: float) -> "Kinematics":
        def offset(name: str) -> np.ndarray:
            return np.asarray(model.body(prefix + name).pos)

        ranges = np.array([model.joint(prefix + name).range for name in JOINTS])
        return cls(
            base=offset("base").copy(),
            facing=facing,
            shoulder=float(offset("shoulder_link")[2]),
            upper=float(offset("forearm_link")[2]),
            fore=float(offset("wrist_1_link")[2]),
            aside=float(offset("upper_arm_link")[1] + offset("forearm_link")[1] + offset("wrist_2_link")[1]),
            wrist=float(offset("wrist_3_link")[2]),
            drop=float(offset("flange")[1]) + hand_height,
            low=ranges[:, 0],
            high=ranges[:, 1],
        )

    def all_six(self, free: np.ndarray) -> np.ndarray:
        """The joint angles that keep the tool upright."""
        pan, lift, elbow, last = np.moveaxis(np.asarray(free), -1, 0)
        upright = np.full_like(pan, -math.pi / 2)
        return np.stack([pan, lift, elbow, upright - lift - elbow, upright, last], axis=-1)

    def pose(self, free: np.ndarray) -> np.ndarray:
        pan, lift, elbow, last = np.moveaxis(np.asarray(free), -1, 0)
        first = lift + math.pi / 2
        second = first + elbow
        out = self.upper * np.sin(first) + self.fore * np.sin(second) + self.wrist
        up = self.upper * np.cos(first) + self.fore * np.cos(second)
        turn = pan + self.facing
        return np.stack(
            [
                self.base[0] + out * np.cos(turn) - self.aside * np.sin(turn),
                self.base[1] + out * np.sin(turn) + self.aside * np.cos(turn),
                self.base[2] + self.shoulder + up - self.drop,
                turn - math.pi / 2 - last,
            ],
            axis=-1,
        )

    def free(self, poses: np.ndarray) -> np.ndarray:
        """The free angles for these poses. The last one is as the yaw has it, whole turns and all."""
        x, y, z, yaw = np.moveaxis(np.asarray(poses), -1, 0)
        x, y = x - self.base[0], y - self.base[1]
        out = np.sqrt(np.maximum(x**2 + y**2 - self.aside**2, 0))
        # Straight ahead of the arm is 0 and the jump from -180° to 180° is behind it, where it never works.
        turn = np.arctan2(y, x) - np.arctan2(self.aside, out) - self.facing
        pan = (turn + math.pi) % (2 * math.pi) - math.pi
        out = out - self.wrist
        up = z + self.drop - self.base[2] - self.shoulder
        cosine = (out**2 + up**2 - self.upper**2 - self.fore**2) / (2 * self.upper * self.fore)
        if np.any(np.abs(cosine) > math.cos(SLACK)) or np.any(out <= 0):
            x, y, z = np.atleast_2d(poses)[-1][:3]
            raise OutOfReach(f"the arm does not reach x {x:.3f}, y {y:.3f}, {z:.3f} m above the table")
        elbow = np.arccos(cosine)
        first = np.arctan2(out, up) - np.arctan2(self.fore * np.sin(elbow), self.upper + self.fore * np.cos(elbow))
        return np.stack([pan, first - math.pi / 2, elbow, pan + self.facing - math.pi / 2 - yaw], axis=-1)

    def within_limits(self, free: np.ndarray) -> bool:
        six = self.all_six(free)
        return bool(np.all((six >= self.low) & (six <= self.high)))


JOINTS = tuple(f"{name}_joint" for name in ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"))
"""From the base to the flange, as the model calls them."""
