"""The cell carries out one step of a plan: the motions of hand and arm, watched by the judge."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import mujoco
import numpy as np

from .judge import DISTURBANCE, Contact, Judge, Phase
from .mechanism import Motion, NoPath, OutOfReach, ToolPose
from .world import Vector, World

GRASP_HEIGHT = 0.005
"""Of the fingertips above the table, m."""
ABOVE = 0.03
"""Between what is carried and the tallest dish, m."""
OPENING = 0.4
"""Of the pads' way in or out, s."""
REST = 0.1
"""After closing, after opening and before the next look, s."""
SLIPPED, TILTED = 0.005, 0.1
"""A dish that has moved or leans so far in the hand is dropped, m and rad. So is one that is pushed over the table's edge."""

ARRIVED = 0.05
"""A dish that stands so near to the middle of its drop-off has arrived, m. One that was lost on the way has not."""

Watcher = Callable[[World, Phase, str], None]
"""Sees the world, the phase and the dish that the step is about after each step of the physics."""


@dataclass
class Outcome:
    """What one step did, to the dish of this `name` and to others."""

    name: str
    contacts: list[Contact] = field(default_factory=list)
    disturbed: dict[str, float] = field(default_factory=dict)
    """Dishes that the step was not about, and how far their foot or their top has moved, m."""
    drop_off: str = ""
    """Where the dish was to be taken, if it was to leave the table."""
    dropped: bool = False
    place_error: float | None = None
    """Between where the dish was to be and where it is, m."""
    seconds: float = 0.0
    """Of simulated time."""
    failure: str = ""
    """`out_of_reach` or `no_path` where the step was not carried out to its end."""
    detail: str = ""

    def to_json(self) -> dict[str, object]:
        return {
            "object": self.name,
            "drop_off": self.drop_off,
            "contacts": [contact.to_json() for contact in self.contacts],
            "disturbed": self.disturbed,
            "dropped": self.dropped,
            "place_error": self.place_error,
            "seconds": self.seconds,
            "failure": self.failure,
        }


@dataclass(frozen=True)
class Spot:
    """Where the hand goes down: the place of a dish, and the yaw."""

    x: float
    y: float
    yaw: float

    def at(self, z: float) -> ToolPose:
        return ToolPose(self.x, self.y, z, self.yaw)


class Cell:
    def __init__(self, world: World, watch: Watcher | None = None) -> None:
        self.world = world
        self.judge = Judge(world)
        self._opening = world.open_round(min(item["radius"] for item in world.scene["objects"]))
        world.hand.command(world.data, self._opening)
        self._up = world.tallest + ABOVE + GRASP_HEIGHT
        self._watch = watch
        self._wait(REST, Phase.TRAVEL, "")
        self._stood = world.stands()
        """Where each dish stands unless something disturbs it."""

    def relocate(self, name: str, grasp: Spot, release: Spot) -> Outcome:
        """Picks the dish up at `grasp` and sets it down at `release`."""
        return self._carry_out(Outcome(name), grasp, release)

    def take_away(self, name: str, grasp: Spot, drop_off: str) -> Outcome:
        """Picks the dish up at `grasp` and sets it down at the drop-off, where it is taken out of the world."""
        release = Spot(*self.world.drop_offs[drop_off], grasp.yaw)
        return self._carry_out(Outcome(name, drop_off=drop_off), grasp, release)

    def take(self, name: str, grasp: Spot) -> Outcome:
        """Lifts the target."""
        return self._carry_out(Outcome(name), grasp, None)

    def _carry_out(self, outcome: Outcome, grasp: Spot, release: Spot | None) -> Outcome:
        began = float(self.world.data.time)
        self.judge.start(outcome.name)
        try:
            self._step(outcome, grasp, release)
        except OutOfReach as reason:
            outcome.failure, outcome.detail = "out_of_reach", str(reason)
        except NoPath as reason:
            outcome.failure, outcome.detail = "no_path", str(reason)
        self._judge(outcome)
        outcome.seconds = float(self.world.data.time) - began
        return outcome

    def _step(self, outcome: Outcome, grasp: Spot, release: Spot | None) -> None:
        name = outcome.name
        held_at = self._pick(name, grasp)
        if release:
            self._travel(release, name, Phase.CARRYING, name)
        outcome.dropped = self._slipped(name, held_at)
        if release:
            self._set_down(name, release)
            outcome.place_error = float(np.hypot(*(self.world.place(name)[:2] - (release.x, release.y))))
        if outcome.drop_off and (outcome.place_error or 0.0) < ARRIVED:
            self.world.take_away(name, outcome.drop_off)
            del self._stood[name]

    def _pick(self, name: str, grasp: Spot) -> Vector:
        """Grasps and lifts the dish. The result is where it stood in the hand before."""
        hand, radius = self.world.hand, self.world.radius(name)
        self._open_to(self.world.open_round(radius), Phase.TRAVEL, name)
        self._travel(grasp, None, Phase.TRAVEL, name)
        self._line(grasp.at(self._low(name)), Phase.DESCENT, name)
        self._open_to(hand.closed_on(radius), Phase.CLOSING, name)
        held_at = self._in_hand(name)
        self._line(grasp.at(self._up), Phase.LIFTING, name)
        return held_at

    def _set_down(self, name: str, release: Spot) -> None:
        self._line(release.at(self._low(name)), Phase.CARRYING, name)
        self._open_to(self.world.open_round(self.world.radius(name)), Phase.RELEASE, name)
        self._line(release.at(self._up), Phase.ASCENT, name)

    def _judge(self, outcome: Outcome) -> None:
        """What the step did to other dishes. Small pushes of several steps add up."""
        # After a step of the physics, places are those before it.
        mujoco.mj_kinematics(self.world.model, self.world.data)
        now = self.world.stands()
        moved = {name: float(np.max(np.linalg.norm(now[name] - stood, axis=1))) for name, stood in self._stood.items()}
        outcome.disturbed = {name: way for name, way in moved.items() if way > DISTURBANCE and name != outcome.name}
        for name in (outcome.name, *outcome.disturbed):
            if name in now:
                self._stood[name] = now[name]
        outcome.dropped |= any(self._is_off_table(stand[0]) for stand in now.values())
        outcome.contacts = self.judge.found()

    def _is_off_table(self, place: Vector) -> bool:
        """Whether a dish would fall: the table's plane has no edge."""
        table = self.world.scene["table"]
        x, y = place[:2]
        return not (table["x_min"] <= x <= table["x_max"] and table["y_min"] <= y <= table["y_max"])

    def _slipped(self, name: str, held_at: Vector) -> bool:
        dish = self.world.data.xmat[self.world.dishes[name]]
        lean = math.acos(min(1.0, dish[8]))
        return bool(np.linalg.norm(self._in_hand(name) - held_at) > SLIPPED or lean > TILTED)

    def _low(self, name: str) -> float:
        """Where the hand's origin is while its closed fingertips are at [`GRASP_HEIGHT`]."""
        hand = self.world.hand
        return GRASP_HEIGHT + hand.drop(hand.closed_on(self.world.radius(name)))

    def _in_hand(self, name: str) -> Vector:
        """Where the dish is in the hand's frame, m."""
        data, hand = self.world.data, self.world.model.body("hand").id
        return np.array(data.xmat[hand].reshape(3, 3).T @ (self.world.place(name) - data.xpos[hand]))

    def _travel(self, spot: Spot, held: str | None, phase: Phase, name: str) -> None:
        body = self.world.dishes[held] if held else None
        self._run(self.world.mechanism.travel(self.world.data, spot.at(self._up), body), phase, name)

    def _line(self, to: ToolPose, phase: Phase, name: str) -> None:
        self._run(self.world.mechanism.line(self.world.data, to), phase, name)

    def _run(self, motion: Motion, phase: Phase, name: str) -> None:
        for step in range(len(motion.positions)):
            self.world.mechanism.command(self.world.data, motion, step)
            self._tick(phase, name)

    def _open_to(self, to: float, phase: Phase, name: str) -> None:
        start, hand = self._opening, self.world.hand
        steps = round(OPENING / self.world.model.opt.timestep)
        for step in range(1, steps + 1):
            s = step / steps
            hand.command(self.world.data, start + (to - start) * s**3 * (10 - 15 * s + 6 * s**2))
            self._tick(phase, name)
        self._opening = to
        self._wait(REST, phase, name)

    def _wait(self, seconds: float, phase: Phase, name: str) -> None:
        for _ in range(round(seconds / self.world.model.opt.timestep)):
            self._tick(phase, name)

    def _tick(self, phase: Phase, name: str) -> None:
        mujoco.mj_step(self.world.model, self.world.data)
        if name:
            self.judge.look(phase)
        if self._watch:
            self._watch(self.world, phase, name)
