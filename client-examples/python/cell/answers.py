"""Answers of the service, each verdict a type of its own."""

from dataclasses import dataclass, replace
from typing import Any


class Unknown(Exception):
    """An answer that this client does not understand. It must not act on it."""


@dataclass(frozen=True)
class Pose:
    """Of an object: its own frame, or the centre of a disc."""

    x: float
    y: float
    yaw: float | None
    """None for a disc that may be grasped at every yaw."""


@dataclass(frozen=True)
class Grip:
    """Of the gripper: its axis, and the direction of finger 0."""

    x: float
    y: float
    yaw: float


@dataclass(frozen=True)
class Relocation:
    """To another place on the table."""

    object: str
    start: Pose
    to: Pose
    grasp: Grip
    release: Grip
    turn: float | None
    """How far the object turns on the way, if that is said, rad."""


@dataclass(frozen=True)
class Removal:
    """Away from the table."""

    object: str
    start: Pose
    grasp: Grip
    drop_off: str


@dataclass(frozen=True)
class Grasp:
    """The target can be grasped."""

    target: str
    grip: Grip


@dataclass(frozen=True)
class AllAway:
    """All that is wanted away is away."""


@dataclass(frozen=True)
class Cleared:
    pass


@dataclass(frozen=True)
class PartlyCleared:
    left: tuple[str, ...]
    stuck: tuple[str, ...]
    """The core of what locks itself; empty if nothing does."""
    proven: bool
    """False if more could perhaps be taken away."""


Step = Relocation | Removal
End = Grasp | AllAway | Cleared | PartlyCleared


@dataclass(frozen=True)
class Plan:
    """What is left to do: the steps, then what comes of them."""

    steps: tuple[Step, ...]
    end: End
    body: dict[str, Any]
    """The same as the service has put it."""

    def rest(self) -> "Plan":
        """What is left after the first step."""
        body = {**self.body, "relocations": self.body["relocations"][1:]}
        return replace(self, steps=self.steps[1:], body=body)

    @property
    def is_done(self) -> bool:
        """Whether the robot has nothing left to do."""
        return not self.steps and not isinstance(self.end, Grasp)


@dataclass(frozen=True)
class Deadlock:
    core: tuple[str, ...]


@dataclass(frozen=True)
class NoSpace:
    needed: tuple[str, ...]


@dataclass(frozen=True)
class TimedOut:
    needed: tuple[str, ...]


Answer = Plan | Deadlock | NoSpace | TimedOut


def read(body: Any) -> Answer:
    """The answer in a decoded body, or Unknown."""
    try:
        return _verdict(body)
    except (KeyError, TypeError, ValueError) as error:
        raise Unknown(f"the answer lacks a part or has a wrong one: {error!r}") from error


def read_replan(body: Any) -> bool:
    """Whether a verification asks for a new plan, or Unknown."""
    replan = body.get("replan") if isinstance(body, dict) else None
    if not isinstance(replan, bool):
        raise Unknown("the verification does not say whether to plan again")
    return replan


def _verdict(body: Any) -> Answer:
    match body["verdict"]:
        case "graspable" | "relocate" as verdict:
            plan = _plan(body, _end(body))
            if (verdict == "relocate") != bool(plan.steps):
                raise Unknown(f"{len(plan.steps)} relocations with the verdict '{verdict}'")
            return plan
        case "cleared":
            return _plan(body, Cleared())
        case "partly_cleared":
            if not isinstance(proven := body["proven"], bool):
                raise TypeError("'proven' is neither true nor false")
            return _plan(body, PartlyCleared(_listed(body["left"]), _core(body["stuck"]), proven))
        case "deadlock":
            return Deadlock(_core(body["deadlock"]))
        case "no_space":
            return NoSpace(_ids(body["needed"]))
        case "timed_out":
            return TimedOut(_ids(body["needed"]))
        case verdict:
            raise Unknown(f"unknown verdict '{verdict}'")


def _plan(body: Any, end: End) -> Plan:
    return Plan(tuple(_step(step) for step in body["relocations"]), end, body)


def _end(body: Any) -> Grasp | AllAway:
    """Without a target, objects are taken away and none is grasped in the end."""
    if body["target"] is None and body["target_grasp"] is None:
        return AllAway()
    return Grasp(_text(body["target"]), _grip(body["target_grasp"]))


def _step(step: Any) -> Step:
    match step["action"]:
        case "pick_place":
            return Relocation(
                object=_text(step["object"]),
                start=_pose(step["from"]),
                to=_pose(step["to"]),
                grasp=_grip(step["grasp"]),
                release=_grip(step["release"]),
                turn=_angle(step, "turn"),
            )
        case "pick_drop":
            return Removal(
                object=_text(step["object"]),
                start=_pose(step["from"]),
                grasp=_grip(step["grasp"]),
                drop_off=_text(step["drop_off"]),
            )
        case action:
            raise Unknown(f"unknown action '{action}'")


def _pose(body: Any) -> Pose:
    return Pose(float(body["x"]), float(body["y"]), _angle(body, "yaw"))


def _grip(body: Any) -> Grip:
    return Grip(float(body["x"]), float(body["y"]), float(body["yaw"]))


def _angle(body: Any, name: str) -> float | None:
    """What stands only where it says something."""
    return float(body[name]) if name in body else None


def _core(lock: Any) -> tuple[str, ...]:
    return _listed(lock["core"]) if lock is not None else ()


def _ids(body: Any) -> tuple[str, ...]:
    return _listed(body) if body is not None else ()


def _listed(body: Any) -> tuple[str, ...]:
    if not isinstance(body, list):
        raise TypeError(f"{body!r} is no list")
    return tuple(_text(name) for name in body)


def _text(body: Any) -> str:
    if not isinstance(body, str):
        raise TypeError(f"{body!r} is no text")
    return body
