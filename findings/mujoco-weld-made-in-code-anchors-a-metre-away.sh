#!/usr/bin/env bash
# A weld or connect added with MjSpec acts at a point one metre beside the body.
#
# One would guess: spec.add_equality(type=mjEQ_WELD, name1="hand", name2="disc") is the same constraint as
# <weld body1="hand" body2="disc"/>, whose anchor is at the origin of the body.
#
# Seen with mujoco 4.0.0: a new equality starts with data = [0 1 0 ...], the coefficients of a joint coupling. A
# weld and a connect read the first three numbers as their anchor, so it is (0, 1, 0): one metre along y.
# Nothing warns. A hand that moves 200 mm and turns by one radian, there and back, in one second:
#   weld from XML               disc strays by  24 mm from its place in the hand
#   weld from MjSpec            disc strays by 1342 mm
#   weld from MjSpec, data[:3]=0, the same as from XML
# The spec writes the anchor out as anchor="0 1 0" when it is saved as XML.
#
# Why it matters: a weld that is switched on is the usual stand-in for a grasp. Built in code, it flings the
# object it should hold, and the fault looks like a bad solver setting.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check mujoco-core==4.0.0 numpy==2.4.6
"$work/venv/bin/python" - <<'PY'
import sys

import mujoco
import numpy as np

SCENE = """
<mujoco><worldbody>
  <body name="hand" mocap="true" pos="0 0 .5"><geom type="box" size=".02 .02 .02" contype="0" conaffinity="0"/></body>
  <body name="disc" pos="0 0 .44"><freejoint/><geom type="cylinder" size=".04 .02" mass=".3"/></body>
</worldbody>{}</mujoco>"""
KIND = {"weld": mujoco.mjtEq.mjEQ_WELD, "connect": mujoco.mjtEq.mjEQ_CONNECT}


def expect(claim, holds):
    print(("as recorded: " if holds else "CHANGED: ") + claim)
    if not holds:
        sys.exit(1)


def from_code(kind, anchor=None):
    spec = mujoco.MjSpec.from_string(SCENE.format(""))
    equality = spec.add_equality(type=KIND[kind], objtype=mujoco.mjtObj.mjOBJ_BODY, name1="hand", name2="disc")
    if anchor is not None:
        data = np.array(equality.data)
        data[:3] = anchor
        equality.data = data
    model = spec.compile()
    return model, spec.to_xml()


def from_xml(element):
    return mujoco.MjModel.from_xml_string(SCENE.format(f"<equality>{element}</equality>"))


def strays(model):
    data, worst = mujoco.MjData(model), 0.0
    for step in range(500):
        swing = 0.5 * (1 - np.cos(2 * np.pi * step * model.opt.timestep))
        data.mocap_pos[0] = [0.2 * swing, 0, 0.5]
        data.mocap_quat[0] = [np.cos(swing / 2), 0, 0, np.sin(swing / 2)]
        mujoco.mj_step(model, data)
        mujoco.mj_forward(model, data)
        offset = data.xmat[1].reshape(3, 3).T @ (data.xpos[2] - data.xpos[1])
        worst = max(worst, np.linalg.norm(offset - [0, 0, -0.06]))
    return worst


print("mujoco", mujoco.__version__)
for kind, element in [("weld", '<weld body1="hand" body2="disc"/>'),
                      ("connect", '<connect body1="hand" body2="disc" anchor="0 0 0"/>')]:
    model, saved = from_code(kind)
    print(f"{kind}: anchor from code {model.eq_data[0, :3]}, from XML {from_xml(element).eq_data[0, :3]}")
    expect(f"the anchor of a new {kind} is one metre away", np.allclose(model.eq_data[0, :3], [0, 1, 0]))
    expect(f"a saved {kind} shows it", 'anchor="0 1 0"' in saved)

plain = strays(from_xml('<weld body1="hand" body2="disc"/>'))
code = strays(from_code("weld")[0])
zeroed = strays(from_code("weld", anchor=[0, 0, 0])[0])
print(f"disc strays: XML {plain * 1e3:.1f} mm, MjSpec {code * 1e3:.1f} mm, MjSpec zeroed {zeroed * 1e3:.1f} mm")
expect("the weld from code flings the disc", code > 0.3)
expect("the weld from XML holds it", plain < 0.05)
expect("an anchor of zero makes both the same", abs(plain - zeroed) < 1e-6)
PY
