#!/usr/bin/env bash
# pin reads only the first body under the MJCF worldbody. A robot that stands second is not in the model.
#
# One would guess: every body of the scene is loaded, or the loader refuses the file.
#
# Seen with pin 4.1.0 (mujoco 4.0.0): a worldbody with a stand and then an arm gives a model without joints
# (0 against 2), and the geoms of the arm are missing too. The arm first and the stand second gives the arm without
# the stand, so its collision model has no obstacle. No message appears.
#
# Why it matters: a robot cell is a scene of several root bodies: arm, table, fixtures, objects. Which of them
# exist for the planner depends on their order in the file, and the ones left out are never in collision.
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
import pinocchio as pin


def expect(claim, holds):
    print(("as recorded: " if holds else "CHANGED: ") + claim)
    if not holds:
        sys.exit(1)


STAND = '<body name="stand" pos=".6 0 .2"><geom name="stand" type="box" size=".1 .1 .2"/></body>'
ARM = """
<body name="arm" pos="0 0 .1"><joint name="shoulder" axis="0 1 0"/><geom name="arm" type="capsule" size=".03 .2"/>
  <body name="fore" pos=".3 0 0"><joint name="elbow" axis="0 1 0"/><geom name="fore" type="capsule" size=".03 .2"/>
  </body></body>"""


def load(bodies):
    xml = f"<mujoco><worldbody>{bodies}</worldbody></mujoco>"
    Path("cell.xml").write_text(xml)
    model = pin.buildModelFromMJCF("cell.xml")
    geoms = pin.buildGeomFromMJCF(model, "cell.xml", pin.GeometryType.COLLISION)
    return mujoco.MjModel.from_xml_string(xml), model, geoms


print("pin", pin.__version__, "mujoco", mujoco.__version__)
for order, bodies, joints, shapes in [("stand, arm", STAND + ARM, 0, 1), ("arm, stand", ARM + STAND, 2, 2)]:
    theirs, ours, geoms = load(bodies)
    print(f"{order}: MuJoCo {theirs.njnt} joints, {theirs.ngeom} geoms; pin {ours.njoints - 1} and {geoms.ngeoms}")
    expect("MuJoCo has both joints and all three geoms", theirs.njnt == 2 and theirs.ngeom == 3)
    expect("pin has only what belongs to the first body", ours.njoints - 1 == joints and geoms.ngeoms == shapes)
PY
