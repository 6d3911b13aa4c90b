"""The planning service, asked until it answers. Needs no ROS; blocks its thread.

The key goes to the service alone: no redirect is followed, and no proxy of the environment asked.
"""

from __future__ import annotations

import json
import socket
import ssl
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from http.client import HTTPConnection, HTTPException, HTTPResponse, HTTPSConnection
from threading import Timer
from typing import Any
from urllib.parse import SplitResult, urlsplit

from singulate_ros.failure import Failure
from singulate_ros.mapping import Scene

# After a lost connection, s; planning changes nothing, so to ask again is safe. One pause less than there are tries.
PAUSES = (0.2, 0.4, 0.8, 1.6)
# A service that wants more patience than this, s, is down, as far as a robot is concerned.
LONGEST_WAIT = 60.0
# For the way there and back, s, on top of the time to plan.
TRANSFER = 5.0


class _Again(Exception):
    """No answer this time, but perhaps the next. Where the service names no wait the next pause counts."""

    def __init__(self, reason: str, wait: float | None = None) -> None:
        super().__init__(reason)
        self.wait = wait


def ask(url: str, key: str, scene: Scene) -> Any:
    """The answer's document. An empty key is not sent."""
    headers = {"content-type": "application/json", "accept": "application/json"}
    if key:
        headers["authorization"] = f"Bearer {key}"
    address, body = _address(url), json.dumps(scene).encode()
    patience = scene["settings"]["time_limit_ms"] / 1000 + TRANSFER
    for pause in (*PAUSES, None):
        try:
            return _ask_once(address, headers, body, patience)
        except _Again as again:
            if pause is None:
                raise Failure(f"gave up: {again}") from again
            time.sleep(pause if again.wait is None else again.wait)
    raise AssertionError("the last try returns or raises")


def _address(url: str) -> SplitResult:
    try:
        address = urlsplit(url.rstrip("/") + "/v1/plans")
        if address.scheme in ("http", "https") and address.hostname and address.port != 0:
            return address
    except ValueError:
        pass
    raise Failure(f"SINGULATE_URL is no address of HTTP: {url}")


def _ask_once(address: SplitResult, headers: dict[str, str], body: bytes, patience: float) -> Any:
    kind = HTTPSConnection if address.scheme == "https" else HTTPConnection
    give_up = time.monotonic() + patience
    try:
        with closing(kind(address.hostname or "", address.port, timeout=patience)) as connection:
            connection.connect()
            with _cut(connection.sock, give_up):
                connection.request("POST", address.path, body, headers)
                response = connection.getresponse()
                return _judged(response, response.read())
    except ssl.SSLCertVerificationError as error:
        raise Failure(str(error)) from error
    # A connection that is lost or refused, a head or a body that breaks off.
    except (OSError, HTTPException, ValueError) as error:
        late = time.monotonic() >= give_up
        raise _Again(f"no answer within {patience:g} s" if late else str(error) or type(error).__name__) from error


@contextmanager
def _cut(connected: socket.socket, give_up: float) -> Iterator[None]:
    """Ends the connection then, whatever still comes: the socket's own limit counts from byte to byte."""

    def end() -> None:
        with suppress(OSError):
            connected.shutdown(socket.SHUT_RDWR)

    timer = Timer(max(give_up - time.monotonic(), 0.0), end)
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


def _judged(response: HTTPResponse, body: bytes) -> Any:
    if response.status == 200:
        return json.loads(body)
    try:
        problem = json.loads(body)
        title = str(problem["title"])
        faults = [f"{fault['code']} {fault['pointer']}: {fault['detail']}" for fault in problem.get("errors", [])]
    # Something between client and service may answer without a problem document.
    except (ValueError, TypeError, KeyError, AttributeError):
        title, faults = f"HTTP {response.status}", []
    if response.status in (408, 429, 502, 503, 504):
        raise _Again(title, _retry_after(response.getheader("retry-after")))
    raise Failure("; ".join(faults) if response.status == 422 and faults else title)


def _retry_after(header: str | None) -> float:
    """A second where the header is absent or a date."""
    seconds = float(header) if header is not None and header.isdigit() else 1.0
    return min(max(seconds, 1.0), LONGEST_WAIT)
