"""The planning service, asked until it answers. Needs no ROS; blocks its thread."""

from __future__ import annotations

import json
import time
from http.client import HTTPException, HTTPResponse
from typing import Any
from urllib.error import HTTPError
from urllib.request import Request, urlopen

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
    try:
        request = Request(f"{url}/v1/plans", json.dumps(scene).encode(), headers)
    except ValueError as error:
        raise Failure(str(error)) from error
    patience = scene["settings"]["time_limit_ms"] / 1000 + TRANSFER
    for pause in (*PAUSES, None):
        try:
            return _ask_once(request, patience)
        except _Again as again:
            if pause is None:
                raise Failure(f"gave up: {again}") from again
            time.sleep(pause if again.wait is None else again.wait)
    raise AssertionError("the last try returns or raises")


def _ask_once(request: Request, patience: float) -> Any:
    try:
        with urlopen(request, timeout=patience) as response:
            return json.load(response)
    except HTTPError as error:
        raise _judged(error) from error
    # A connection that is lost or refused, a head or a body that breaks off.
    except (OSError, HTTPException, ValueError) as error:
        raise _Again(str(error) or type(error).__name__) from error


def _judged(error: HTTPError) -> Failure | _Again:
    try:
        problem = json.load(error)
        title = str(problem["title"])
        faults = [f"{fault['code']} {fault['pointer']}: {fault['detail']}" for fault in problem.get("errors", [])]
    # Something between client and service may answer without a problem document.
    except (OSError, HTTPException, ValueError, TypeError, KeyError, AttributeError):
        title, faults = f"HTTP {error.code}", []
    if error.code in (429, 503):
        return _Again(title, _retry_after(error.headers.get("retry-after")))
    return Failure("; ".join(faults) if error.code == 422 and faults else title)


def _retry_after(header: str | None) -> float:
    """A second where the header is absent or a date."""
    seconds = float(header) if header is not None and header.isdigit() else 1.0
    return min(max(seconds, 1.0), LONGEST_WAIT)
