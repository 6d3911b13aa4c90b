"""The judge: every contact of the hand, of what carries it or of the dish in it with anything else, at each physics step."""

from dataclasses import dataclass
from enum import StrEnum

import mujoco
import numpy as np

from .world import TABLE, World, dish

DEPTH_TOLERANCE = 1e-6
"""Contacts less deep than this are the simulator's own, m: `run tolerance` measures what it reports where nothing
touches."""
DISTURBANCE = 1e-3
"""A dish that the step doesn't move has been disturbed when it stands further away than this, m."""
LIGHT = 1.0
"""On what stands fast, a contact up to this force is a touch, N."""
GRAVITY = 9.81


class Phase(StrEnum):
    TRAVEL = "travel"
    DESCENT = "descent"
    CLOSING = "closing"
    CARRYING = "carrying"
    RELEASE = "release"
    ASCENT = "ascent"


HOLDING = {Phase.CLOSING, Phase.CARRYING, Phase.RELEASE}
"""Where pads may touch the dish, and the dish the table."""


@dataclass
class Contact:
    """What met what in which phase, with the worst of all its steps."""

    phase: Phase
    part: str
    """`finger`, `palm`, `arm`, or `dish` for the one in the hand."""
    other: str
    """The id of a dish, or `table`."""
    depth: float
    """m."""
    force: float
    """Along the normal, N."""
    holds: float
    """The force up to which it is a touch, N: what the dish's friction on the table holds against."""

    @property
    def is_touch(self) -> bool:
        """Too light to move what it meets."""
        return self.force <= self.holds

    def to_json(self) -> dict[str, object]:
        return {
            "phase": self.phase.value,
            "part": self.part,
            "other": self.other,
            "depth": self.depth,
            "force": self.force,
            "touch": self.is_touch,
        }


class Judge:
    def __init__(self, world: World) -> None:
        self._world = world
        model = world.model
        self._part = [""] * model.ngeom
        for geom in range(model.ngeom):
            name = model.geom(geom).name
            if name.startswith("finger"):
                self._part[geom] = "finger"
            elif name.startswith("palm"):
                self._part[geom] = "palm"
        for geom in world.mechanism.geoms:
            self._part[geom] = "arm"
        self._ours = np.array([bool(part) for part in self._part])
        self._pad = np.array([part == "finger" for part in self._part])
        self._table = model.geom(TABLE).id
        self._force = np.zeros(6)
        self._found: dict[tuple[Phase, str, str], Contact] = {}

    def start(self) -> None:
        """Forgets what it has seen: a new step of the plan begins."""
        self._found = {}

    def found(self) -> list[Contact]:
        return list(self._found.values())

    def look(self, phase: Phase, grasped: str) -> None:
        """Looks at the contacts of this physics step. `grasped` is the dish that the step is about."""
        data = self._world.data
        if not data.ncon:
            return
        pairs, depths = data.contact.geom, -data.contact.dist
        ours = self._ours.copy()
        geom = self._world.model.geom(dish(grasped)).id
        if phase in HOLDING:
            ours[geom] = True
        one, other = ours[pairs[:, 0]], ours[pairs[:, 1]]
        meets = (one != other) & (depths > DEPTH_TOLERANCE)
        if not meets.any():
            return
        for index in np.flatnonzero(meets):
            mine, theirs = pairs[index] if one[index] else pairs[index][::-1]
            if not (phase in HOLDING and mine == geom and theirs == self._table):
                self._add(phase, int(mine), int(theirs), float(depths[index]), int(index))

    def _add(self, phase: Phase, mine: int, theirs: int, depth: float, index: int) -> None:
        world = self._world
        part = self._part[mine] or "dish"
        other = world.model.geom(theirs).name.removeprefix("dish:")
        mujoco.mj_contactForce(world.model, world.data, index, self._force)
        key = (phase, part, other)
        contact = self._found.setdefault(key, Contact(phase, part, other, 0.0, 0.0, self._holds(theirs)))
        contact.depth = max(contact.depth, depth)
        contact.force = max(contact.force, float(self._force[0]))

    def _holds(self, geom: int) -> float:
        model = self._world.model
        body = model.geom_bodyid[geom]
        if model.body_dofnum[body] == 0:
            return LIGHT
        return float(model.geom_friction[geom][0] * model.body_mass[body] * GRAVITY)
