"""Convex polygons, their corners counter-clockwise."""

from __future__ import annotations

import math
from typing import Iterable, List, Tuple

Point = Tuple[float, float]
Polygon = List[Point]


def hull(points: Iterable[Point]) -> Polygon:
    """The least convex polygon that holds all points; fewer than three corners where they lie on one line."""
    ordered = sorted(set(points))
    lower, upper = _chain(ordered), _chain(ordered[::-1])
    return lower[:-1] + upper[:-1]


def area(polygon: Polygon) -> float:
    return sum(_turn((0.0, 0.0), *edge) for edge in zip(polygon, polygon[1:] + polygon[:1])) / 2


def centroid(polygon: Polygon) -> Point:
    """Of the area. Measured from a corner: far from the origin the digits would not do."""
    x, y = polygon[0]
    twice, sum_x, sum_y = 0.0, 0.0, 0.0
    for one, other in zip(polygon[1:], polygon[2:]):
        part = _turn(polygon[0], one, other)
        twice += part
        sum_x += part * (one[0] + other[0] - 2 * x) / 3
        sum_y += part * (one[1] + other[1] - 2 * y) / 3
    return x + sum_x / twice, y + sum_y / twice


def simplified(polygon: Polygon, most: int) -> Polygon:
    """At most so many corners, five or more. Holds the polygon: edges are left out, and their neighbours meet further out."""
    while len(polygon) > most:
        _, at, corner = min(_without(polygon, at) for at in range(len(polygon)))
        polygon = [polygon[at - 2], corner, *_from(polygon, at + 1, len(polygon) - 3)]
    return polygon


def overlap(one: Polygon, other: Polygon) -> bool:
    """Whether they have more in common than a border: no edge of either parts them."""
    return not (_parts(one, other) or _parts(other, one))


def _chain(points: list[Point]) -> list[Point]:
    chain: list[Point] = []
    for point in points:
        while len(chain) >= 2 and _turn(chain[-2], chain[-1], point) <= 0:
            chain.pop()
        chain.append(point)
    return chain


def _turn(a: Point, b: Point, c: Point) -> float:
    """Twice the area of the triangle; above zero where the way a, b, c turns to the left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _from(polygon: Polygon, start: int, count: int) -> Polygon:
    return [polygon[(start + step) % len(polygon)] for step in range(count)]


def _without(polygon: Polygon, at: int) -> tuple[float, int, Point]:
    """How much area it adds to leave out the edge that ends in the corner `at`, and where its neighbours meet then."""
    before, start, end, after = _from(polygon, at - 2, 4)
    along, back = (start[0] - before[0], start[1] - before[1]), (end[0] - after[0], end[1] - after[1])
    closing = back[0] * along[1] - back[1] * along[0]
    if closing <= 0:
        return math.inf, at, end  # they part
    reach = (back[0] * (end[1] - start[1]) - back[1] * (end[0] - start[0])) / closing
    corner = (start[0] + reach * along[0], start[1] + reach * along[1])
    return abs(_turn(start, corner, end)), at, corner


def _parts(one: Polygon, other: Polygon) -> bool:
    edges = zip(one, one[1:] + one[:1])
    return any(all(_turn(start, end, point) <= 0 for point in other) for start, end in edges)
