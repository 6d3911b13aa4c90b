"""MuJoCo as the collision checker of a planner, on a copy of the model that only sees what may hit the arm."""

import copy

import mujoco
import numpy as np

MOVING, STANDING = 1, 2
"""Bits of what moves with the arm and of all the rest. The rest is not tested against itself."""


class Checker:
    """Tells at joint angles whether arm, hand and what the hand holds are clear of each other and of all else."""

    def __init__(self, model: mujoco.MjModel, joints: list[int], links: set[int], hand: set[int]) -> None:
        self._model = copy.deepcopy(model)
        self._data = mujoco.MjData(self._model)
        self._joints = joints
        self._solid = (model.geom_contype | model.geom_conaffinity) != 0
        self._links, self._hand = (_mask(model, geoms) for geoms in (links, hand))
        self._hand_body = model.body("hand").id

    def look(self, data: mujoco.MjData, held: int | None, clearance: float, links_only: bool = False) -> None:
        """Takes the scene as it is now. `held` goes along with the hand as it is in it now, or is left out where only
        the arm's links are of interest."""
        self._data.qpos[:] = data.qpos
        mujoco.mj_kinematics(self._model, self._data)
        self._clearance = clearance
        self._held = held
        self._held_geoms = self._model.geom_bodyid == (-1 if held is None else held)
        self._in_grip = self._hand | self._held_geoms
        self._grip = None if held is None or links_only else self._in_hand(held)
        self._set_moving(self._links if links_only else self._links | self._hand | self._held_geoms, links_only)

    def _in_hand(self, body: int) -> tuple[np.ndarray, np.ndarray]:
        """Where a body is in the hand's frame."""
        data, back, turned = self._data, np.empty(4), np.empty(3)
        place, turn = np.empty(3), np.empty(4)
        mujoco.mju_negPose(turned, back, data.xpos[self._hand_body], data.xquat[self._hand_body])
        mujoco.mju_mulPose(place, turn, turned, back, data.xpos[body], data.xquat[body])
        return place, turn

    def _set_moving(self, moving: np.ndarray, links_only: bool) -> None:
        model = self._model
        standing = self._solid & ~moving
        if links_only:
            standing &= ~(self._hand | self._held_geoms)
        model.geom_contype[:] = np.where(moving & self._solid, MOVING, np.where(standing, STANDING, 0))
        model.geom_conaffinity[:] = np.where(moving & self._solid, MOVING | STANDING, 0)
        model.geom_margin[:] = np.where(moving, self._clearance, 0)
        # The broad phase goes by that of the bodies, which the compiler derives from their geoms.
        model.body_margin[:] = self._clearance

    def free(self, joints: np.ndarray, share: float = 1.0) -> bool:
        """Whether all keep at least this share of the clearance."""
        model, data = self._model, self._data
        data.qpos[self._joints] = joints
        mujoco.mj_kinematics(model, data)
        if self._grip is not None:
            self._carry(self._grip)
        mujoco.mj_collision(model, data)
        contact = data.contact
        gripped = self._in_grip[contact.geom1] & self._in_grip[contact.geom2]
        return not np.any((contact.dist < share * self._clearance) & ~gripped)

    def _carry(self, grip: tuple[np.ndarray, np.ndarray]) -> None:
        data, model = self._data, self._model
        hand = data.xpos[self._hand_body], data.xquat[self._hand_body]
        place, turn = np.empty(3), np.empty(4)
        mujoco.mju_mulPose(place, turn, *hand, *grip)
        address = model.jnt_qposadr[model.body_jntadr[self._held]]
        data.qpos[address : address + 7] = *place, *turn
        mujoco.mj_kinematics(model, data)


def _mask(model: mujoco.MjModel, geoms: set[int]) -> np.ndarray:
    mask = np.zeros(model.ngeom, dtype=bool)
    mask[list(geoms)] = True
    return mask
