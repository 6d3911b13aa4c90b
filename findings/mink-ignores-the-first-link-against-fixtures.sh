#!/usr/bin/env bash
# mink drops every collision pair of the first moving link with a fixed geom, without a word.
#
# One would guess: CollisionAvoidanceLimit(model, [(["hand"], ["fixture"])]) keeps the hand out of the fixture, or
# complains that it cannot. MuJoCo itself reports the contact of the two.
#
# Seen with mink 1.3.0 (mujoco 4.0.0): mink leaves out pairs of parent and child bodies. Unlike MuJoCo, it also
# counts the world as a parent. Fixed geoms belong to the world. A hand whose body hangs at the world therefore
# loses all its pairs with the table and the fixtures: geom_id_pairs is empty.
# A gantry hand with its x, y and z joints in one body runs 60 mm deep into the fixture. The same hand with the y
# joint in a carriage of its own stops 5 mm before it.
#
# Why it matters: a gantry written as one body with several joints is the natural MJCF of an overhead gripper.
# Its inverse kinematics then has no collision limit at all.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check mink==1.3.0 mujoco==4.0.0 mujoco-core==4.0.0 \
  numpy==2.4.6 daqp==0.11.0
"$work/venv/bin/python" - <<'PY'
import sys
from importlib.metadata import version

import mink
import mujoco
import numpy as np


def expect(claim, holds):
    print(("as recorded: " if holds else "CHANGED: ") + claim)
    if not holds:
        sys.exit(1)


X, Y, Z = (f'<joint name="{n}" type="slide" axis="{a}"/>' for n, a in [("x", "1 0 0"), ("y", "0 1 0"), ("z", "0 0 1")])
HAND = '<geom name="hand" type="box" size=".03 .03 .03"/><site name="tip"/>'
ONE_BODY = f'<body name="hand" pos="0 0 .1">{X}{Y}{Z}{HAND}</body>'
CARRIAGE = (f'<body name="carriage">{Y}<geom size=".01" contype="0" conaffinity="0"/>'
            f'<body name="hand" pos="0 0 .1">{X}{Z}{HAND}</body></body>')


def run(gantry):
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><worldbody>
      <geom name="fixture" type="box" size=".05 .05 .05" pos=".5 0 .1"/>{gantry}</worldbody></mujoco>""")
    limit = mink.CollisionAvoidanceLimit(model, [(["hand"], ["fixture"])], minimum_distance_from_collisions=0.005,
                                         collision_detection_distance=0.05)
    limits = [limit, mink.VelocityLimit(model, {"x": 0.5, "y": 0.5, "z": 0.5})]
    task = mink.FrameTask("tip", "site", position_cost=1.0, orientation_cost=0.0)
    task.set_target(mink.SE3.from_translation(np.array([0.48, 0.0, 0.1])))
    hand = mink.Configuration(model)
    hand.update(np.zeros(model.nq))
    for _ in range(300):
        hand.integrate_inplace(mink.solve_ik(hand, [task], 0.01, "daqp", limits=limits), 0.01)
    mujoco.mj_forward(model, hand.data)
    gap = 0.5 - 0.05 - 0.03 - hand.data.site("tip").xpos[0]
    return len(limit.geom_id_pairs), gap, hand.data.ncon


print("mink", version("mink"), "mujoco", mujoco.__version__)
one, two = run(ONE_BODY), run(CARRIAGE)
for name, (pairs, gap, contacts) in [("one body", one), ("hand on a carriage", two)]:
    print(f"{name}: {pairs} pairs kept, gap to the fixture {gap * 1e3:.1f} mm, {contacts} MuJoCo contacts")
expect("the pair of a hand at the world is dropped", one[0] == 0)
expect("the hand runs into the fixture", one[1] < -0.05)
expect("MuJoCo does report contacts", one[2] > 0)
expect("the same hand on a carriage stops in front", two[0] == 1 and 0.004 < two[1] < 0.006)
PY
