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
    # What is wanted, one of these four: the id of one object; ids of which any will do, or which are all to be taken away; or
    # that the table is cleared. An empty list has no type in ROS: [""] stands for none.
    target: str = ""
    any_of: list[str] = field(default_factory=lambda: [""])
    all_of: list[str] = field(default_factory=lambda: [""])
    clear: bool = False
    # The ids of the collision objects that are drop-offs; [""] stands for none.
    drop_offs: list[str] = field(default_factory=lambda: [""])
    # How many more objects each takes: -1 for any number, 0 for a full one.
    drop_off_capacities: list[int] = field(default_factory=lambda: [-1])
    # The classes that each accepts, with spaces between them; "" for all.
    drop_off_classes: list[str] = field(default_factory=lambda: [""])
    # Where objects go that have to move. Left empty, the service's own default holds.
    destination: str = ""
    # Classes whose objects are round seen from above: their circle is the one inside the bounding box.
    round_classes: list[str] = field(default_factory=lambda: ["bowl", "cup", "plate"])
    fingers: int = 0
    finger_width: float = 0.0
    clearance: float = 0.0
    margin: float = 0.0
    yaw_tolerance: float = 0.0
    # How far the hand opens, and how far it does; left unset, it opens as far as each object needs.
    max_opening: float = math.nan
    opening: str = ""
    # From the fingers' tips to the palm, and the palm's radius: both, or neither, and then no palm is planned with.
    finger_length: float = math.nan
    palm_radius: float = math.nan
    # The tips over the table where they grasp what is low. Left unset, 0.
    tip_height: float = math.nan
    time_limit_ms: int = 1000
    # How deep detections may overlap: what perception errs by. Left unset, the service's own tolerance holds.
    overlap_tolerance: float = math.nan
    # The height of the tool's frame where it grasps and releases. With a finger_length: that of what is no higher than
    # finger_length and tip_height; over anything higher the tool stays up by the difference.
    tool_z: float = math.nan
    # The same where it releases over a drop-off.
    drop_z: float = math.nan
    # Detections older than this say nothing about the table of now. The time to plan counts too.
    max_age: float = 1.0
