"""Messages to a scene. Needs no ROS: any objects with the messages' fields will do.

All is in one frame, metres, z up. A message in another frame is refused; nothing is transformed.

The table is a collision object that is one box along the frame's axes. Its top counts. The other collision objects are
fixed, the detections can be moved. What stands beside the table or under its top is left out: the program that moves the arm has
to see to it. What leans over the table from beside it is refused, as are planes.

An object covers its shadow on the table, and is as high over the table as its top. A box is a rectangle with its yaw; one
that leans is the polygon of its corners. Cylinders and spheres are discs: a cylinder's is wider the further it leans. A mesh
is the convex hull of its vertices, and a warning says so. A detection is its bounding box. Those of the round classes are
upright cylinders inside their boxes: half the larger side, and more the further they lean.

A drop-off is a collision object too. It is an obstacle only where it stands on the table.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Callable, Iterator, Sequence, TypedDict

from singulate_ros.drop_offs import DropOff, configured, middle
from singulate_ros.failure import Failure
from singulate_ros.footprint import Footprint, Placement, Shape, box, cylinder, mesh, sphere
from singulate_ros.hull import Polygon, overlap
from singulate_ros.settings import Settings
from singulate_ros.wanted import Wanted, want

if TYPE_CHECKING:
    from geometry_msgs.msg import Pose
    from moveit_msgs.msg import CollisionObject, PlanningScene
    from shape_msgs.msg import SolidPrimitive
    from vision_msgs.msg import Detection3D, Detection3DArray

# shape_msgs/SolidPrimitive
BOX, SPHERE, CYLINDER = 1, 2, 3
# The table's sides may be off the frame's axes by as much, rad: half a millimetre on half a metre.
SQUARE_TOLERANCE = 1e-3
# What is no higher above the table's top than this, m, is the table's or under it: no finger meets it.
FLUSH = 1e-3
UNDERSTOOD = "boxes, cylinders, spheres and meshes are understood"


class Rectangle(TypedDict):
    x_min: float
    y_min: float
    x_max: float
    y_max: float


class Fingers(TypedDict):
    fingers: int
    finger_width: float
    clearance: float
    margin: float
    yaw_tolerance: float


class Gripper(Fingers, total=False):
    max_opening: float
    opening: str
    finger_length: float
    palm_radius: float
    tip_height: float


class Placed(TypedDict):
    id: str
    x: float
    y: float
    height: float
    fixed: bool


class Item(Placed, total=False):
    """A disc by its radius, all else by its shape, which is turned by yaw."""

    radius: float
    yaw: float
    shape: Shape


class TimeLimit(TypedDict):
    time_limit_ms: int


class Limits(TimeLimit, total=False):
    overlap_tolerance: float
    destination: str


class DropOffs(TypedDict, total=False):
    drop_offs: list[DropOff]


class Scene(Wanted, DropOffs):
    """The body of a planning request."""

    table: Rectangle
    gripper: Gripper
    objects: list[Item]
    settings: Limits


def to_scene(
    detections: Detection3DArray, planning_scene: PlanningScene, settings: Settings, warn: Callable[[str], object]
) -> Scene:
    """What is detected can be moved; the other collision objects are fixed. One that is both is taken as detected. `warn`
    is told what is planned as more than it is."""
    if planning_scene.is_diff:
        raise Failure("the planning scene is a diff; all of it is needed")
    _check_frame("the detections", detections.header.frame_id, settings)
    table, table_top = _table(planning_scene, settings)
    seen = list(_detected(detections, settings))
    detected = {name for name, _, _ in seen} | {settings.table}
    seen = [each for each in seen if _is_on(table, table_top, each[2], each[0])]
    found = [(name, footprint, False) for name, _, footprint in seen]
    for obstacle in planning_scene.world.collision_objects:
        if obstacle.id not in detected:
            solids = _solids(obstacle, settings)
            found += [(name, each, True) for name, each in solids if _is_on(table, table_top, each, name)]
    objects = [_item(name, footprint, footprint.top - table_top, fixed) for name, footprint, fixed in found]
    _check_ids(objects)
    for name, footprint, _ in found:
        if footprint.assumed:
            warn(f"'{name}' {footprint.assumed}")
    scene = Scene(table=table, gripper=_gripper(settings), objects=objects, settings=_limits(settings))
    want(scene, settings, {each["id"] for each in objects})
    if drop_offs := configured(settings):
        classes = {name: kind for name, kind, _ in seen}
        scene["drop_offs"] = [each.in_scene(classes) for each in drop_offs]
    return scene


def drop_places(planning_scene: PlanningScene, settings: Settings) -> dict[str, tuple[float, float]]:
    """Where each drop-off is."""
    places = {}
    for drop_off in configured(settings):
        obstacles = [each for each in planning_scene.world.collision_objects if each.id == drop_off.name]
        solids = [footprint for obstacle in obstacles for _, footprint in _solids(obstacle, settings)]
        places[drop_off.name] = middle(solids, drop_off.name)
    return places


def _item(name: str, footprint: Footprint, height: float, fixed: bool) -> Item:
    item = Item(id=name, x=footprint.x, y=footprint.y, height=height, fixed=fixed)
    if footprint.shape is None:
        item["radius"] = footprint.radius
    else:
        item["yaw"], item["shape"] = footprint.yaw, footprint.shape
    return item


def _gripper(settings: Settings) -> Gripper:
    gripper = Gripper(
        fingers=settings.fingers,
        finger_width=settings.finger_width,
        clearance=settings.clearance,
        margin=settings.margin,
        yaw_tolerance=settings.yaw_tolerance,
    )
    if not math.isnan(settings.max_opening):
        gripper["max_opening"] = settings.max_opening
    if settings.opening:
        gripper["opening"] = settings.opening
    if not math.isnan(settings.finger_length):
        gripper["finger_length"] = settings.finger_length
    if not math.isnan(settings.palm_radius):
        gripper["palm_radius"] = settings.palm_radius
    if not math.isnan(settings.tip_height):
        gripper["tip_height"] = settings.tip_height
    return gripper


def _limits(settings: Settings) -> Limits:
    limits = Limits(time_limit_ms=settings.time_limit_ms)
    if not math.isnan(settings.overlap_tolerance):
        limits["overlap_tolerance"] = settings.overlap_tolerance
    if settings.destination:
        limits["destination"] = settings.destination
    return limits


def _check_frame(whose: str, frame: str, settings: Settings) -> None:
    if frame != settings.frame:
        raise Failure(f"{whose}: frame '{frame}' is not the table's, '{settings.frame}'")


def _check_ids(objects: list[Item]) -> None:
    names = [each["id"] for each in objects]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise Failure(f"several objects have one id: {', '.join(twice)}")


def _table(planning_scene: PlanningScene, settings: Settings) -> tuple[Rectangle, float]:
    """The table's rectangle and the height of its top."""
    named = [each for each in planning_scene.world.collision_objects if each.id == settings.table]
    if len(named) != 1 or len(named[0].primitives) != 1 or named[0].primitives[0].type != BOX:
        raise Failure(f"the planning scene has no table '{settings.table}' that is one box")
    ((solid, placement),) = _placed(named[0], settings)
    length, width, height = _dimensions(solid, 3, settings.table)
    footprint = box(placement, (length, width, height), settings.table)
    along, across = abs(placement.rotation[0][0]), abs(placement.rotation[0][1])
    if min(max(along, across), abs(placement.rotation[2][2])) < math.cos(SQUARE_TOLERANCE):
        raise Failure(f"the sides of '{settings.table}' don't lie along the axes of '{settings.frame}'")
    x, y = (length / 2, width / 2) if along > across else (width / 2, length / 2)
    rectangle = Rectangle(
        x_min=footprint.x - x, y_min=footprint.y - y, x_max=footprint.x + x, y_max=footprint.y + y
    )
    return rectangle, footprint.top


def _detected(detections: Detection3DArray, settings: Settings) -> Iterator[tuple[str, str, Footprint]]:
    """Name, class and footprint of each."""
    for index, detection in enumerate(detections.detections):
        kind = _class(detection)
        # The index holds for one message only, and so does a name made of it.
        name = detection.id or f"{kind}-{index}"
        # Most detectors leave the frame to the array's header.
        _check_frame(name, detection.header.frame_id or detections.header.frame_id, settings)
        placement = Placement.of(detection.bbox.center, name)
        x, y, z = detection.bbox.size.x, detection.bbox.size.y, detection.bbox.size.z
        if kind in settings.round_classes:
            yield name, kind, cylinder(placement, max(x, y) / 2, z, name)
        else:
            yield name, kind, box(placement, (x, y, z), name)


def _class(detection: Detection3D) -> str:
    """The likeliest class; 'object' where there is none."""
    if not detection.results:
        return "object"
    return max((result.hypothesis for result in detection.results), key=lambda each: each.score).class_id


def _solids(obstacle: CollisionObject, settings: Settings) -> Iterator[tuple[str, Footprint]]:
    if obstacle.planes:
        raise Failure(f"'{obstacle.id}' has planes; {UNDERSTOOD}")
    solids, placements = _placed(obstacle, settings), _places(obstacle, obstacle.mesh_poses, len(obstacle.meshes))
    alone = len(solids) + len(placements) == 1
    for index, (solid, placement) in enumerate(solids):
        name = obstacle.id if alone else f"{obstacle.id}/{index}"
        if solid.type == BOX:
            length, width, height = _dimensions(solid, 3, name)
            yield name, box(placement, (length, width, height), name)
        elif solid.type == CYLINDER:
            height, radius = _dimensions(solid, 2, name)
            yield name, cylinder(placement, radius, height, name)
        elif solid.type == SPHERE:
            (radius,) = _dimensions(solid, 1, name)
            yield name, sphere(placement, radius, name)
        else:
            raise Failure(f"'{name}' is a solid of type {solid.type}; {UNDERSTOOD}")
    for index, (surface, placement) in enumerate(zip(obstacle.meshes, placements), len(solids)):
        name = obstacle.id if alone else f"{obstacle.id}/{index}"
        yield name, mesh(placement, ((vertex.x, vertex.y, vertex.z) for vertex in surface.vertices), name)


def _placed(obstacle: CollisionObject, settings: Settings) -> list[tuple[SolidPrimitive, Placement]]:
    """Its solids, each where it is."""
    _check_frame(obstacle.id, obstacle.header.frame_id, settings)
    return list(zip(obstacle.primitives, _places(obstacle, obstacle.primitive_poses, len(obstacle.primitives))))


def _places(obstacle: CollisionObject, poses: Sequence[Pose], count: int) -> list[Placement]:
    """Of its parts, whose poses are relative to its own."""
    if len(poses) != count:
        raise Failure(f"'{obstacle.id}' has not one pose for each solid")
    whole = Placement.of(obstacle.pose, obstacle.id)
    return [whole.then(Placement.of(pose, obstacle.id)) for pose in poses]


def _dimensions(solid: SolidPrimitive, count: int, whose: str) -> list[float]:
    if len(solid.dimensions) != count:
        raise Failure(f"'{whose}' has {len(solid.dimensions)} dimensions, not {count}")
    return list(solid.dimensions)


def _is_on(table: Rectangle, table_top: float, footprint: Footprint, name: str) -> bool:
    """False for what stands beside the table or under its top. What leans in from beside it fits no scene."""
    beyond_x = max(table["x_min"] - footprint.x, footprint.x - table["x_max"], 0.0)
    beyond_y = max(table["y_min"] - footprint.y, footprint.y - table["y_max"], 0.0)
    beyond = math.hypot(beyond_x, beyond_y)
    covers = overlap(footprint.corners, _corners(table)) if footprint.corners else beyond < footprint.radius
    if footprint.top <= table_top + FLUSH or not covers:
        return False
    if beyond > 0.0:
        raise Failure(f"'{name}' reaches over the table from beside it")
    return True


def _corners(table: Rectangle) -> Polygon:
    left, right, lower, upper = table["x_min"], table["x_max"], table["y_min"], table["y_max"]
    return [(left, lower), (right, lower), (right, upper), (left, upper)]
