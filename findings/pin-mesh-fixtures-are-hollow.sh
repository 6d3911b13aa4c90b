#!/usr/bin/env bash
# For pin and coal a fixture given as a mesh is hollow: a disc inside it is reported free, with 80 mm of clearance.
#
# One would guess: a closed mesh in <collision> is a solid. What lies wholly inside it collides.
#
# Seen with pin 4.1.0, coal 3.0.3, mujoco 4.0.0: a block 1 x 1 x 0.2 m as an OBJ, and a disc of 60 mm by 40 mm
# that moves down through it. pin reports collision only while the disc cuts the surface. In the middle of the
# block it reports none, and computeDistances gives +80 mm. The same block as <box>, or MuJoCo with the same
# OBJ, reports 120 mm of penetration.
#
# Why it matters: a path is checked at sampled states. One that enters a thick table between two samples passes.
# The larger the clearance reported inside, the longer the steps that an adaptive checker takes there.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check pin==4.1.0 coal==3.0.3 mujoco-core==4.0.0 numpy==2.4.6
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


CORNERS = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.1, 0.1)]
FACES = [(1, 2, 4), (1, 4, 3), (5, 7, 8), (5, 8, 6), (1, 5, 6), (1, 6, 2), (3, 4, 8), (3, 8, 7), (1, 3, 7), (1, 7, 5),
         (2, 6, 8), (2, 8, 4)]
OBJ = "".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS) + "".join(f"f {a} {b} {c}\n" for a, b, c in FACES)
Path("block.obj").write_text(OBJ)
URDF = """<robot name="cell">
  <link name="block"><collision><geometry>{}</geometry></collision></link>
  <link name="disc"><inertial><mass value="1"/><inertia ixx=".1" ixy="0" ixz="0" iyy=".1" iyz="0" izz=".1"/></inertial>
    <collision><geometry><cylinder radius=".03" length=".04"/></geometry></collision></link>
  <joint name="z" type="prismatic"><parent link="block"/><child link="disc"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"""
MESH, BOX = URDF.format('<mesh filename="block.obj"/>'), URDF.format('<box size="1 1 .2"/>')


def in_pin(urdf, height):
    Path("cell.urdf").write_text(urdf)
    model = pin.buildModelFromUrdf("cell.urdf")
    geoms = pin.buildGeomFromUrdf(model, "cell.urdf", pin.GeometryType.COLLISION, package_dirs=["."])
    geoms.addAllCollisionPairs()
    data, found, q = model.createData(), geoms.createData(), np.array([height])
    hit = pin.computeCollisions(model, data, geoms, found, q, False)
    pin.computeDistances(model, data, geoms, found, q)
    return hit, found.distanceResults[0].min_distance


def in_mujoco(height):
    model = mujoco.MjModel.from_xml_string(MESH, {"block.obj": OBJ.encode()})
    data = mujoco.MjData(model)
    data.qpos[0] = height
    mujoco.mj_forward(model, data)
    return min([c.dist for c in data.contact[: data.ncon]], default=0.0)


print("pin", pin.__version__, "mujoco", mujoco.__version__)
for height in [0.15, 0.11, 0.05, 0.0]:
    (mesh, clear), (box, _) = in_pin(MESH, height), in_pin(BOX, height)
    print(f"disc at {height:.2f} m: pin mesh {mesh}, {clear * 1e3:+.1f} mm; pin box {box};"
          f" MuJoCo {in_mujoco(height) * 1e3:+.1f} mm")
(outside, _), (cutting, _), (inside, clear) = in_pin(MESH, 0.15), in_pin(MESH, 0.11), in_pin(MESH, 0.0)
expect("above the block is free, at its surface is not", not outside and cutting)
expect("inside the mesh is free for pin, with 80 mm to spare", not inside and abs(clear - 0.08) < 1e-4)
expect("inside the box is not", in_pin(BOX, 0.0)[0])
expect("MuJoCo reports the disc deep inside", in_mujoco(0.0) < -0.1)
PY
