"""What is wanted: the target or the goal of a scene. Needs no ROS."""

from __future__ import annotations

from typing import TypedDict

from singulate_ros.failure import Failure
from singulate_ros.settings import Settings


class Goal(TypedDict, total=False):
    any_of: list[str]
    all_of: list[str]
    clear: bool


class Wanted(TypedDict, total=False):
    """The part of a scene that says it: one of the two."""

    target: str
    goal: Goal


def want(scene: Wanted, settings: Settings, names: set[str]) -> None:
    """Puts into a scene what the settings name, of the objects with these names. Of several, those that are not on the table are
    left out."""
    any_of, all_of = ([name for name in listed if name] for listed in (settings.any_of, settings.all_of))
    if sum(map(bool, (settings.target, any_of, all_of, settings.clear))) != 1:
        raise Failure("one of the parameters target, any_of, all_of and clear must be set")
    there = [name for name in any_of or all_of if name in names]
    if settings.target and settings.target not in names:
        raise Failure(f"the target '{settings.target}' is not on the table")
    if any_of and not there:
        raise Failure(f"none of {', '.join(any_of)} is on the table")
    if settings.target:
        scene["target"] = settings.target
    else:
        scene["goal"] = Goal(any_of=there) if any_of else Goal(all_of=there) if all_of else Goal(clear=True)


def is_reached(scene: Wanted) -> bool:
    """Whether all that was to be taken away is no longer on the table."""
    return scene.get("goal", {}).get("all_of") == []
