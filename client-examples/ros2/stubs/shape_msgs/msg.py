from dataclasses import dataclass
from typing import Sequence

from geometry_msgs.msg import Point


@dataclass
class SolidPrimitive:
    BOX = 1
    SPHERE = 2
    CYLINDER = 3
    CONE = 4

    type: int = 0
    dimensions: Sequence[float] = ()


@dataclass
class Mesh:
    vertices: Sequence[Point] = ()


@dataclass
class Plane:
    coef: Sequence[float] = (0.0, 0.0, 0.0, 0.0)
