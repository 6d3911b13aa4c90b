"""The judge: every contact of the hand, of what carries it or of the dish in it with anything else, at each physics step."""

from collections import defaultdict
from dataclasses import dataclass
from enum import IntEnum, StrEnum

import mujoco
import numpy as np

from .world import DISH_FRICTION, TABLE, World, dish, height

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
    LIFTING = "lifting"
    CARRYING = "carrying"
    RELEASE = "release"
    ASCENT = "ascent"


HOLDING = {Phase.CLOSING, Phase.LIFTING, Phase.CARRYING, Phase.RELEASE}
"""Where pads may touch the dish, and the dish the table."""


class Part(IntEnum):
    """Whose a geom is. `DISH` is the one in the hand; all that stands on the table is `OTHER`, and so is the table."""

    OTHER = 0
    FINGER = 1
    PALM = 2
    ARM = 3
    DISH = 4


ALLOWED = {(a, b) for a in (Part.FINGER, Part.PALM) for b in (Part.FINGER, Part.PALM)}
"""Parts that belong together: those of the hand, those of the arm, and pads on their dish."""
ALLOWED |= {(Part.OTHER, Part.OTHER), (Part.ARM, Part.ARM), (Part.FINGER, Part.DISH), (Part.DISH, Part.FINGER)}
IS_ALLOWED = np.array([[(a, b) in ALLOWED for b in Part] for a in Part])


@dataclass
class Contact:
    """What met what in which phase, with the worst of all its steps."""

    phase: Phase
    part: str
    """`finger`, `palm`, `arm`, or `dish` for the one in the hand."""
    other: str
    """The id of a dish, or `table`; a part, where two of them meet."""
    depth: float
    """m."""
    force: float
    """Along the normals, N: the sum over all points of one step."""
    holds: float
    """The force up to which it is a touch, N: what neither slides nor tips the dish."""

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
        self._own = np.zeros(model.ngeom, dtype=int)
        for geom in range(model.ngeom):
            name = model.geom(geom).name
            if name.startswith("finger"):
                self._own[geom] = Part.FINGER
            elif name.startswith("palm"):
                self._own[geom] = Part.PALM
        self._own[list(world.mechanism.geoms)] = Part.ARM
        self._table = model.geom(TABLE).id
        self._holds = {dish(item["id"]): self._firmness(item) for item in world.scene["objects"]}
        self._force = np.zeros(6)

    def start(self, grasped: str) -> None:
        """A new step of the plan begins, about the dish `grasped`."""
        self._found: dict[tuple[Phase, str, str], Contact] = {}
        self._grasped = self._world.model.geom(dish(grasped)).id
        self._holding = self._own.copy()
        self._holding[self._grasped] = Part.DISH

    def found(self) -> list[Contact]:
        return list(self._found.values())

    def look(self, phase: Phase) -> None:
        """Looks at the contacts of this physics step."""
        data = self._world.data
        if not data.ncon:
            return
        parts = self._holding if phase in HOLDING else self._own
        pairs = data.contact.geom
        of_pairs = parts[pairs]
        meets = ~IS_ALLOWED[of_pairs[:, 0], of_pairs[:, 1]] & (data.contact.dist < -DEPTH_TOLERANCE)
        if not meets.any():
            return
        forces: defaultdict[tuple[Phase, str, str], float] = defaultdict(float)
        for index in np.flatnonzero(meets):
            one, other = sorted(map(int, pairs[index]), key=lambda geom: -parts[geom])
            if parts[one] == Part.DISH and other == self._table:
                continue
            key = (phase, Part(parts[one]).name.lower(), self._name(other, parts[other]))
            mujoco.mj_contactForce(self._world.model, data, index, self._force)
            forces[key] += float(self._force[0])
            self._note(key, other, -float(data.contact.dist[index]), forces[key])

    def _name(self, geom: int, part: int) -> str:
        if part != Part.OTHER:
            return Part(part).name.lower()
        return str(self._world.model.geom(geom).name.removeprefix("dish:"))

    def _note(self, key: tuple[Phase, str, str], other: int, depth: float, force: float) -> None:
        holds = self._holds.get(self._world.model.geom(other).name, LIGHT)
        contact = self._found.setdefault(key, Contact(*key, 0.0, 0.0, holds))
        contact.depth = max(contact.depth, depth)
        contact.force = max(contact.force, force)

    def _firmness(self, item: dict[str, object]) -> float:
        """The force at its top that a dish stands: beyond it it slides, or tips if it is slender."""
        if item.get("fixed"):
            return LIGHT
        body = self._world.dishes[str(item["id"])]
        slender = self._world.radius(str(item["id"])) / height(item)
        return float(self._world.model.body_mass[body] * GRAVITY * min(DISH_FRICTION, slender))
