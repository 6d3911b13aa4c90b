#!/usr/bin/env bash
# pin skips an MJCF <frame> with everything inside it: joints, masses, geoms.
#
# One would guess: <frame pos=... euler=...> only moves what it holds. The bodies in it belong to the body around it.
#
# Seen with pin 4.1.0 (mujoco 4.0.0): a hand whose two fingers sit in frames loads as a hand without fingers. The
# model has 1 joint instead of 3. The geoms in a frame count neither as mass nor as collision shapes. No message
# appears.
#
# Why it matters: frames are how MJCF files place the fingers of a gripper in a ring, or mount a tool on a flange.
# The planner then checks a gripper without fingers against the table.
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


def finger(name):
    return (f'<body name="{name}" pos=".05 0 0"><joint name="{name}" type="slide" axis="-1 0 0"/>'
            '<geom type="box" size=".01 .01 .03" mass=".1"/></body>')


HAND = f"""<mujoco><compiler angle="radian"/><worldbody>
  <body name="hand"><joint name="yaw" axis="0 0 1"/><geom type="cylinder" size=".04 .02" mass="1"/>
    <frame euler="0 0 0">{finger("left")}</frame>
    <frame euler="0 0 3.14159265">{finger("right")}
      <geom type="box" size=".01 .01 .01" pos="0 0 .05" mass=".5"/></frame>
  </body></worldbody></mujoco>"""


Path("hand.xml").write_text(HAND)
theirs, ours = mujoco.MjModel.from_xml_string(HAND), pin.buildModelFromMJCF("hand.xml")
geoms = pin.buildGeomFromMJCF(ours, "hand.xml", pin.GeometryType.COLLISION)
mass, pin_mass = float(theirs.body_mass.sum()), pin.computeTotalMass(ours)
print("pin", pin.__version__, "mujoco", mujoco.__version__)
print(f"MuJoCo: {theirs.njnt} joints, {theirs.ngeom} geoms, {mass:.1f} kg;"
      f" pin: {ours.njoints - 1} joints, {geoms.ngeoms} geoms, {pin_mass:.1f} kg")
expect("MuJoCo has the hand with its fingers", theirs.njnt == 3 and theirs.ngeom == 4 and np.isclose(mass, 1.7))
expect("pin has the hand alone", ours.njoints - 1 == 1 and geoms.ngeoms == 1 and np.isclose(pin_mass, 1.0))
PY
