"""Frees the target of a scene, move by move: python -m cell SCENE.json"""

import asyncio
import json
import os
import sys
from pathlib import Path
from typing import Any

from .answers import Answer, Deadlock, NoSpace, Plan, Relocation, TimedOut, Unknown, read, read_replan
from .service import GaveUp, Refused, Service, Unreachable

ROUNDS = 100
DEFAULT_LIMIT_MS = 1000
LONGEST_LIMIT_MS = 60_000
"""The service's own limits, where its operator has not changed them."""
POSITION_TOLERANCE = 0.005
"""How far beside its place an object may be seen, m: the errors of this cell's robot and camera."""


def number(value: float) -> str:
    """Millimetres and milliradians; what rounds to zero has no sign."""
    return f"{value:z.3f}"


def time_limit_ms(scene: Any) -> int:
    """What the scene names. Whether it is in order, and a scene at all, is for the service to say."""
    settings = scene.get("settings") if isinstance(scene, dict) else None
    named = settings.get("time_limit_ms") if isinstance(settings, dict) else None
    return min(max(named, 0), LONGEST_LIMIT_MS) if isinstance(named, int) else DEFAULT_LIMIT_MS


def relocate(scene: dict[str, Any], move: Relocation) -> None:
    """Stands for the robot. A real one moves the object, looks at the table again, and makes its next scene of that."""
    moved = next((item for item in scene["objects"] if item["id"] == move.object), None)
    if moved is None:
        raise Unknown(f"no object '{move.object}' in the scene")
    places = f"from {number(move.start.x)} {number(move.start.y)} to {number(move.to.x)} {number(move.to.y)}"
    yaws = f"grasp at {number(move.grasp_yaw)}, release at {number(move.release_yaw)}"
    print(f"move {move.object} {places}, {yaws}", flush=True)
    moved["x"], moved["y"] = move.to.x, move.to.y


def report(words: str, ids: tuple[str, ...], what: str, status: int) -> int:
    print(f"{words}: {', '.join(ids)} {what}" if ids else words)
    return status


async def planned(service: Service, scene: dict[str, Any], limit: int) -> Answer:
    """What comes too late is asked for once more, with ten times the time."""
    answer = read(await service.plan(scene, limit))
    if isinstance(answer, TimedOut):
        longer = min(10 * limit, LONGEST_LIMIT_MS)
        patient = {**scene, "settings": {**scene.get("settings", {}), "time_limit_ms": longer}}
        answer = read(await service.plan(patient, longer))
    return answer


async def free(service: Service, scene: dict[str, Any]) -> int:
    """The exit status: 0 once the target is grasped."""
    limit = time_limit_ms(scene)
    answer = await planned(service, scene, limit)
    for _ in range(ROUNDS):
        match answer:
            case Plan(steps=(first, *_)) as plan:
                relocate(scene, first)
                rest = plan.rest()
                replan = read_replan(await service.verify(scene, rest.body, POSITION_TOLERANCE, limit))
                answer = await planned(service, scene, limit) if replan else rest
            case Plan(target=target, yaw=yaw):
                print(f"grasp {target} at {number(yaw)}")
                return 0
            case Deadlock(core):
                return report("deadlock", core, "hold each other", 3)
            case NoSpace(needed):
                return report("no space", needed, "would have to go", 4)
            case TimedOut(needed):
                return report("timed out", needed, "would have to go", 5)
    raise GaveUp(f"the target is not free after {ROUNDS} moves")


async def main(path: str) -> int:
    try:
        scene = json.loads(Path(path).read_text(encoding="utf-8"))
        url, key = os.environ.get("SINGULATE_URL", "http://127.0.0.1:8080"), os.environ.get("SINGULATE_KEY")
        async with Service(url, key) as service:
            return await free(service, scene)
    except Refused as refused:
        if refused.status == 422:
            for fault in refused.faults:
                print(f"{fault['code']} {fault['pointer']}: {fault['detail']}", file=sys.stderr)
            return 2
        print(refused, file=sys.stderr)
        return 6 if refused.status in (401, 403) else 1
    except GaveUp as reason:
        print(f"gave up: {reason}", file=sys.stderr)
    except (Unknown, Unreachable, OSError, ValueError) as error:
        print(error, file=sys.stderr)
    return 1


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("how to call it: python -m cell SCENE.json")
    sys.exit(asyncio.run(main(sys.argv[1])))
