#!/usr/bin/env bash
# A URDF joint without lower and upper is locked in pin, free in MuJoCo, and None in yourdfpy.
#
# One would guess: the three read the same joint. In URDF, lower and upper default to 0, and effort and velocity
# are the attributes that must be there, so <limit effort="5" velocity="2"/> is valid.
#
# Seen with pin 4.1.0, mujoco 4.0.0, yourdfpy 0.0.60: for a revolute joint
#   pin       lowerPositionLimit 0, upperPositionLimit 0: the joint cannot move
#   MuJoCo    jnt_limited false: the joint turns without end
#   yourdfpy  lower None, upper None
# No message appears. A joint that is held with lower="0" upper="0" comes out the same way, but there MuJoCo
# warns that it ignores the limit.
#
# Why it matters: the planner samples one value for a joint that swings freely in the simulation. Locking a
# spare joint by its limits, as is usual for a tool changer or a parked axis, leaves it limp in MuJoCo.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check pin==4.1.0 mujoco-core==4.0.0 yourdfpy==0.0.60 numpy==2.4.6
venv/bin/python - <<'PY'
import sys
from pathlib import Path

import mujoco
import pinocchio as pin
import yourdfpy


def expect(claim, holds):
    print(("as recorded: " if holds else "CHANGED: ") + claim)
    if not holds:
        sys.exit(1)


URDF = """<robot name="cell"><link name="base"/>
  <link name="arm"><inertial><origin xyz=".2 0 0"/><mass value="1"/>
    <inertia ixx=".01" ixy="0" ixz="0" iyy=".01" iyz="0" izz=".01"/></inertial></link>
  <joint name="lift" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>{}</joint></robot>"""


def read(limit):
    text = URDF.format(limit)
    Path("cell.urdf").write_text(text)
    planned, simulated = pin.buildModelFromUrdf("cell.urdf"), mujoco.MjModel.from_xml_string(text)
    parsed = yourdfpy.URDF.load("cell.urdf", load_meshes=False).joint_map["lift"].limit
    data = mujoco.MjData(simulated)
    for _ in range(200):
        mujoco.mj_step(simulated, data)
    locked = float(planned.lowerPositionLimit[0]), float(planned.upperPositionLimit[0])
    return locked, bool(simulated.jnt_limited[0]), parsed, data.qpos[0]


print("pin", pin.__version__, "mujoco", mujoco.__version__)
for name, limit, kept in [("no lower and upper", '<limit effort="5" velocity="2"/>', (None, None)),
                          ("both zero", '<limit lower="0" upper="0" effort="5" velocity="2"/>', (0, 0))]:
    planned, limited, parsed, angle = read(limit)
    print(f"{name}: pin {planned}, MuJoCo limited {limited}, yourdfpy {parsed.lower, parsed.upper};"
          f" the arm turns by {angle:.2f} rad in 0.4 s")
    expect("pin locks the joint", planned == (0, 0))
    expect("MuJoCo leaves it without limit, and it falls", not limited and abs(angle) > 0.5)
    expect("yourdfpy keeps what is written", (parsed.lower, parsed.upper) == kept)
_, limited, _, angle = read('<limit lower="-0.1" upper="0.1" effort="5" velocity="2"/>')
expect("limits that differ are kept by MuJoCo", limited and abs(angle) < 0.2)
PY
