"""The circle that a solid covers on the table, however it lies."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Tuple

from singulate_ros.failure import Failure

if TYPE_CHECKING:
    from geometry_msgs.msg import Pose, Quaternion

Vector = Tuple[float, float, float]
Rotation = Tuple[Vector, Vector, Vector]

# Quaternions come in double precision, some by way of single: this far from length 1 it is no rounding any more.
UNIT_TOLERANCE = 1e-3


@dataclass(frozen=True)
class Placement:
    """Where a solid is and how it is turned: what is at v in its own frame is at rotation * v + position."""

    rotation: Rotation
    position: Vector

    @staticmethod
    def of(pose: Pose, whose: str) -> Placement:
        position = (pose.position.x, pose.position.y, pose.position.z)
        if not all(map(math.isfinite, position)):
            raise Failure(f"{whose} is at no place: {position}")
        return Placement(_rotation(pose.orientation, whose), position)

    def then(self, inner: Placement) -> Placement:
        """What is placed by `inner` in the frame that this one places."""
        columns = [_apply(self.rotation, (row[0], row[1], row[2])) for row in zip(*inner.rotation)]
        rotation = tuple((columns[0][axis], columns[1][axis], columns[2][axis]) for axis in range(3))
        x, y, z = _apply(self.rotation, inner.position)
        position = (self.position[0] + x, self.position[1] + y, self.position[2] + z)
        return Placement((rotation[0], rotation[1], rotation[2]), position)


@dataclass(frozen=True)
class Footprint:
    """A circle on the table, and how far up the solid above it reaches."""

    x: float
    y: float
    radius: float
    top: float


def box(placement: Placement, size: Vector, whose: str) -> Footprint:
    """The circumscribed circle of the box's shadow: nothing of the box is outside, whatever its yaw."""
    _positive(size, whose)
    x, y, z = (length / 2 for length in size)
    # The other four corners are opposite to these, as far from the middle.
    corners = [_apply(placement.rotation, (x, side * y, end * z)) for side in (1, -1) for end in (1, -1)]
    radius = max(math.hypot(corner[0], corner[1]) for corner in corners)
    return _footprint(placement, radius, max(abs(corner[2]) for corner in corners))


def cylinder(placement: Placement, radius: float, height: float, whose: str) -> Footprint:
    """The cylinder's own circle where it stands upright; wider by as much as its ends lean out where it does not."""
    _positive((radius, height), whose)
    upright = min(abs(placement.rotation[2][2]), 1.0)
    leaning = math.sqrt(1.0 - upright * upright)
    return _footprint(placement, radius + height / 2 * leaning, height / 2 * upright + radius * leaning)


def sphere(placement: Placement, radius: float, whose: str) -> Footprint:
    _positive((radius,), whose)
    return _footprint(placement, radius, radius)


def _footprint(placement: Placement, radius: float, half_height: float) -> Footprint:
    x, y, z = placement.position
    return Footprint(x, y, radius, z + half_height)


def _positive(lengths: tuple[float, ...], whose: str) -> None:
    if not all(math.isfinite(length) and length > 0 for length in lengths):
        raise Failure(f"{whose} has no size: {lengths}")


def _rotation(q: Quaternion, whose: str) -> Rotation:
    length = math.hypot(q.x, q.y, q.z, q.w)
    # Written so that it refuses what is not a number, too.
    if not abs(length - 1.0) <= UNIT_TOLERANCE:
        raise Failure(f"{whose} is turned by no unit quaternion: its length is {length}")
    x, y, z, w = q.x / length, q.y / length, q.z / length, q.w / length
    return (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )


def _apply(rotation: Rotation, vector: Vector) -> Vector:
    x, y, z = (sum(a * b for a, b in zip(row, vector)) for row in rotation)
    return (x, y, z)
