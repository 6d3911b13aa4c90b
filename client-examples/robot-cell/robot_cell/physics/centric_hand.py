"""A centric hand of our own: k pads that slide towards one axis, all by the same command."""

import math

import mujoco

PAD_THICKNESS = 0.008
"""Of a pad, from its inner to its outer face, m. Thinner where a scene's `clearance` leaves less room."""
PALM_ABOVE = 0.03
"""From the top of the tallest object to the palm while the fingertips are at the table, m."""
PALM_HEIGHT = 0.04
PALM_MASS = 1.0
SQUEEZE = 0.0008
"""How far inside the object's edge a closing pad is sent, m. With [`STIFFNESS`] it makes the grip."""
STIFFNESS = 2e4
"""Of a pad's drive, N/m."""
PAD_MASS = 0.05
PAD_ARMATURE = 0.25
DAMPING = 2 * math.sqrt(STIFFNESS * (PAD_MASS + PAD_ARMATURE))
"""Critical, N s/m. It is the drive's, not the joint's: Euler's method takes a joint's damping implicitly, after the contact
forces were computed without it, and a held dish slides by millimetres."""
PAD_FRICTION = 1.0
"""Rubber on a glazed dish."""
HARDNESS = [0.004, 1.0]
"""Of a pad's contacts: MuJoCo's time constant, s, and damping ratio. With the usual 0.02 s a pad swallows most of the squeeze,
and a dish drifts outwards by millimetres while an arm swings it round."""
BLUE, DARK, GLASS = [0.2, 0.45, 0.85, 1], [0.25, 0.27, 0.3, 1], [0.25, 0.27, 0.3, 0.35]


class CentricHand:
    """`length` is from the fingertips to the palm, `reach` from the axis to the outer faces of the pads that are open for
    the largest dish, m: as wide is the palm that they slide in."""

    def __init__(self, fingers: int, finger_width: float, clearance: float, length: float, reach: float) -> None:
        self.fingers = fingers
        self.length = length
        self.height = length + PALM_HEIGHT
        self._width, self._clearance, self._reach = finger_width, clearance, reach
        self.thickness = min(PAD_THICKNESS, clearance / 2)

    def open_for(self, radius: float) -> float:
        return radius + self._clearance - self.thickness

    def closed_on(self, radius: float) -> float:
        return radius - SQUEEZE

    def drop(self, _opening: float) -> float:
        return 0.0

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody, **pose: list[float]) -> None:
        hand = parent.add_body(name="hand", gravcomp=1, **pose)
        hand.add_geom(
            name="palm",
            type=mujoco.mjtGeom.mjGEOM_CYLINDER,
            size=[self._reach, PALM_HEIGHT / 2, 0],
            pos=[0, 0, self.length + PALM_HEIGHT / 2],
            mass=PALM_MASS,
            rgba=GLASS,
        )
        for finger in range(self.fingers):
            self._add_finger(spec, hand, finger)
        # The pads of one hand move together and never meet, whatever a small dish would have them do.
        for one in range(self.fingers):
            for other in range(one):
                spec.add_exclude(bodyname1=f"finger{one}", bodyname2=f"finger{other}")

    def _add_finger(self, spec: mujoco.MjSpec, hand: mujoco.MjsBody, finger: int) -> None:
        name, angle = f"finger{finger}", 2 * math.pi * finger / self.fingers
        body = hand.add_body(name=name, gravcomp=1, quat=[math.cos(angle / 2), 0, 0, math.sin(angle / 2)])
        body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[1, 0, 0], armature=PAD_ARMATURE)
        body.add_geom(
            name=name,
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=[self.thickness / 2, self._width / 2, self.length / 2],
            pos=[self.thickness / 2, 0, self.length / 2],
            mass=PAD_MASS,
            friction=[PAD_FRICTION, 0.005, 0.0001],
            condim=4,
            solref=HARDNESS,
            # Otherwise the dish's hardness is averaged in.
            priority=1,
            rgba=BLUE,
        )
        _add_rail(body, self.length)
        drive = spec.add_actuator(name=name, target=name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        drive.set_to_position(kp=STIFFNESS, kv=DAMPING)

    def bind(self, model: mujoco.MjModel) -> None:
        self._drives = [model.actuator(f"finger{finger}").id for finger in range(self.fingers)]

    def command(self, data: mujoco.MjData, opening: float) -> None:
        data.ctrl[self._drives] = opening


def _add_rail(finger: mujoco.MjsBody, height: float) -> None:
    """Joins the pad to the palm in films. It touches nothing."""
    finger.add_geom(
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=[0.06, 0.006, 0.006],
        pos=[-0.05, 0, height + 0.01],
        mass=0,
        contype=0,
        conaffinity=0,
        rgba=DARK,
    )
