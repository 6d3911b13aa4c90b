"""The service's part is played by a server that says what it is told to."""

from __future__ import annotations

import json
import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Event, Thread
from typing import Any

import pytest
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Pose
from std_msgs.msg import Header
from table import DROPPING, SETTINGS, detections, no_warning, planning_scene, table, tray, vase

from singulate_ros import service
from singulate_ros.failure import Failure
from singulate_ros.mapping import to_scene
from singulate_ros.planning import plan
from singulate_ros.settings import Settings

SCENE = to_scene(detections(), planning_scene(table(), vase()), SETTINGS, no_warning)
GRASPABLE: dict[str, Any] = {
    "verdict": "graspable",
    "target": "cup",
    "relocations": [],
    "target_grasp": {"x": 0.4, "y": 0.25, "yaw": 0.25},
    "warnings": [],
}
Reply = tuple[int, dict[str, str], str]
GOOD: Reply = (200, {}, json.dumps(GRASPABLE))
BUSY: Reply = (503, {"retry-after": "7"}, '{"title": "Overloaded"}')
# More is promised than comes.
CUT_OFF: Reply = (200, {"content-length": "1000"}, '{"verdict":')
# Comes byte by byte, and is whole only after seconds.
DRIP: Reply = (200, {}, 200 * " " + "{}")


class Stage:
    """What the server is to say, and what it was told."""

    def __init__(self, replies: list[Reply]) -> None:
        self.replies = replies
        self.url = ""
        self.keys: list[str | None] = []
        self.paths: list[str] = []
        self.bodies: list[Any] = []


@contextmanager
def server(*replies: Reply) -> Iterator[Stage]:
    stage = Stage(list(replies))

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            stage.paths.append(self.path)
            stage.keys.append(self.headers["authorization"])
            stage.bodies.append(json.loads(self.rfile.read(int(self.headers["content-length"]))))
            status, headers, body = stage.replies.pop(0)
            self.send_response(status)
            for name, value in headers.items():
                self.send_header(name, value)
            self.end_headers()
            with suppress(OSError):
                for byte in body:
                    self.wfile.write(byte.encode())
                    # The pauses of time.sleep are skipped in these tests.
                    Event().wait(0.05 if body == DRIP[2] else 0.0)

        def log_message(self, *_: object) -> None:
            pass

    listener = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    stage.url = f"http://127.0.0.1:{listener.server_port}"
    thread = Thread(target=listener.serve_forever, args=[0.01])
    thread.start()
    try:
        yield stage
    finally:
        listener.shutdown()
        thread.join()
        listener.server_close()


@pytest.fixture
def waits(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The waits that were asked for; nobody waits."""
    asked: list[float] = []
    monkeypatch.setattr(time, "sleep", asked.append)
    return asked


def refused(words: str, *replies: Reply) -> None:
    with server(*replies) as stage, pytest.raises(Failure, match=words):
        service.ask(stage.url, "", SCENE)
    assert stage.replies == []


def test_the_scene_is_sent_with_the_key_if_there_is_one(waits: list[float]) -> None:
    with server(GOOD, GOOD) as stage:
        assert service.ask(stage.url, "", SCENE) == GRASPABLE
        assert service.ask(stage.url, "sgl_key", SCENE) == GRASPABLE
    assert stage.keys == [None, "Bearer sgl_key"]
    assert stage.bodies == [SCENE, SCENE]
    assert waits == []


def test_a_service_that_is_busy_is_asked_again_when_it_says(waits: list[float]) -> None:
    with server(BUSY, (429, {}, "slower"), (503, {"retry-after": "3600"}, "{}"), GOOD) as stage:
        assert service.ask(stage.url, "", SCENE) == GRASPABLE
    assert waits == [7.0, 1.0, 60.0]


def test_a_proxy_that_does_not_reach_the_service_is_asked_again(waits: list[float]) -> None:
    with server((502, {}, "<html>"), (504, {}, "<html>"), (408, {}, "{}"), GOOD) as stage:
        assert service.ask(stage.url, "", SCENE) == GRASPABLE
    assert waits == [1.0, 1.0, 1.0]


def test_an_answer_that_breaks_off_is_asked_for_again(waits: list[float]) -> None:
    of_no_length: Reply = (200, {}, CUT_OFF[2])
    with server(CUT_OFF, of_no_length, GOOD) as stage:
        assert service.ask(stage.url, "", SCENE) == GRASPABLE
    assert waits == [0.2, 0.4]


def test_an_answer_that_comes_byte_by_byte_has_a_limit_too(waits: list[float], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(service, "TRANSFER", -0.5)
    with server(DRIP, GOOD) as stage:
        assert service.ask(stage.url, "", SCENE) == GRASPABLE
    assert waits == [0.2]


def test_the_key_goes_to_nobody_else(waits: list[float]) -> None:
    with server(GOOD) as other:
        for status in (301, 302, 303, 307, 308):
            refused(f"^HTTP {status}$", (status, {"location": f"{other.url}/v1/plans"}, ""))
    assert (other.keys, waits) == ([], [])


def test_after_five_tries_it_gives_up(waits: list[float]) -> None:
    refused("gave up: Overloaded", *[BUSY] * 5)
    assert waits == [7.0] * 4


def test_a_server_that_is_not_there_is_given_up(waits: list[float]) -> None:
    with socket.socket() as bound:
        # Bound but not listening: nobody else gets the port, and who connects is refused.
        bound.bind(("127.0.0.1", 0))
        with pytest.raises(Failure, match="gave up"):
            service.ask(f"http://127.0.0.1:{bound.getsockname()[1]}", "", SCENE)
    assert waits == [0.2, 0.4, 0.8, 1.6]


def test_an_address_that_is_none_is_refused() -> None:
    for none in ("nowhere", "ftp://nowhere", "http://", "http://nowhere:x"):
        with pytest.raises(Failure, match=none):
            service.ask(none, "", SCENE)


def test_a_slash_at_the_end_of_the_address_does_no_harm() -> None:
    with server(GOOD) as stage:
        assert service.ask(f"{stage.url}/", "", SCENE) == GRASPABLE
    assert stage.paths == ["/v1/plans"]


def test_what_asking_again_can_t_cure_is_told_at_once(waits: list[float]) -> None:
    fault = {"code": "off_table", "pointer": "/objects/0/x", "detail": "2 is not on the table"}
    refused("^off_table /objects/0/x: 2 is not on the table$", (422, {}, json.dumps({"title": "no", "errors": [fault]})))
    refused("^A key is needed$", (401, {}, '{"title": "A key is needed"}'))
    refused("^HTTP 501$", (501, {}, "<html>"))
    refused("^HTTP 500$", (500, {}, "[]"))
    assert waits == []


def test_messages_become_poses_by_way_of_the_service(monkeypatch: pytest.MonkeyPatch) -> None:
    with server(GOOD) as stage:
        monkeypatch.setenv("SINGULATE_URL", stage.url)
        monkeypatch.setenv("SINGULATE_KEY", "sgl_key")
        poses, words = plan(detections(), planning_scene(table(), vase()), SETTINGS, Time, Pose, no_warning)
    assert (stage.bodies, stage.keys) == ([SCENE], ["Bearer sgl_key"])
    assert [(pose.position.x, pose.position.y, pose.position.z) for pose in poses] == [(0.4, 0.25, 0.92)]
    assert words == "grasp cup"


def test_the_warnings_of_an_answer_are_passed_on_also_where_there_is_no_plan(monkeypatch: pytest.MonkeyPatch) -> None:
    assumed = {"code": "default_grasps", "pointer": "/objects", "detail": "grasped as their shapes suggest: 'box'"}
    locked = {"verdict": "deadlock", "deadlock": {"core": ["cup", "box"]}, "warnings": [assumed]}
    told: list[str] = []
    with server((200, {}, json.dumps(locked))) as stage, pytest.raises(Failure, match="cup, box hold each other"):
        monkeypatch.setenv("SINGULATE_URL", stage.url)
        plan(detections(), planning_scene(table()), SETTINGS, Time, Pose, told.append)
    assert told == ["default_grasps /objects: grasped as their shapes suggest: 'box'"]


def test_nobody_is_asked_where_all_that_was_wanted_is_away() -> None:
    away = replace(DROPPING, target="", all_of=["plate-7"])
    assert plan(detections(), planning_scene(table(), tray()), away, Time, Pose, no_warning) == ([], "all taken away")


def test_a_tool_of_no_known_height_is_not_sent_anywhere() -> None:
    unset = replace(SETTINGS, tool_z=Settings().tool_z)
    with pytest.raises(Failure, match="tool_z is not set"):
        plan(detections(), planning_scene(table()), unset, Time, Pose, no_warning)


def test_old_detections_are_not_planned_with() -> None:
    with pytest.raises(Failure, match=" 1.500 s old"):
        plan(detections(), planning_scene(table()), SETTINGS, lambda: Time(sec=1, nanosec=500_000_000), Pose, no_warning)


def test_detections_of_the_future_are_not_planned_with() -> None:
    ahead = detections()
    ahead.header = Header(frame_id="world", stamp=Time(sec=1, nanosec=500_000_000))
    with pytest.raises(Failure, match="-1.500 s old"):
        plan(ahead, planning_scene(table()), SETTINGS, Time, Pose, no_warning)


def test_detections_that_grow_old_while_the_service_is_asked_move_nothing(
    waits: list[float], monkeypatch: pytest.MonkeyPatch
) -> None:
    with server(BUSY, GOOD) as stage, pytest.raises(Failure, match=" 7.000 s old"):
        monkeypatch.setenv("SINGULATE_URL", stage.url)
        plan(detections(), planning_scene(table()), SETTINGS, lambda: Time(sec=int(sum(waits))), Pose, no_warning)
    assert (stage.replies, waits) == ([], [7.0])
