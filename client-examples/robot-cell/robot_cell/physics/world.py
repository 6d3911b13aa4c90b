"""A scene of the service as a world of MuJoCo: the table, its dishes, a hand and what carries it."""

import math
from dataclasses import dataclass, field
from typing import Any

import mujoco
import numpy as np
import numpy.typing as npt

from . import drop_offs
from .centric_hand import PALM_ABOVE, CentricHand
from .hand import Hand
from .mechanism import Mechanism
from .robotiq import Robotiq

STEP = 0.002
"""Of the physics, s."""
HEIGHT = 0.08
"""Of a dish that says nothing about it, m."""
LENGTHS = 0.005, 0.5
"""Heights of dishes and lengths of fingers, m."""
DENSITY = 200.0
"""Of a dish, kg/m³: 0.28 kg for one of 150 mm. Dishes are hollow, these cylinders are not."""
DISH_FRICTION = 0.5
"""Of a dish on the table and on other dishes."""
TABLE_THICKNESS = 0.04
TABLE = "table"

Vector = npt.NDArray[np.float64]
Matrix = npt.NDArray[np.float64]
Scene = dict[str, Any]
"""The body of `POST /v1/plans`."""


@dataclass
class World:
    """The compiled world and where its parts are. Bodies and geoms of dishes have the ids of the scene."""

    scene: Scene
    model: mujoco.MjModel
    data: mujoco.MjData
    hand: Hand
    mechanism: Mechanism
    dishes: dict[str, int] = field(init=False)
    """Body of each dish on the table."""
    drop_offs: dict[str, tuple[float, float]] = field(init=False)
    """Where each drop-off is, m."""

    def __post_init__(self) -> None:
        self.dishes = {item["id"]: self.model.body(dish(item["id"])).id for item in self.scene["objects"]}
        self.drop_offs = drop_offs.places(self.scene)

    def place(self, name: str) -> Vector:
        """Where a dish stands: x, y, z of its centre's foot, m."""
        return np.array(self.data.xpos[self.dishes[name]])

    def stands(self) -> dict[str, Matrix]:
        """Of each dish the middle of its foot and of its top, m: an array of shape (2, 3)."""
        up = {item["id"]: height(item) for item in self.scene["objects"]}
        return {
            name: np.array([self.data.xpos[body], self.data.xpos[body] + up[name] * self.data.xmat[body][2::3]])
            for name, body in self.dishes.items()
        }

    def radius(self, name: str) -> float:
        return float(next(item["radius"] for item in self.scene["objects"] if item["id"] == name))

    def take_away(self, name: str, drop_off: str) -> None:
        """Takes a dish that stands at its drop-off out of the scene, and out of the way of the next one."""
        self.scene = drop_offs.without(self.scene, name, drop_off)
        del self.dishes[name]
        joint = self.data.joint(dish(name))
        joint.qpos[:] = drop_offs.FAR_AWAY * (1 + joint.id), 0, 0, 1, 0, 0, 0
        joint.qvel[:] = 0

    def open_round(self, radius: float) -> float:
        """The hand's opening before it grasps a dish of this radius, m."""
        gripper = self.scene["gripper"]
        greatest = float(gripper.get("max_opening", math.inf)) / 2
        return min(self.hand.open_for(opens_for(gripper, radius)), greatest)

    @property
    def tallest(self) -> float:
        return max(height(item) for item in self.scene["objects"])


def dish(name: str) -> str:
    """A dish's name in the model, apart from those of hand and table."""
    return f"dish:{name}"


def height(item: dict[str, Any]) -> float:
    return _length(item, "height", HEIGHT)


def _length(item: dict[str, Any], field: str, default: float) -> float:
    """A field for the physics alone. Raises ValueError."""
    least, greatest = LENGTHS
    value = item.get(field, default)
    if isinstance(value, bool) or not isinstance(value, int | float) or not least <= value <= greatest:
        raise ValueError(f"a {field} is {least:g} to {greatest:g} m, not {value!r}")
    return float(value)


def build(scene: Scene, mechanism: Mechanism) -> World:
    """The world with everything at rest, the hand open above the table."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    _set_options(spec)
    _light(spec, scene["table"])
    _add_table(spec, scene["table"])
    drop_offs.add_to(spec, scene)
    for item in scene["objects"]:
        _add_dish(spec, item)
    hand = hand_for(scene)
    mechanism.add_to(spec, hand)
    model = spec.compile()
    world = World(scene, model, mujoco.MjData(model), hand, mechanism)
    hand.bind(model)
    mechanism.bind(model)
    mechanism.home(world.data)
    mujoco.mj_forward(model, world.data)
    return world


def hand_for(scene: Scene) -> Hand:
    """The hand that the scene's gripper stands for: a 2F-85 for two fingers, else a centric one. Unless the gripper names a
    `finger_length` (m), the centric one's fingers are longer than the tallest dish is high."""
    gripper = scene["gripper"]
    tallest = max(height(item) for item in scene["objects"])
    if gripper["fingers"] == 2:
        return Robotiq(gripper, tallest)
    length = _length(gripper, "finger_length", tallest + PALM_ABOVE)
    radii = [item["radius"] for item in scene["objects"] if 2 * item["radius"] <= gripper.get("max_opening", math.inf)]
    reach = max((opens_for(gripper, radius) for radius in radii), default=0.0) + gripper["clearance"]
    return CentricHand(int(gripper["fingers"]), gripper["finger_width"], gripper["clearance"], length, reach)


def opens_for(gripper: dict[str, Any], radius: float) -> float:
    """The radius that the hand opens for, m: that of the dish, or always the greatest."""
    return gripper["max_opening"] / 2 if gripper.get("opening") == "full" else radius


def _set_options(spec: mujoco.MjSpec) -> None:
    option = spec.option
    option.timestep = STEP
    # implicitfast lets a held dish slide; the native collision detector invents depths where cylinders just touch.
    option.integrator = mujoco.mjtIntegrator.mjINT_EULER
    option.disableflags |= mujoco.mjtDisableBit.mjDSBL_NATIVECCD | mujoco.mjtDisableBit.mjDSBL_MULTICCD
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    # With 10, the usual advice, a light dish sinks in the fingers by millimetres in a carry of four seconds.
    option.impratio = 100


def _light(spec: mujoco.MjSpec, table: dict[str, float]) -> None:
    """For films."""
    spec.visual.headlight.ambient = [0.45, 0.45, 0.45]
    spec.visual.headlight.diffuse = [0.35, 0.35, 0.35]
    spec.add_texture(
        name="sky",
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_FLAT,
        rgb1=[0.97, 0.97, 0.98],
        rgb2=[0.97, 0.97, 0.98],
        width=8,
        height=8,
    )
    middle = (table["x_min"] + table["x_max"]) / 2, (table["y_min"] + table["y_max"]) / 2
    spec.worldbody.add_light(pos=[middle[0] - 0.6, middle[1] - 0.6, 2], dir=[0.3, 0.3, -1], diffuse=[0.5, 0.5, 0.5])


def _add_table(spec: mujoco.MjSpec, table: dict[str, float]) -> None:
    low, high = np.array([table["x_min"], table["y_min"]]), np.array([table["x_max"], table["y_max"]])
    middle, half = (high + low) / 2, (high - low) / 2
    # A dish on a box gets a single contact and topples, on a plane it gets three. A plane has no edge: the cell looks for
    # dishes beyond it.
    spec.worldbody.add_geom(
        name=TABLE,
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=[*half, 0.01],
        pos=[*middle, 0],
        friction=[DISH_FRICTION, 0.005, 0.0001],
        rgba=[0.85, 0.8, 0.72, 1],
    )
    spec.worldbody.add_geom(
        name="table board",
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=[*half, TABLE_THICKNESS / 2],
        pos=[*middle, -TABLE_THICKNESS / 2 - 0.001],
        contype=0,
        conaffinity=0,
        rgba=[0.7, 0.6, 0.5, 1],
    )


def _add_dish(spec: mujoco.MjSpec, item: dict[str, Any]) -> None:
    name, tall = dish(item["id"]), height(item)
    body = spec.worldbody.add_body(name=name, pos=[item["x"], item["y"], 0])
    if not item.get("fixed"):
        body.add_freejoint(name=name)
    body.add_geom(
        name=name,
        type=mujoco.mjtGeom.mjGEOM_CYLINDER,
        size=[item["radius"], tall / 2, 0],
        pos=[0, 0, tall / 2],
        density=DENSITY,
        condim=4,
        friction=[DISH_FRICTION, 0.005, 0.0001],
        rgba=[0.35, 0.35, 0.35, 1] if item.get("fixed") else [0.93, 0.93, 0.9, 1],
    )
