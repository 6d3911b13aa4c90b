#!/usr/bin/env bash
# pin reads the range of an MJCF slide joint as degrees: a metre of travel becomes 17 millimetres.
#
# One would guess: range="-0.5 0.5" of a slide is in metres, whatever the angle unit of the file. MuJoCo
# reads it so.
#
# Seen with pin 4.1.0 (mujoco 4.0.0): in a file without <compiler angle="radian"/>, and degrees are the MJCF default,
# pin multiplies the range of slides by pi/180, as if they were hinges. A gantry with 1 m of travel in x, 0.6 m in y
# and 0.3 m in z gets 17.5 mm, 10.5 mm and 5.2 mm. The range that a slide inherits from a default class too.
# Forward kinematics stays right, so nothing else looks wrong.
#
# Why it matters: a planner that samples between the limits of pin searches a cell the size of a stamp and reports that
# the goal cannot be reached; one that clamps to them drives the gripper to the wrong place.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check pin==4.1.0 mujoco-core==4.0.0 numpy==2.4.6
venv/bin/python - <<'PY'
import sys
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin


def expect(claim, holds):
    print(("as recorded: " if holds else "CHANGED: ") + claim)
    if not holds:
        sys.exit(1)


GANTRY = """
<mujoco>{}<default><default class="lift"><joint type="slide" axis="0 0 1" range="0 {}"/></default></default>
  <worldbody>
  <body name="x"><joint name="x" type="slide" axis="1 0 0" range="-.5 .5"/><geom size=".05"/>
    <body name="y"><joint name="y" type="slide" axis="0 1 0" range="-.3 .3"/><geom size=".05"/>
      <body name="z"><joint name="z" class="lift"/><geom size=".05"/>
        <body name="yaw"><joint name="yaw" axis="0 0 1" range="{}"/><geom size=".05"/></body>
      </body>
    </body>
  </body>
</worldbody></mujoco>"""


def ranges(xml):
    Path("gantry.xml").write_text(xml)
    model, other = mujoco.MjModel.from_xml_string(xml), pin.buildModelFromMJCF("gantry.xml")
    return model.jnt_range[:, 1] - model.jnt_range[:, 0], other.upperPositionLimit - other.lowerPositionLimit


print("pin", pin.__version__, "mujoco", mujoco.__version__)
theirs, ours = ranges(GANTRY.format("", 0.3, "-180 180"))
print("file in degrees: travel of x, y, z, yaw in MuJoCo", theirs.round(4), "in pin", ours.round(4))
expect("MuJoCo reads slides in metres", np.allclose(theirs, [1.0, 0.6, 0.3, 2 * np.pi]))
expect("pin shrinks slides by pi/180", np.allclose(ours[:3], np.radians([1.0, 0.6, 0.3])))
expect("both read the hinge in degrees", np.isclose(ours[3], 2 * np.pi))
theirs, ours = ranges(GANTRY.format('<compiler angle="radian"/>', 0.3, "-3.1416 3.1416"))
expect("a file in radians is read alike", np.allclose(theirs, ours))
PY
