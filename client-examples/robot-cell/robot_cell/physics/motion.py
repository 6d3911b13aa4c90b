"""Ways through the free angles of an arm: found by OMPL, made smooth, and timed by TOPP-RA."""

from collections.abc import Callable

import numpy as np
import toppra
import toppra.algorithm
import toppra.constraint
from ompl import base as ob
from ompl import geometric as og
from ompl import util as ou
from scipy.interpolate import CubicSpline

from .mechanism import NoPath

SEED = 1
"""Of OMPL's random numbers, set anew for each way, so that the same request gives the same way."""
CHECKS = 20_000
"""Of states until a way is given up. Clocks differ between runs, counts don't."""
STRIDE = 0.02
"""Between two checked states, rad: 25 mm at full stretch. A chord of that length is 1 mm inside a dish's edge."""
WEIGHTS = np.array([1.0, 1.0, 1.0, 0.3])
"""What a radian of each free angle counts in lengths of ways. The last only turns the hand in its place."""
ROUNDS = 6
"""How often the corners of a way are approached by more points until the curve through them is free."""

GRID = 200
"""Steps of TOPP-RA along a way."""

ou.setLogLevel(ou.LOG_WARN)

Free = Callable[[np.ndarray], bool]
"""Whether the arm is clear of everything at these free angles."""


def find(
    start: np.ndarray, goal: np.ndarray, low: np.ndarray, high: np.ndarray, free: Free, nearly_free: Free
) -> CubicSpline:
    """A smooth way by its length, from a free start to a free goal. Its corners are free, its roundings nearly."""
    direct = curve(np.array([start, goal]))
    if is_free(direct, free):
        return direct
    points = _corners(start, goal, low, high, free)
    for _ in range(ROUNDS):
        smooth = curve(points)
        if is_free(smooth, nearly_free):
            return smooth
        points = _halved(points)
    raise NoPath("no curve along the way is free")


def curve(points: np.ndarray) -> CubicSpline:
    lengths = np.linalg.norm(np.diff(points, axis=0) * WEIGHTS, axis=1)
    return CubicSpline(np.r_[0, np.cumsum(lengths)], points, bc_type="natural")


def is_free(way: CubicSpline, free: Free) -> bool:
    """Tested from the middle to both ends by ever smaller steps, since a way that is blocked should cost little."""
    count = 2 + int(way.x[-1] / STRIDE)
    lengths = np.linspace(0, way.x[-1], count)
    order = sorted(range(count), key=lambda i: (i & -i) or count, reverse=True)
    return all(free(way(lengths[i])) for i in order)


def _corners(start: np.ndarray, goal: np.ndarray, low: np.ndarray, high: np.ndarray, free: Free) -> np.ndarray:
    """The corners of a free way, shortened."""
    checks = 0

    def valid(state: ob.State) -> bool:
        nonlocal checks
        checks += 1
        return free(_angles(state))

    def spent() -> bool:
        return checks > CHECKS

    _seed()
    space = _space(low, high)
    setup = og.SimpleSetup(space)
    setup.setStateValidityChecker(valid)
    # By default OMPL checks each hundredth of the whole space's extent.
    setup.getSpaceInformation().setStateValidityCheckingResolution(STRIDE / space.getMaximumExtent())
    setup.setStartAndGoalStates(_state(space, start), _state(space, goal))
    setup.setPlanner(og.RRTConnect(setup.getSpaceInformation()))
    setup.solve(ob.PlannerTerminationCondition(spent))
    if not setup.haveExactSolutionPath():
        raise NoPath("no way was found")
    path = setup.getSolutionPath()
    og.PathSimplifier(setup.getSpaceInformation()).simplify(path, ob.PlannerTerminationCondition(spent))
    return np.array([_angles(path.getState(i)) for i in range(path.getStateCount())])


def _seed() -> None:
    """OMPL complains that this comes too late. What is made from here on follows the seed all the same."""
    level = ou.getLogLevel()
    ou.setLogLevel(ou.LOG_NONE)
    ou.RNG.setSeed(SEED)
    ou.setLogLevel(level)


def _space(low: np.ndarray, high: np.ndarray) -> ob.RealVectorStateSpace:
    bounds = ob.RealVectorBounds(len(WEIGHTS))
    for axis, (least, greatest) in enumerate(zip(low * WEIGHTS, high * WEIGHTS, strict=True)):
        bounds.setLow(axis, float(least))
        bounds.setHigh(axis, float(greatest))
    space = ob.RealVectorStateSpace(len(WEIGHTS))
    space.setBounds(bounds)
    return space


def _state(space: ob.RealVectorStateSpace, angles: np.ndarray) -> ob.State:
    state = space.allocState()
    for axis, value in enumerate(angles * WEIGHTS):
        state[axis] = float(value)
    return state


def _angles(state: ob.State) -> np.ndarray:
    return np.asarray([state[axis] / weight for axis, weight in enumerate(WEIGHTS)])


def _halved(points: np.ndarray) -> np.ndarray:
    """The same corners and the middles between them."""
    more = np.empty((2 * len(points) - 1, points.shape[1]))
    more[::2] = points
    more[1::2] = (points[1:] + points[:-1]) / 2
    return more


def timed(
    lengths: np.ndarray, points: np.ndarray, speed: np.ndarray, acceleration: np.ndarray, step: float
) -> np.ndarray:
    """The fastest motion through these points at these lengths of a way that keeps to the limits of each coordinate.
    Returns where it is at each step of the physics, from the start to a step at rest."""
    path = toppra.SplineInterpolator(lengths, points, bc_type="not-a-knot")
    limits = [
        toppra.constraint.JointVelocityConstraint(speed),
        toppra.constraint.JointAccelerationConstraint(acceleration),
    ]
    grid = np.linspace(0, lengths[-1], GRID)
    trajectory = toppra.algorithm.TOPPRA(
        limits, path, gridpoints=grid, parametrizer="ParametrizeConstAccel"
    ).compute_trajectory()
    if trajectory is None:
        raise NoPath("the way cannot be timed")
    times = np.arange(3 + int(trajectory.duration / step)) * step
    return np.asarray(trajectory(np.minimum(times, trajectory.duration)))
