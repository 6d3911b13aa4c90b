"""What the messages don't say."""

from __future__ import annotations

import math
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Settings:
    """The node's parameters with their defaults. Metres, radians and seconds but for what ends in _ms.

    A guess at the gripper or at the tool's height would end in a collision: left unset they are refused.
    """

    # All poses must be in this frame; it is the scene's.
    frame: str = "world"
    # The id of the collision object whose top is the table.
    table: str = "table"
    # The id of the object that is wanted.
    target: str = ""
    # Classes whose objects are round seen from above: their circle is the one inside the bounding box.
    round_classes: list[str] = field(default_factory=lambda: ["bowl", "cup", "plate"])
    fingers: int = 0
    finger_width: float = 0.0
    clearance: float = 0.0
    margin: float = 0.0
    yaw_tolerance: float = 0.0
    time_limit_ms: int = 1000
    # How deep detections may overlap: what perception errs by. Left unset, the service's own tolerance holds.
    overlap_tolerance: float = math.nan
    # The height of the tool's frame where it grasps and releases.
    tool_z: float = math.nan
    # Detections older than this say nothing about the table of now. The time to plan counts too.
    max_age: float = 1.0
