"""Drop-offs: collision objects beside the table, such as a tray or a bin. Needs no ROS."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypedDict

from singulate_ros.failure import Failure
from singulate_ros.settings import Settings

if TYPE_CHECKING:
    from singulate_ros.footprint import Footprint

# How the settings say that a drop-off takes any number of objects.
ANY_NUMBER = -1


class WithoutLimits(TypedDict):
    id: str


class DropOff(WithoutLimits, total=False):
    capacity: int
    accepts: list[str]


@dataclass(frozen=True)
class Configured:
    """One drop-off of the settings. Without classes it accepts objects of any."""

    name: str
    capacity: int
    classes: list[str]

    def in_scene(self, classes: dict[str, str]) -> DropOff:
        """As a part of a scene in which the movable objects have these classes."""
        drop_off = DropOff(id=self.name)
        if self.capacity != ANY_NUMBER:
            drop_off["capacity"] = self.capacity
        if self.classes:
            drop_off["accepts"] = [name for name, kind in classes.items() if kind in self.classes]
        return drop_off


def configured(settings: Settings) -> list[Configured]:
    """The drop-offs of the settings that are not full."""
    names, capacities, classes = settings.drop_offs, settings.drop_off_capacities, settings.drop_off_classes
    if not len(names) == len(capacities) == len(classes):
        raise Failure("drop_off_capacities and drop_off_classes need one entry for each of drop_offs")
    found = [
        Configured(name, capacity, kinds.split()) for name, capacity, kinds in zip(names, capacities, classes) if name
    ]
    for each in found:
        if each.capacity < ANY_NUMBER:
            raise Failure(f"the drop-off '{each.name}' has a capacity of {each.capacity}")
    if found and not math.isfinite(settings.drop_z):
        raise Failure("the parameter drop_z is not set")
    return [each for each in found if each.capacity != 0]


def middle(solids: list[Footprint], name: str) -> tuple[float, float]:
    """Where the gripper opens over a drop-off: over the middle of its solids."""
    if not solids:
        raise Failure(f"the planning scene has no solid of the drop-off '{name}'")
    return sum(each.x for each in solids) / len(solids), sum(each.y for each in solids) / len(solids)
