"""What a solid covers of the table, however it lies."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Iterable, Tuple, TypedDict

from singulate_ros.failure import Failure
from singulate_ros.hull import Point, Polygon, area, centroid, hull, simplified

if TYPE_CHECKING:
    from geometry_msgs.msg import Pose, Quaternion

Vector = Tuple[float, float, float]
Rotation = Tuple[Vector, Vector, Vector]

# Quaternions come in double precision, some by way of single: this far from length 1 it is no rounding any more.
UNIT_TOLERANCE = 1e-3
# A box that leans by less, rad, is upright, and its rectangle the wider for it.
UPRIGHT_TOLERANCE = 1e-2
# The most corners of a polygon that the service takes.
MOST_CORNERS = 32


class Corner(TypedDict):
    x: float
    y: float


class Shape(TypedDict, total=False):
    """Of a scene: a rectangle by length and width, or a polygon by its points."""

    kind: str
    length: float
    width: float
    points: list[Corner]


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
        return Placement((rotation[0], rotation[1], rotation[2]), self.at(inner.position))

    def at(self, inner: Vector) -> Vector:
        """What is at `inner` in the frame that this one places."""
        x, y, z = _apply(self.rotation, inner)
        return (self.position[0] + x, self.position[1] + y, self.position[2] + z)


@dataclass(frozen=True)
class Footprint:
    """On the table, and how far up the solid above it reaches. A circle has a radius; all else a shape, which is turned by
    yaw, and the corners of it as they lie on the table."""

    x: float
    y: float
    top: float
    radius: float = 0.0
    yaw: float = 0.0
    shape: Shape | None = None
    corners: Polygon = field(default_factory=list)
    assumed: str = ""
    """Where it is more than the solid covers: why."""


def box(placement: Placement, size: Vector, whose: str) -> Footprint:
    """A rectangle where the box is upright, whichever side is up; else the hull of its corners."""
    _positive(size, whose)
    signs = ((i, j, k) for i in (-0.5, 0.5) for j in (-0.5, 0.5) for k in (-0.5, 0.5))
    corners = [placement.at((i * size[0], j * size[1], k * size[2])) for i, j, k in signs]
    top = max(z for _, _, z in corners)
    x, y, _ = placement.position
    up = max(range(3), key=lambda axis: abs(placement.rotation[2][axis]))
    if abs(placement.rotation[2][up]) < math.cos(UPRIGHT_TOLERANCE):
        return _polygon((x, y), hull((corner[0], corner[1]) for corner in corners), top)
    lengthwise = (up + 1) % 3
    yaw = math.atan2(placement.rotation[1][lengthwise], placement.rotation[0][lengthwise])
    cos, sin = math.cos(yaw), math.sin(yaw)
    length = 2 * max(cos * (corner[0] - x) + sin * (corner[1] - y) for corner in corners)
    width = 2 * max(cos * (corner[1] - y) - sin * (corner[0] - x) for corner in corners)
    sides = ((length / 2 * i, width / 2 * j) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    around = [(x + cos * along - sin * across, y + sin * along + cos * across) for along, across in sides]
    return Footprint(x, y, top, yaw=yaw, shape=Shape(kind="rectangle", length=length, width=width), corners=around)


def cylinder(placement: Placement, radius: float, height: float, whose: str) -> Footprint:
    """The cylinder's own circle where it stands upright; wider by as much as its ends lean out where it does not."""
    _positive((radius, height), whose)
    upright = min(abs(placement.rotation[2][2]), 1.0)
    leaning = math.sqrt(1.0 - upright * upright)
    return _disc(placement, radius + height / 2 * leaning, height / 2 * upright + radius * leaning)


def sphere(placement: Placement, radius: float, whose: str) -> Footprint:
    _positive((radius,), whose)
    return _disc(placement, radius, radius)


def mesh(placement: Placement, vertices: Iterable[Vector], whose: str) -> Footprint:
    """The hull of all vertices, without holes or bays: a little wider still where it has too many corners."""
    placed = [placement.at(vertex) for vertex in vertices]
    if not all(math.isfinite(part) for vertex in placed for part in vertex):
        raise Failure(f"{whose} has a vertex at no place")
    around = hull((x, y) for x, y, _ in placed)
    if len(around) < 3:
        raise Failure(f"{whose} has no size: its {len(placed)} vertices cover nothing of the table")
    simple = simplified(around, MOST_CORNERS)
    assumed = "is a mesh, planned as the convex hull of its footprint"
    if len(simple) < len(around):
        growth = area(simple) / area(around) - 1
        assumed += f" with {len(simple)} of its {len(around)} corners: {growth:.2%} more area"
    return _polygon(centroid(simple), simple, max(z for _, _, z in placed), assumed)


def _disc(placement: Placement, radius: float, half_height: float) -> Footprint:
    x, y, z = placement.position
    return Footprint(x, y, z + half_height, radius=radius)


def _polygon(middle: Point, corners: Polygon, top: float, assumed: str = "") -> Footprint:
    x, y = middle
    shape = Shape(kind="polygon", points=[Corner(x=corner[0] - x, y=corner[1] - y) for corner in corners])
    return Footprint(x, y, top, shape=shape, corners=corners, assumed=assumed)


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
