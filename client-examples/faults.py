"""A server that fails on purpose: what a client meets when the network or the service has a bad day."""

import http.client
import json
import socket
import socketserver
import struct
import threading
import time
from dataclasses import dataclass, field
from typing import Any

PATIENCE = 60.0
"""Seconds, long enough for any machine."""
DRIP = 0.3
VERIFY = "/v1/plans/verify"


@dataclass(frozen=True)
class Reset:
    """Takes the request and resets the connection."""


@dataclass(frozen=True)
class CutOff:
    """Passes the request on, and closes in the middle of the answer."""


@dataclass(frozen=True)
class Drip:
    """Answers byte by byte, for ever: no pause is long, the whole is."""


@dataclass(frozen=True)
class Pass:
    """Passes the request on, and the answer back."""


@dataclass(frozen=True)
class Canned:
    """An answer of its own."""

    status: int
    body: Any
    headers: dict[str, str] = field(default_factory=dict)


Step = Reset | CutOff | Drip | Pass | Canned


@dataclass(frozen=True)
class Request:
    at: float
    path: str
    headers: dict[str, str]
    body: Any


class Proxy:
    """Answers its first requests by `steps`, and all others by `then`, verifications by `verified`. Each has a connection of
    its own."""

    def __init__(self, steps: list[Step], then: Step, verified: Step, upstream: tuple[str, int]) -> None:
        self.requests: list[Request] = []
        self._steps, self._then, self._verified, self._upstream = list(steps), then, verified, upstream
        self._lock = threading.Lock()
        proxy = self

        class Handler(socketserver.StreamRequestHandler):
            def handle(self) -> None:
                proxy._serve(self)

        class Server(socketserver.ThreadingTCPServer):
            daemon_threads = True
            block_on_close = False

            def shutdown_request(self, request: Any) -> None:
                # Without the shutdown that would come before a reset, and prevent it.
                request.close()

        self._server = Server(("127.0.0.1", 0), Handler)
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def __enter__(self) -> "Proxy":
        return self

    def __exit__(self, *_: object) -> None:
        self._server.shutdown()
        self._server.server_close()

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self._server.server_address[1]}"

    def _serve(self, handler: socketserver.StreamRequestHandler) -> None:
        try:
            head = handler.rfile.readline().decode().split()
            headers = http.client.parse_headers(handler.rfile)
            text = handler.rfile.read(int(headers.get("content-length", 0)))
            if not head or not text:
                return
            with self._lock:
                otherwise = self._verified if head[1].endswith(VERIFY) else self._then
                step = self._steps.pop(0) if self._steps else otherwise
                lowered = {name.lower(): value for name, value in headers.items()}
                request = Request(time.monotonic(), head[1], lowered, json.loads(text))
                self.requests.append(request)
            self._answer(handler, step, request, text)
        except ConnectionError:
            pass  # A client may hang up at any time.

    def _answer(self, handler: socketserver.StreamRequestHandler, step: Step, request: Request, text: bytes) -> None:
        match step:
            case Reset():
                linger = struct.pack("ii", 1, 0)
                handler.connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, linger)
            case Drip():
                handler.wfile.write(head_of(200, {"content-type": "application/json"}, 1_000_000))
                give_up = time.monotonic() + PATIENCE
                while time.monotonic() < give_up:
                    handler.wfile.write(b" ")
                    time.sleep(DRIP)
            case Canned(status, body, more):
                said = json.dumps(body).encode()
                handler.wfile.write(head_of(status, {"content-type": "application/json", **more}, len(said)) + said)
            case Pass() | CutOff():
                status, answered, said = self._ask(request, text)
                head = head_of(status, answered, len(said))
                handler.wfile.write(head + (said if isinstance(step, Pass) else said[: len(said) // 2]))

    def _ask(self, request: Request, text: bytes) -> tuple[int, dict[str, str], bytes]:
        upstream = http.client.HTTPConnection(*self._upstream, timeout=PATIENCE)
        passed = {name: value for name in ("content-type", "authorization") if (value := request.headers.get(name))}
        upstream.request("POST", request.path, text, passed)
        response = upstream.getresponse()
        said = response.read()
        upstream.close()
        answered = {name: value for name in ("content-type", "retry-after") if (value := response.getheader(name))}
        return response.status, answered, said


def head_of(status: int, headers: dict[str, str], length: int) -> bytes:
    lines = [f"HTTP/1.1 {status} {http.client.responses[status]}", f"content-length: {length}", "connection: close"]
    return "\r\n".join([*lines, *(f"{name}: {value}" for name, value in headers.items()), "", ""]).encode()
