"""The messages of the README's example, on a table whose top is 0.75 m up."""

from __future__ import annotations

from dataclasses import replace

from geometry_msgs.msg import Point, Pose, Quaternion, Vector3
from moveit_msgs.msg import CollisionObject, PlanningScene, PlanningSceneWorld
from shape_msgs.msg import Mesh, SolidPrimitive
from std_msgs.msg import Header
from vision_msgs.msg import BoundingBox3D, Detection3D, Detection3DArray, ObjectHypothesis, ObjectHypothesisWithPose

from singulate_ros.settings import Settings

HEADER = Header(frame_id="world")
SETTINGS = Settings(target="cup", fingers=3, finger_width=0.02, clearance=0.05, tool_z=0.92)
# The same cell with a tray for two plates.
DROPPING = replace(SETTINGS, drop_offs=["tray"], drop_off_capacities=[2], drop_off_classes=["plate bowl"], drop_z=1.0)


def pose(x: float, y: float, z: float, orientation: Quaternion | None = None) -> Pose:
    return Pose(position=Point(x=x, y=y, z=z), orientation=orientation or Quaternion())


def detection(name: str, kind: str, x: float, y: float, width: float, depth: float | None = None) -> Detection3D:
    """Something 0.1 m high that stands on the table; its size in x is the width."""
    size = Vector3(x=width, y=width if depth is None else depth, z=0.1)
    guesses = [ObjectHypothesis(class_id="thing", score=0.2), ObjectHypothesis(class_id=kind, score=0.7)]
    return Detection3D(
        results=[ObjectHypothesisWithPose(hypothesis=guess) for guess in guesses],
        bbox=BoundingBox3D(center=pose(x, y, 0.8), size=size),
        id=name,
    )


def solid(name: str, kind: int, dimensions: list[float], at: Pose) -> CollisionObject:
    primitive = SolidPrimitive(type=kind, dimensions=dimensions)
    return CollisionObject(header=HEADER, id=name, pose=at, primitives=[primitive], primitive_poses=[Pose()])


def mesh(name: str, vertices: list[tuple[float, float, float]], at: Pose) -> CollisionObject:
    surface = Mesh(vertices=[Point(x=x, y=y, z=z) for x, y, z in vertices])
    return CollisionObject(header=HEADER, id=name, pose=at, meshes=[surface], mesh_poses=[Pose()])


def no_warning(words: str) -> None:
    raise AssertionError(words)


def table(orientation: Quaternion | None = None) -> CollisionObject:
    return solid("table", SolidPrimitive.BOX, [0.8, 0.5, 0.05], pose(0.4, 0.25, 0.725, orientation))


def vase() -> CollisionObject:
    return solid("vase", SolidPrimitive.CYLINDER, [0.3, 0.05], pose(0.44, 0.16, 0.9))


def tray() -> CollisionObject:
    """Beside the table: a floor and a rim, so that the middle of both is not that of either."""
    floor = solid("tray", SolidPrimitive.BOX, [0.3, 0.2, 0.02], pose(1.2, 0.25, 0.5))
    rim = SolidPrimitive(type=SolidPrimitive.BOX, dimensions=[0.01, 0.2, 0.05])
    return replace(floor, primitives=[*floor.primitives, rim], primitive_poses=[Pose(), pose(0.1, 0.2, 0.0)])


def planning_scene(*objects: CollisionObject) -> PlanningScene:
    return PlanningScene(world=PlanningSceneWorld(collision_objects=list(objects)))


def detections(*more: Detection3D) -> Detection3DArray:
    seen = [
        detection("cup", "cup", 0.4, 0.25, 0.08),
        detection("plate-1", "plate", 0.5, 0.29, 0.12),
        detection("plate-2", "plate", 0.4, 0.36, 0.12),
        detection("plate-3", "plate", 0.31, 0.2, 0.12),
    ]
    return Detection3DArray(header=HEADER, detections=[*seen, *more])
