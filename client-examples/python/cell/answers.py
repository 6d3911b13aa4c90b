"""Answers of the service, each verdict a type of its own."""

from dataclasses import dataclass, replace
from typing import Any


class Unknown(Exception):
    """An answer that this client does not understand. It must not act on it."""


@dataclass(frozen=True)
class Place:
    x: float
    y: float


@dataclass(frozen=True)
class Relocation:
    object: str
    start: Place
    to: Place
    grasp_yaw: float
    release_yaw: float


@dataclass(frozen=True)
class Plan:
    """What is left to do: the steps, then the grasp of the target."""

    steps: tuple[Relocation, ...]
    target: str
    yaw: float
    body: dict[str, Any]
    """The same as the service has put it."""

    def rest(self) -> "Plan":
        """What is left after the first step."""
        body = {**self.body, "relocations": self.body["relocations"][1:]}
        return replace(self, steps=self.steps[1:], body=body)


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
            steps = tuple(_relocation(step) for step in body["relocations"])
            if (verdict == "relocate") != bool(steps):
                raise Unknown(f"{len(steps)} relocations with the verdict '{verdict}'")
            return Plan(steps, str(body["target"]), float(body["target_grasp"]["yaw"]), body)
        case "deadlock":
            return Deadlock(_ids((body["deadlock"] or {}).get("core")))
        case "no_space":
            return NoSpace(_ids(body["needed"]))
        case "timed_out":
            return TimedOut(_ids(body["needed"]))
        case verdict:
            raise Unknown(f"unknown verdict '{verdict}'")


def _relocation(step: Any) -> Relocation:
    if step["action"] != "pick_place":
        raise Unknown(f"unknown action '{step['action']}'")
    return Relocation(
        object=str(step["object"]),
        start=_place(step["from"]),
        to=_place(step["to"]),
        grasp_yaw=float(step["grasp"]["yaw"]),
        release_yaw=float(step["release"]["yaw"]),
    )


def _place(body: Any) -> Place:
    return Place(float(body["x"]), float(body["y"]))


def _ids(body: Any) -> tuple[str, ...]:
    return tuple(str(name) for name in body or ())
