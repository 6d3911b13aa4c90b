"""The table as the client knows it, in the words of the request."""

from typing import Any

from .answers import Pose, Unknown

DEFAULT_LIMIT_MS = 1000
LONGEST_LIMIT_MS = 60_000
"""The service's own limits, where its operator has not changed them."""

Scene = dict[str, Any]


def time_limit_ms(scene: Any) -> int:
    """What the scene names. Whether it is in order, and a scene at all, is for the service to say."""
    settings = scene.get("settings") if isinstance(scene, dict) else None
    named = settings.get("time_limit_ms") if isinstance(settings, dict) else None
    return min(max(named, 0), LONGEST_LIMIT_MS) if isinstance(named, int) else DEFAULT_LIMIT_MS


def put(scene: Scene, name: str, to: Pose) -> None:
    """Puts an object elsewhere."""
    item = _find(scene["objects"], "object", name)
    item["x"], item["y"] = to.x, to.y
    if to.yaw is not None:
        item["yaw"] = to.yaw


def take_away(scene: Scene, name: str, to: str) -> None:
    """Takes an object away to a drop-off. One that is then full is left out, and what is away is no longer wanted away."""
    item = _find(scene["objects"], "object", name)
    drop_off = _find(scene.get("drop_offs", []), "drop-off", to)
    scene["objects"].remove(item)
    if "capacity" in drop_off:
        drop_off["capacity"] -= 1
        if drop_off["capacity"] == 0:
            scene["drop_offs"].remove(drop_off)
    wanted = scene.get("goal", {}).get("all_of", [])
    if name in wanted:
        wanted.remove(name)


def _find(items: list[Any], what: str, name: str) -> dict[str, Any]:
    found: dict[str, Any] | None = next((item for item in items if item["id"] == name), None)
    if found is None:
        raise Unknown(f"no {what} '{name}' in the scene")
    return found
