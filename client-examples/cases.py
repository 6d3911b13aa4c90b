"""What every client example must do, case by case."""

import json
import socket
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from faults import VERIFY, Canned, CutOff, Drip, Pass, Proxy, Request, Reset, Step

SCENES = Path(__file__).parent / "scenes"
INVALID = SCENES / "invalid.json"
WRONG_KEY = "sgl_" + 43 * "x"
STATISTICS = {"knowledge_ms": 0.0, "search_ms": 0.0, "placement_ms": 0.0, "check_ms": 0.0}
STEP = {
    "action": "pick_place",
    "object": "plate-2",
    "from": {"x": 0.31, "y": 0.2},
    "to": {"x": 0.0627, "y": -0.0001},
    "grasp": {"x": 0.31, "y": 0.2, "yaw": 1.25, "slack": 0.1},
    "release": {"x": 0.0627, "y": -0.0001, "yaw": -0.0004, "slack": 0.1},
    "gap": 0.1,
}
TURN = {
    **STEP,
    "from": {"x": 0.31, "y": 0.2, "yaw": 0.3},
    "to": {"x": 0.1, "y": 0.4, "yaw": 1.8},
    "grasp": {"x": 0.33, "y": 0.21, "yaw": 1.25, "slack": 0.05},
    "release": {"x": 0.0931, "y": 0.4214, "yaw": 2.75, "slack": 0.05},
    "turn": 1.5,
}
"""Of something that is held beside its middle, and turned on the way."""
DROP = {
    "action": "pick_drop",
    "object": "plate-2",
    "from": {"x": 0.31, "y": 0.2},
    "grasp": {"x": 0.31, "y": 0.2, "yaw": 1.25, "slack": 0.1},
    "drop_off": "tray",
}
ALSO = {**DROP, "object": "plate-1", "from": {"x": 0.5, "y": 0.29, "yaw": -0.7}}
TARGET_GRASP = {"x": 0.4, "y": 0.25, "yaw": 0.5, "slack": 0.1}
GO_ON = Canned(200, {"valid": True, "faults": [], "first_failing_step": None, "replan": False})
PLAN_AGAIN = Canned(200, {"valid": False, "faults": [], "first_failing_step": 0, "replan": True})
MOVE = "move plate-2 from 0.310 0.200 to 0.063 0.000, grasp at 0.310 0.200 1.250, release at 0.063 0.000 0.000\n"
TURNED = "move plate-2 from 0.310 0.200 0.300 to 0.100 0.400 1.800, turned by 1.500, "
TURNED += "grasp at 0.330 0.210 1.250, release at 0.093 0.421 2.750\n"
TAKE = "take plate-2 from 0.310 0.200 away to tray, grasp at 0.310 0.200 1.250\n"
ALSO_TAKE = TAKE.replace("plate-2 from 0.310 0.200", "plate-1 from 0.500 0.290 -0.700")
GRASP = "grasp cup at 0.400 0.250 0.500\n"


@dataclass(frozen=True)
class Case:
    name: str
    scene: Path
    stdout: str
    status: int
    stderr: str = ""
    """Must be part of what the client says."""
    server: Callable[[], AbstractContextManager[Any]] = nullcontext
    """Where it is asked: a proxy, or an address; nothing means the service itself."""
    key: str | None = None
    """Another key than the right one."""
    check: Callable[[list[Request]], str | None] = lambda _: None
    """What is wrong with the requests, if anything."""


def answer(verdict: str, **parts: Any) -> Canned:
    nothing = ("scene_id", "target_grasp", "cost", "lower_bound", "optimal", "landmarks", "deadlock", "needed")
    whole = {"verdict": verdict, "target": "cup", "relocations": [], "warnings": [], "statistics": STATISTICS}
    return Canned(200, {**whole, **dict.fromkeys(nothing), **parts})


def problem(status: int, kind: str, title: str, **headers: str) -> Canned:
    body = {"type": f"urn:singulate:problem:{kind}", "title": title, "status": status, "detail": title, "errors": []}
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    return Canned(status, body, {"content-type": "application/problem+json", **named})


def scene_cases(refusal: Any) -> Iterator[Case]:
    """Every scene against the service itself, which refuses one of them."""
    faults = "".join(f"{fault['code']} {fault['pointer']}: {fault['detail']}\n" for fault in refusal["errors"])
    for path in sorted(SCENES.glob("*.json")):
        *lines, end = (SCENES / "expected" / f"{path.stem}.txt").read_text().splitlines(keepends=True)
        status = int(end.removeprefix("exit "))
        yield Case(path.stem, path, "".join(lines), status, faults if path == INVALID else "")


def wrong_key_case(refusal: Any) -> Case:
    return Case("wrong key", SCENES / "one-move.json", "", 6, refusal["title"], key=WRONG_KEY)


@contextmanager
def nobody() -> Iterator[str]:
    """An address where nobody listens, and nobody else can."""
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        yield f"http://127.0.0.1:{taken.getsockname()[1]}"


def fault_cases(upstream: tuple[str, int], folder: Path) -> Iterator[Case]:
    one_move = SCENES / "one-move.json"

    def proxy(*steps: Step, then: Step | None = None, verified: Step | None = None) -> Callable[[], Proxy]:
        return lambda: Proxy(list(steps), then or Pass(), verified or Pass(), upstream)

    def write(name: str, scene: Any) -> Path:
        path = folder / f"{name}.json"
        path.write_text(json.dumps(scene))
        return path

    def scene(name: str, **settings: Any) -> Path:
        return write(name, {**json.loads(one_move.read_text()), "settings": settings})

    def dropping(name: str, **goal: Any) -> Path:
        """The same table with a tray for two objects and a bin for any number."""
        drop_offs = [{"id": "tray", "capacity": 2}, {"id": "bin"}]
        table = json.loads(one_move.read_text())
        del table["target"]
        return write(name, {**table, "drop_offs": drop_offs, "goal": goal})

    *lines, _ = (SCENES / "expected" / "one-move.txt").read_text().splitlines(keepends=True)
    moved = "".join(lines)
    busy = problem(503, "overloaded", "Too busy", retry_after="1")
    hasty = problem(429, "rate_exceeded", "Too many requests", retry_after="1")
    free = answer("graspable", target_grasp=TARGET_GRASP)

    four = (Reset(), busy, hasty, CutOff())
    yield Case("four faults", one_move, moved, 0, server=proxy(*four), check=four_faults(0))
    yield Case("four faults of a verification", one_move, moved, 0, server=proxy(Pass(), *four), check=four_faults(1))
    yield Case("nobody there", one_move, "", 1, "gave up: ", server=nobody)
    silent = problem(503, "overloaded", "Too busy")
    yield Case("always busy", one_move, "", 1, "gave up: Too busy", proxy(then=silent), check=patiently(4, 5))
    slow = scene("slow", time_limit_ms=1)
    yield Case("dripping", slow, GRASP, 0, server=proxy(Drip(), then=free), check=counted(2))
    strange = answer("push_aside", relocations=[STEP], target_grasp=TARGET_GRASP)
    yield Case("unknown verdict", one_move, "", 1, "push_aside", proxy(then=strange), check=counted(1))
    pushed = answer("relocate", relocations=[{**STEP, "action": "push"}], target_grasp=TARGET_GRASP)
    yield Case("unknown action", one_move, "", 1, "push", proxy(then=pushed), check=counted(1))
    ghost = answer("relocate", relocations=[{**STEP, "object": "ghost"}], target_grasp=TARGET_GRASP)
    yield Case("unknown object", one_move, "", 1, "ghost", proxy(then=ghost), check=counted(1))
    torn = Canned(200, {"verdict": "graspable", "target": "cup"})
    yield Case("torn answer", one_move, "", 1, server=proxy(then=torn), check=counted(1))
    forbidden = problem(403, "forbidden", "Not with this key")
    yield Case("forbidden", one_move, "", 6, "Not with this key", proxy(then=forbidden), check=counted(1))
    broken = problem(500, "internal", "A fault of ours")
    yield Case("fault of ours", one_move, "", 1, "A fault of ours", proxy(then=broken), check=counted(1))
    between = proxy(*(Canned(status, "<html>") for status in (502, 504, 408)))
    yield Case("a proxy between", one_move, moved, 0, server=between, check=patiently(3, 5))
    elsewhere = Canned(307, "", {"location": "/elsewhere"})
    yield Case("redirected", one_move, "", 1, "307", proxy(then=elsewhere), check=counted(1))
    slash = f"http://{upstream[0]}:{upstream[1]}/"
    yield Case("slash at the end", one_move, moved, 0, server=lambda: nullcontext(slash))
    endless_limit = scene("endless-limit", time_limit_ms=1e19)
    yield Case("a limit beyond all", endless_limit, "", 2, "/settings/time_limit_ms")
    none = write("list", [])
    yield Case("a list for a scene", none, "", 2, "wrong_type")
    late = answer("timed_out", needed=["a", "b"])
    told = "timed out: a, b would have to go\n"
    yield Case("timed out", one_move, told, 5, server=proxy(then=late), check=limits(None, 10_000))
    patient, unknown = scene("patient", time_limit_ms=20_000), answer("timed_out")
    capped = limits(20_000, 60_000)
    yield Case("timed out, nothing known", patient, "timed out\n", 5, server=proxy(then=unknown), check=capped)
    twice = proxy(late, free)
    yield Case("in time at last", one_move, GRASP, 0, server=twice, check=limits(None, 10_000))
    endless = proxy(then=answer("relocate", relocations=[STEP], target_grasp=TARGET_GRASP), verified=PLAN_AGAIN)
    yield Case("a hundred rounds", one_move, 100 * MOVE, 1, server=endless, check=hundred_rounds)
    step = answer("relocate", relocations=[STEP], target_grasp=TARGET_GRASP)
    again = proxy(step, then=free, verified=PLAN_AGAIN)
    yield Case("plan again", one_move, MOVE + GRASP, 0, server=again, check=planned_again)
    turn = answer("relocate", relocations=[TURN], target_grasp=TARGET_GRASP)
    yield Case("turned", one_move, TURNED + GRASP, 0, server=proxy(turn, verified=GO_ON), check=turned)
    for name, wrong in (
        ("a grasp at no place", {"grasp": {"yaw": 1.25, "slack": 0.1}}),
        ("a release at no place", {"release": {"x": 0.1, "yaw": 2.75, "slack": 0.1}}),
        ("a yaw that is no number", {"to": {"x": 0.1, "y": 0.4, "yaw": "east"}}),
        ("a turn that is no number", {"turn": "half"}),
    ):
        torn = answer("relocate", relocations=[{**TURN, **wrong}], target_grasp=TARGET_GRASP)
        yield Case(name, one_move, "", 1, server=proxy(then=torn), check=counted(1))
    placeless = answer("graspable", target_grasp={"yaw": 0.5, "slack": 0.1})
    yield Case("a last grasp at no place", one_move, "", 1, server=proxy(then=placeless), check=counted(1))
    yield from clearing_cases(proxy, dropping("clear", clear=True))
    yield from away_cases(proxy, dropping("two-away", all_of=["plate-1", "plate-2"]))
    mute = proxy(step, verified=Canned(200, {"valid": True, "faults": []}))
    yield Case("torn verification", one_move, MOVE, 1, server=mute, check=counted(2))


def clearing_cases(proxy: Callable[..., Any], clear: Path) -> Iterator[Case]:
    """What is to be cleared, and what the answers say is left."""
    whole = {"target": None, "left": [], "stuck": None, "proven": True}
    cleared = proxy(answer("cleared", **whole, relocations=[DROP, ALSO]), verified=GO_ON)
    yield Case("cleared", clear, TAKE + ALSO_TAKE + "cleared\n", 0, server=cleared, check=emptied)
    nothing = proxy(answer("cleared", **whole))
    yield Case("nothing to clear", clear, "cleared\n", 0, server=nothing, check=counted(1))
    lock = {"blocked": ["cup", "plate-1", "vase"], "core": ["cup", "vase"]}
    parts = {**whole, "left": ["cup", "plate-1"], "stuck": lock, "proven": False}
    partly = proxy(answer("partly_cleared", **parts))
    told = "stuck: cup, vase hold each other\npartly cleared: cup, plate-1 left, as far as is known\n"
    yield Case("partly cleared", clear, told, 7, server=partly, check=counted(1))
    for missing in ("left", "stuck", "proven"):
        torn = proxy(answer("partly_cleared", **{name: part for name, part in parts.items() if name != missing}))
        yield Case(f"partly cleared without {missing}", clear, "", 1, server=torn, check=counted(1))
    perhaps = proxy(answer("partly_cleared", **{**parts, "proven": "perhaps"}))
    yield Case("partly cleared, perhaps", clear, "", 1, server=perhaps, check=counted(1))


def away_cases(proxy: Callable[..., Any], all_of: Path) -> Iterator[Case]:
    """Two plates are wanted away, and two objects fit on the tray."""

    def away(*steps: Any, **parts: Any) -> Canned:
        return answer("relocate", **{"target": None, "relocations": list(steps), **parts})

    again = proxy(away(DROP, ALSO), PLAN_AGAIN, away(ALSO))
    yield Case("one is away", all_of, TAKE + ALSO_TAKE + "all taken away\n", 0, server=again, check=still_wanted)
    no_grasp = proxy(away(DROP, target="cup"))
    yield Case("a target without a grasp", all_of, "", 1, server=no_grasp, check=counted(1))
    nowhere = proxy(away({**DROP, "drop_off": "shelf"}))
    yield Case("unknown drop-off", all_of, "", 1, "shelf", nowhere, check=counted(1))
    cup = {**DROP, "object": "cup"}
    third = proxy(away(cup, DROP), PLAN_AGAIN, away(DROP, ALSO), PLAN_AGAIN, away(ALSO))
    taken = TAKE.replace("plate-2", "cup") + TAKE
    yield Case("a full drop-off", all_of, taken, 1, "tray", third, check=counted(5))


def counted(count: int) -> Callable[[list[Request]], str | None]:
    return lambda requests: None if len(requests) == count else f"{len(requests)} requests, not {count}"


def four_faults(first: int) -> Callable[[list[Request]], str | None]:
    """The four from this request on, besides a plan and its verification; a client that is told to wait a second does."""

    def check(requests: list[Request]) -> str | None:
        faulty = requests[first : first + 5]
        pauses = [later.at - earlier.at for earlier, later in zip(faulty, faulty[1:])]
        for number, (pause, wanted) in enumerate(zip(pauses, (0.2, 1.0, 1.0, 0.2)), 1):
            if pause < wanted:
                return f"{pause:.2f} s after fault {number}, not {wanted}"
        if len({(request.path, str(request.body)) for request in faulty}) != 1:
            return "it does not ask the same again"
        if any(request.body.get("scene", request.body)["scene_id"] != "one-move" for request in requests):
            return "scene_id is not sent as it stands"
        return counted(6)(requests)

    return check


def patiently(waits: int, count: int) -> Callable[[list[Request]], str | None]:
    """So many requests, of which the first are to be asked again."""

    def check(requests: list[Request]) -> str | None:
        pauses = [later.at - earlier.at for earlier, later in zip(requests, requests[1:])]
        if min(pauses[:waits], default=0) < 1:
            return "without Retry-After it waits less than a second"
        return counted(count)(requests)

    return check


def limits(first: int | None, longer: int) -> Callable[[list[Request]], str | None]:
    """Two asks; the first by what the scene names, if anything."""

    def check(requests: list[Request]) -> str | None:
        sent = [request.body.get("settings", {}).get("time_limit_ms") for request in requests]
        return None if sent == [first, longer] else f"time limits {sent}, not {[first, longer]}"

    return check


def planned_again(requests: list[Request]) -> str | None:
    """A plan, its verification, another plan. The answer goes back as it came, without the step that was carried out."""
    if [request.path.endswith(VERIFY) for request in requests] != [False, True, False]:
        return f"it asked {[request.path for request in requests]}"
    _, verification, again = (request.body for request in requests)
    tolerance = verification.pop("position_tolerance", None)
    if not isinstance(tolerance, float) or not 0 < tolerance < 0.1:
        return f"position_tolerance is {tolerance}"
    left = answer("relocate", target_grasp=TARGET_GRASP).body
    if verification != {"scene": again, "plan": left, "partial": True}:
        return f"it verified {verification}"
    return None


def turned(requests: list[Request]) -> str | None:
    """A plan, and its verification with the object as it stands now."""
    first, scene = requests[0].body, requests[1].body["scene"]
    objects = [{**item, **TURN["to"]} if item["id"] == "plate-2" else item for item in first["objects"]]
    return counted(2)(requests) if scene == {**first, "objects": objects} else f"it verified on {scene}"


def emptied(requests: list[Request]) -> str | None:
    """A plan, and one verification: after the last step nothing is left to be asked."""
    if [request.path.endswith(VERIFY) for request in requests] != [False, True]:
        return f"it asked {[request.path for request in requests]}"
    first, scene = requests[0].body, requests[1].body["scene"]
    objects = [item for item in first["objects"] if item["id"] != "plate-2"]
    wanted = {**first, "objects": objects, "drop_offs": [{"id": "tray", "capacity": 1}, {"id": "bin"}]}
    return None if scene == wanted else f"it verified on {scene}"


def still_wanted(requests: list[Request]) -> str | None:
    """What is away is no longer asked for."""
    goals = [request.body.get("scene", request.body)["goal"] for request in requests]
    one = {"all_of": ["plate-1"]}
    return None if goals == [{"all_of": ["plate-1", "plate-2"]}, one, one] else f"the goals are {goals}"


def hundred_rounds(requests: list[Request]) -> str | None:
    """Each with the scene as the last move left it."""
    for request in requests[1:]:
        objects = request.body.get("scene", request.body)["objects"]
        moved = next(item for item in objects if item["id"] == "plate-2")
        if (moved["x"], moved["y"]) != (0.0627, -0.0001):
            return f"the scene was not updated: {moved}"
    return counted(201)(requests)
