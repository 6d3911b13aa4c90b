#!/usr/bin/env bash
# In OMPL, the same motion of one joint is refused in a space of two joints and accepted in one of three.
#
# One would guess: a motion of the first joint alone is checked at the same states, however many joints the robot
# has and whatever their limits are.
#
# Seen with ompl 2.0.1, default settings: the distance between checked states is 1 % of the extent of the whole
# space, and the extent of n joints at +-pi is 2 pi sqrt(n). An arm of 0.85 m sweeps by 0.5 rad through a post that
# is 60 mm wide:
#   1 joint    step 0.063 rad   refused        3 joints   step 0.109 rad   accepted
#   2 joints   step 0.089 rad   refused        6 joints   step 0.154 rad   accepted
# The bounds of an axis that does not move count too: one joint and a rail of +-1 m refuse the sweep, with a rail
# of +-6 m it is accepted.
#
# Why it matters: settings that were tested on a small arm or a short rail let a larger one through its fixtures.
# Six joints are checked every 131 mm at the tip. setStateValidityCheckingResolution has to be set from the reach
# of the arm and the extent of its space.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check ompl==2.0.1 numpy==2.4.6
venv/bin/python - <<'PY' 2>"$work/stderr" || { cat "$work/stderr"; exit 1; }
import math
import sys
from importlib.metadata import version

import ompl.base as ob


def expect(claim, holds):
    print(("as recorded: " if holds else "CHANGED: ") + claim)
    if not holds:
        sys.exit(1)


REACH, POST, WIDTH = 0.85, 0.1625, 0.06


def sweep(bounds):
    """Whether the first joint may sweep by 0.5 rad, and the distance of the states that are checked."""
    space, limits = ob.RealVectorStateSpace(len(bounds)), ob.RealVectorBounds(len(bounds))
    for i, bound in enumerate(bounds):
        limits.setLow(i, -bound)
        limits.setHigh(i, bound)
    space.setBounds(limits)
    cell = ob.SpaceInformation(space)
    cell.setStateValidityChecker(lambda state: abs(REACH * math.sin(state[0] - POST)) > WIDTH / 2)
    cell.setup()
    start, goal = space.allocState(), space.allocState()
    for i in range(len(bounds)):
        start[i] = goal[i] = 0.0
    goal[0] = 0.5
    return bool(cell.checkMotion(start, goal)), space.getLongestValidSegmentLength()


print("ompl", version("ompl"))
for joints in [1, 2, 3, 4, 6, 7]:
    accepted, step = sweep([math.pi] * joints)
    print(f"{joints} joints: step {step:.3f} rad, {step * REACH * 1e3:.0f} mm at the tip, accepted {accepted}")
    expect("refused by one and two joints, accepted by more", accepted == (joints > 2))
for rail in [1.0, 6.0]:
    accepted, step = sweep([math.pi, rail])
    print(f"rail of +-{rail:.0f} m that does not move: step {step:.3f}, accepted {accepted}")
    expect("the bounds of an idle rail decide", accepted == (rail > 5))
PY
