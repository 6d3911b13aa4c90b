#!/usr/bin/env bash
# The same URDF gives the joints in the order of the file in MuJoCo and yourdfpy, and by name in pin.
#
# One would guess: joint vectors of tools that read the same URDF can be exchanged. The order is that of the file.
#
# Seen with pin 4.1.0, mujoco 4.0.0, yourdfpy 0.0.60: a hand with the joints finger_2, finger_1, finger_10, in this
# order in the file. MuJoCo and yourdfpy keep the order. pin sorts the joints of one link by name:
# finger_1, finger_10, finger_2. All have three joints and the same limits, so a vector of the one is accepted by
# the other without a word. "Close the first finger by 20 mm" moves finger_2 in MuJoCo and finger_1 in pin: the
# tip that should move is off by 20 mm, and so is one that should not.
#
# Why it matters: inverse kinematics and collision checks often run in pin, the simulation in MuJoCo. A chain
# has one order, so an arm works. The k fingers of a gripper, or a second arm, are the first to be mixed up.
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
import numpy as np
import pinocchio as pin
import yourdfpy


def expect(claim, holds):
    print(("as recorded: " if holds else "CHANGED: ") + claim)
    if not holds:
        sys.exit(1)


INERTIAL = '<inertial><mass value=".1"/><inertia ixx="1e-4" ixy="0" ixz="0" iyy="1e-4" iyz="0" izz="1e-4"/></inertial>'
NAMES = ["finger_2", "finger_1", "finger_10"]
LINKS = "".join(f'<link name="pad{name[6:]}">{INERTIAL}</link>' for name in NAMES)
JOINTS = "".join(f"""
  <joint name="{name}" type="prismatic"><parent link="hand"/><child link="pad{name[6:]}"/>
    <origin rpy="0 0 {angle}"/><axis xyz="-1 0 0"/>
    <limit lower="0" upper="0.05" effort="10" velocity="1"/></joint>"""
  for name, angle in zip(NAMES, [0, 2.0944, 4.1888]))
URDF = f'<robot name="hand"><link name="hand"/>{LINKS}{JOINTS}</robot>'
Path("hand.urdf").write_text(URDF)

simulated, planned = mujoco.MjModel.from_xml_string(URDF), pin.buildModelFromUrdf("hand.urdf")
drawn = yourdfpy.URDF.load("hand.urdf", load_meshes=False)
in_mujoco = [simulated.joint(i).name for i in range(simulated.njnt)]
in_pin = list(planned.names)[1:]
print("pin", pin.__version__, "mujoco", mujoco.__version__)
print("MuJoCo", in_mujoco, "yourdfpy", list(drawn.actuated_joint_names), "pin", in_pin)
expect("MuJoCo and yourdfpy keep the order of the file", in_mujoco == NAMES == list(drawn.actuated_joint_names))
expect("pin sorts by name", in_pin == sorted(NAMES))

close_first = np.array([0.02, 0, 0])
data = mujoco.MjData(simulated)
data.qpos[:] = close_first
mujoco.mj_forward(simulated, data)
other = planned.createData()
pin.framesForwardKinematics(planned, other, close_first)
for name in NAMES:
    pad = "pad" + name[6:]
    apart = np.linalg.norm(data.body(pad).xpos - other.oMf[planned.getFrameId(pad)].translation)
    print(f"{pad}: {apart * 1e3:.1f} mm between MuJoCo and pin")
    expect(f"{pad} is where the order of joints puts it", np.isclose(apart, 0.0 if name == "finger_10" else 0.02))
PY
