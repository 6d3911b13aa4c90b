"""Reaches the goal of a scene, step by step: python -m cell SCENE.json"""

import asyncio
import json
import os
import sys
from pathlib import Path

from .answers import (
    AllAway,
    Answer,
    Cleared,
    Deadlock,
    End,
    Grasp,
    Grip,
    NoSpace,
    PartlyCleared,
    Plan,
    Pose,
    Relocation,
    Removal,
    Step,
    TimedOut,
    Unknown,
    read,
    read_replan,
)
from .scene import LONGEST_LIMIT_MS, Scene, put, take_away, time_limit_ms
from .service import GaveUp, Refused, Service, Unreachable

ROUNDS = 100
POSITION_TOLERANCE = 0.005
"""How far beside its place an object may be seen, m: the errors of this cell's robot and camera."""


def number(value: float) -> str:
    """Millimetres and milliradians; what rounds to zero has no sign."""
    return f"{value:z.3f}"


def at(place: Pose | Grip) -> str:
    parts = (place.x, place.y, place.yaw)
    return " ".join(number(part) for part in parts if part is not None)


def carry_out(scene: Scene, step: Step) -> None:
    """Stands for the robot. A real one moves the object, looks at the table again, and makes its next scene of that."""
    match step:
        case Relocation(name, start, to, grasp, release, turn):
            put(scene, name, to)
            turned = f", turned by {number(turn)}" if turn is not None else ""
            way = f"from {at(start)} to {at(to)}{turned}"
            print(f"move {name} {way}, grasp at {at(grasp)}, release at {at(release)}", flush=True)
        case Removal(name, start, grasp, drop_off):
            take_away(scene, name, drop_off)
            print(f"take {name} from {at(start)} away to {drop_off}, grasp at {at(grasp)}", flush=True)


def finish(end: End) -> int:
    """The exit status: 0 if the goal is reached."""
    match end:
        case Grasp(target, grip):
            print(f"grasp {target} at {at(grip)}")
            return 0
        case AllAway():
            print("all taken away")
            return 0
        case Cleared():
            print("cleared")
            return 0
        case PartlyCleared(left, stuck, proven):
            if stuck:
                report("stuck", stuck, "hold each other", 7)
            return report("partly cleared", left, "left" if proven else "left, as far as is known", 7)


def report(words: str, ids: tuple[str, ...], what: str, status: int) -> int:
    print(f"{words}: {', '.join(ids)} {what}" if ids else words)
    return status


async def planned(service: Service, scene: Scene, limit: int) -> Answer:
    """What comes too late is asked for once more, with ten times the time."""
    answer = read(await service.plan(scene, limit))
    if isinstance(answer, TimedOut):
        longer = min(10 * limit, LONGEST_LIMIT_MS)
        patient = {**scene, "settings": {**scene.get("settings", {}), "time_limit_ms": longer}}
        answer = read(await service.plan(patient, longer))
    return answer


async def reach(service: Service, scene: Scene) -> int:
    """The exit status: 0 once the goal is reached."""
    limit = time_limit_ms(scene)
    answer = await planned(service, scene, limit)
    for _ in range(ROUNDS):
        match answer:
            case Plan(steps=(first, *_)) as plan:
                carry_out(scene, first)
                answer = plan.rest()
                if not answer.is_done:
                    verification = await service.verify(scene, answer.body, POSITION_TOLERANCE, limit)
                    answer = await planned(service, scene, limit) if read_replan(verification) else answer
            case Plan(end=end):
                return finish(end)
            case Deadlock(core):
                return report("deadlock", core, "hold each other", 3)
            case NoSpace(needed):
                return report("no space", needed, "would have to go", 4)
            case TimedOut(needed):
                return report("timed out", needed, "would have to go", 5)
    raise GaveUp(f"the goal is not reached after {ROUNDS} moves")


async def main(path: str) -> int:
    try:
        scene = json.loads(Path(path).read_text(encoding="utf-8"))
        url, key = os.environ.get("SINGULATE_URL", "http://127.0.0.1:8080"), os.environ.get("SINGULATE_KEY")
        async with Service(url, key) as service:
            return await reach(service, scene)
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
