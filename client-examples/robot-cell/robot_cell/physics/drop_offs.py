"""Drop-offs: places beside the table, as high as its top, where a dish is set down and then taken out of the world."""

from typing import Any

import mujoco

GAP = 0.05
"""From the hand that sets a dish down to what hangs over the table's edge, m."""
FAR_AWAY = 10.0
"""Between dishes that were taken out of the world, and from them to the table, m."""
THICKNESS = 0.01
GREY = [0.75, 0.77, 0.8, 1]


def places(scene: dict[str, Any]) -> dict[str, tuple[float, float]]:
    """The middle of each drop-off, m: in turn on the right and on the left of the table, from the lower side upwards."""
    table, room = scene["table"], _room(scene)
    overhang = max(item["radius"] for item in scene["objects"])
    found = {}
    for at, drop_off in enumerate(scene.get("drop_offs", [])):
        beside = overhang + GAP + room
        x = table["x_min"] - beside if at % 2 else table["x_max"] + beside
        found[drop_off["id"]] = (x, table["y_min"] + (2 * (at // 2) + 1) * room)
    return found


def without(scene: dict[str, Any], name: str, to: str) -> dict[str, Any]:
    """The scene after a dish was taken away. A drop-off that is then full is left out, and what is away is no longer wanted
    away."""
    drop_offs = []
    for drop_off in scene["drop_offs"]:
        if drop_off["id"] == to and "capacity" in drop_off:
            if drop_off["capacity"] > 1:
                drop_offs.append({**drop_off, "capacity": drop_off["capacity"] - 1})
        else:
            drop_offs.append(drop_off)
    objects = [item for item in scene["objects"] if item["id"] != name]
    left = {**scene, "objects": objects, "drop_offs": drop_offs}
    if wanted := scene.get("goal", {}).get("all_of"):
        left["goal"] = {"all_of": [each for each in wanted if each != name]}
    return left


def add_to(spec: mujoco.MjSpec, scene: dict[str, Any]) -> None:
    """Draws them. A dish stands there on the table's plane, which has no edge."""
    for name, (x, y) in places(scene).items():
        spec.worldbody.add_geom(
            name=f"drop-off:{name}",
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=[_room(scene) * 0.9, _room(scene) * 0.9, THICKNESS / 2],
            pos=[x, y, -THICKNESS / 2 - 0.001],
            contype=0,
            conaffinity=0,
            rgba=GREY,
        )


def _room(scene: dict[str, Any]) -> float:
    """Half of a drop-off's side, m: the widest dish with the hand open round it."""
    return float(max(item["radius"] for item in scene["objects"]) + scene["gripper"]["clearance"])
