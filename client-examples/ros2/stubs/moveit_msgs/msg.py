from dataclasses import dataclass, field

from geometry_msgs.msg import Pose
from shape_msgs.msg import Mesh, Plane, SolidPrimitive
from std_msgs.msg import Header


@dataclass
class CollisionObject:
    header: Header = field(default_factory=Header)
    pose: Pose = field(default_factory=Pose)
    id: str = ""
    primitives: list[SolidPrimitive] = field(default_factory=list)
    primitive_poses: list[Pose] = field(default_factory=list)
    meshes: list[Mesh] = field(default_factory=list)
    mesh_poses: list[Pose] = field(default_factory=list)
    planes: list[Plane] = field(default_factory=list)


@dataclass
class PlanningSceneWorld:
    collision_objects: list[CollisionObject] = field(default_factory=list)


@dataclass
class PlanningScene:
    world: PlanningSceneWorld = field(default_factory=PlanningSceneWorld)
    is_diff: bool = False


@dataclass
class PlanningSceneComponents:
    WORLD_OBJECT_GEOMETRY = 16

    components: int = 0
