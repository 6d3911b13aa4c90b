#!/usr/bin/env bash
# A scene that MuJoCo saves as XML comes back with six digits a number, and objects that were apart overlap.
#
# One would guess: MjSpec.to_xml(), read again, gives the same model. Doubles are written so that they survive.
#
# Seen with mujoco 4.0.0: positions, sizes, quaternions and keyframes are written with six significant digits,
# and Python has no option for more. In a row of 20 balls that are 1 micrometre apart, 1.2 m from the origin,
# numbers move by up to 4.8 micrometres, and 15 of the 19 gaps become overlaps. A ball at x = 123.45649 m comes
# back at 123.456 m.
#
# Why it matters: a planner proves a scene free of contact. The saved scene, run later or elsewhere, has contacts
# and forces.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check mujoco-core==4.0.0 numpy==2.4.6
"$work/venv/bin/python" - <<'PY'
import sys

import mujoco
import numpy as np


def expect(claim, holds):
    print(("as recorded: " if holds else "CHANGED: ") + claim)
    if not holds:
        sys.exit(1)


def row(spec, count=20, radius=0.0123456789, gap=1e-6):
    for i in range(count):
        angle = 0.0123456789 * (i + 1)
        ball = spec.worldbody.add_body(
            name=f"ball{i}", pos=[1.2 + i * (2 * radius + gap), 1.23456789, 0.03],
            quat=[np.cos(angle), 0, 0, np.sin(angle)])
        ball.add_freejoint()
        ball.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[radius, 0, 0])


def overlaps(model):
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return sum(c.dist < 0 for c in data.contact[: data.ncon])


spec = mujoco.MjSpec()
row(spec)
before = spec.compile()
after = mujoco.MjModel.from_xml_string(spec.to_xml())
moved = abs(before.qpos0 - after.qpos0).max()
print("mujoco", mujoco.__version__)
print(f"numbers move by up to {moved:.1e} m; overlaps before {overlaps(before)}, after {overlaps(after)}")
far = mujoco.MjSpec()
far.worldbody.add_body(pos=[123.45649, 0, 0]).add_geom(size=[0.1, 0, 0])
far.compile()
far = mujoco.MjModel.from_xml_string(far.to_xml()).body_pos[1, 0]
print(f"a ball at 123.45649 m comes back at {far:.5f} m")
expect("the row is free of contact before it is saved", overlaps(before) == 0)
expect("positions move by more than a micrometre", 1e-6 < moved < 1e-5)
expect("balls overlap in the saved scene", overlaps(after) > 0)
expect("half a millimetre is lost at 123 m", abs(far - 123.45649) > 4e-4)
PY
