#!/usr/bin/env bash
# Two upright cylinders that only just touch are reported tens of millimetres deep in each other.
#
# One would guess: cylinders of different heights stand side by side and overlap by a tenth of a
# nanometre or less. The contact is that deep, and its normal is horizontal.
#
# Seen with mujoco 4.0.0 (4.0.1 gives the same figures), default options:
# * Overlaps from 1e-12 m to 1e-10 m: 213 of 300 pairs get one contact with a vertical normal. Its depth is the
#   height of the shorter cylinder, 20 mm and more.
# * The side face of a box (a finger pad) against a cylinder, overlaps from 1e-12 m to 1e-8 m: 221 of 300
#   normals are off by 8 degrees or more, the worst by 63.
# * Two discs at rest that overlap by 1e-11 m start to turn at 0.84 rad/s.
# With <flag nativeccd="disable"/> none of this happens.
#
# Why it matters: a planner that packs discs edge to edge, or solves for the touching pose, lands in this range.
# The simulation of its plan then kicks discs that only touch, and a check "depth below 1 mm" calls a good
# placement a collision.
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


def contacts(bodies, native):
    model = mujoco.MjModel.from_xml_string(f"""
        <mujoco><compiler angle="radian"/><option><flag nativeccd="{native}"/></option>
        <worldbody>{"".join(bodies)}</worldbody></mujoco>""")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return [(float(c.dist), c.frame[:3].copy()) for c in data.contact[: data.ncon]]


def body(x, y, z, geom):
    return f'<body pos="{float(x)!r} {float(y)!r} {float(z)!r}"><freejoint/><geom {geom}/></body>'


def cylinder(x, y, radius, half_height):
    return body(x, y, half_height, f'type="cylinder" size="{float(radius)!r} {float(half_height)!r}"')


def phantom_depths(native):
    random = np.random.default_rng(1)
    depths = []
    for overlap in [1e-12, 1e-11, 1e-10]:
        for _ in range(100):
            angle, x, y = random.uniform(0, 6.28), *random.uniform(-0.5, 0.5, 2)
            radius = random.uniform(0.02, 0.08, 2)
            low, high = random.uniform(0.01, 0.04), random.uniform(0.05, 0.1)
            apart = radius.sum() - overlap
            pair = [cylinder(x, y, radius[0], high),
                    cylinder(x + apart * np.cos(angle), y + apart * np.sin(angle), radius[1], low)]
            depths += [max([-dist for dist, _ in contacts(pair, native)], default=0.0)]
    return np.array(depths)


def normal_errors(native):
    random = np.random.default_rng(2)
    errors = []
    for overlap in [1e-12, 1e-11, 1e-10, 1e-9, 1e-8]:
        for _ in range(60):
            angle, x, y = random.uniform(0, 6.28), *random.uniform(-0.5, 0.5, 2)
            radius, half_width = random.uniform(0.02, 0.08), random.uniform(0.005, 0.02)
            along, across = radius + 0.01 - overlap, random.uniform(-0.9, 0.9) * half_width
            normal = np.array([np.cos(angle), np.sin(angle), 0.0])
            side = np.array([-normal[1], normal[0], 0.0])
            centre = np.array([x, y, 0.0]) + along * normal + across * side
            pair = [body(x, y, 0.035, f'type="box" size="0.01 {half_width} 0.01" euler="0 0 {angle}"'),
                    cylinder(centre[0], centre[1], radius, 0.05)]
            found = contacts(pair, native)
            if found:
                errors += [max(np.degrees(np.arccos(min(1.0, abs(n @ normal)))) for _, n in found)]
    return np.array(errors)


def settle(native):
    apart, angle = 0.1 - 1e-11, 0.3
    model = mujoco.MjModel.from_xml_string(f"""
        <mujoco><option><flag nativeccd="{native}"/></option><worldbody><geom type="plane" size="1 1 .1"/>
        {cylinder(0, 0, 0.04, 0.05)}{cylinder(apart * np.cos(angle), apart * np.sin(angle), 0.06, 0.03)}
        </worldbody></mujoco>""")
    data = mujoco.MjData(model)
    fastest = 0.0
    for _ in range(500):
        mujoco.mj_step(model, data)
        fastest = max(fastest, abs(data.qvel[[3, 4, 5, 9, 10, 11]]).max())
    return fastest


print("mujoco", mujoco.__version__)
on, off = phantom_depths("enable"), phantom_depths("disable")
print(f"cylinder pairs: {len(on)}, deeper than 10 mm: {(on > 0.01).sum()} by default,"
      f" {(off > 0.01).sum()} without nativeccd; deepest {on.max() * 1e3:.1f} mm")
expect("most cylinders that touch get a contact deeper than 10 mm", (on > 0.01).mean() > 0.6)
expect("none does without nativeccd", off.max() < 1e-6)

on, off = normal_errors("enable"), normal_errors("disable")
print(f"box faces on cylinders: {len(on)}, normal off by 8 degrees or more: {(on > 8).sum()} by default,"
      f" {(off > 8).sum()} of {len(off)} without nativeccd; worst {on.max():.0f} degrees")
expect("more than a third of the normals are wrong", (on > 8).mean() > 0.35)
expect("none is without nativeccd", len(off) > 0 and off.max() < 8)

on, off = settle("enable"), settle("disable")
print(f"two discs at rest for 1 s turn at up to {on:.3f} rad/s by default, {off:.3f} rad/s without nativeccd")
expect("discs that only touch are set turning", on > 0.3)
expect("they are not without nativeccd", off < 0.03)
PY
