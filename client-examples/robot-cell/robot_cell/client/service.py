"""The service as its client sees it: one question, asked again where that can help."""

import os
import random
import time
from typing import Any, Self

import httpx

TRIES = 5
FIRST_PAUSE = 0.2
"""Before a lost connection is tried again, s. Each pause is twice the last, varied at random."""
LONGEST_WAIT = 60.0
"""A service that asks for more patience than this is given up, s."""
AGAIN = {408, 429, 502, 503, 504}
"""Statuses after which the same request may be answered; after a 500 once."""
BEYOND_THE_TIME_LIMIT = 5.0
"""How much longer than its planning a call may take, s: these simulations keep all cores busy."""
DEFAULT_LIMIT_MS = 1000
LONGEST_LIMIT_MS = 60_000

Body = dict[str, Any]


class Refused(Exception):
    """An answer that asking again does not change: its status and its problem."""

    def __init__(self, status: int, problem: Any) -> None:
        super().__init__(status, problem)
        self.status = status
        self.problem: Body = problem if isinstance(problem, dict) else {}

    def __str__(self) -> str:
        """The title, and each fault in a line of its own."""
        title = self.problem.get("title") or f"The service answers with status {self.status}"
        faults = [f"{fault['code']} {fault['pointer']}: {fault['detail']}" for fault in self.problem.get("errors", [])]
        return "\n".join([title, *faults])


class GaveUp(Exception):
    """No answer, however often it was asked."""


class Service:
    """Counts its calls and their time, s. Sends the key of `SINGULATE_KEY`, if there is one."""

    def __init__(self, url: str, transport: httpx.BaseTransport | None = None) -> None:
        key = os.environ.get("SINGULATE_KEY")
        headers = {"authorization": f"Bearer {key}"} if key else {}
        self._client = httpx.Client(base_url=url, headers=headers, trust_env=False, transport=transport)
        self.plans = self.verifications = 0
        self.seconds = 0.0

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._client.close()

    def plan(self, scene: Body) -> Body:
        self.plans += 1
        answer = self._ask("/v1/plans", scene, _limit(scene))
        if "scene_id" in scene and answer.get("scene_id") != scene["scene_id"]:
            raise Refused(200, {"title": "The answer is for another scene"})
        return answer

    def verify(self, scene: Body, plan: Body, position_tolerance: float) -> Body:
        """Whether the steps that are left can be carried out on the table as `scene` has it."""
        self.verifications += 1
        body = {"scene": scene, "plan": plan, "position_tolerance": position_tolerance, "partial": True}
        return self._ask("/v1/plans/verify", body, _limit(scene))

    def knowledge(self, scene: Body) -> Body:
        return self._ask("/v1/knowledge", scene, _limit(scene))

    def survey(self, scene: Body) -> Body:
        return self._ask("/v1/survey", scene, _limit(scene))

    def _ask(self, path: str, body: Body, limit_ms: int) -> Body:
        """Asking again is safe: none of these calls changes anything on the server."""
        reason = ""
        for tried in range(TRIES):
            began = time.monotonic()
            try:
                response = self._client.post(path, json=body, timeout=limit_ms / 1000 + BEYOND_THE_TIME_LIMIT)
            except httpx.TransportError as error:
                reason, pause = f"connection lost: {error}", FIRST_PAUSE * 2**tried * random.uniform(0.5, 1.5)
            else:
                self.seconds += time.monotonic() - began
                if response.status_code == 200:
                    answer: Body = response.json()
                    return answer
                problem = _decoded(response)
                again = response.status_code in AGAIN or (response.status_code == 500 and tried == 0)
                if not again or (waits := _retry_after(response)) > LONGEST_WAIT:
                    raise Refused(response.status_code, problem)
                reason, pause = str(Refused(response.status_code, problem)), waits
            if tried + 1 < TRIES:
                time.sleep(pause)
        raise GaveUp(reason)


def _limit(scene: Body) -> int:
    """Whether it is in order is for the service to say."""
    settings = scene.get("settings") if isinstance(scene, dict) else None
    named = settings.get("time_limit_ms") if isinstance(settings, dict) else None
    return named if isinstance(named, int) and 0 <= named <= LONGEST_LIMIT_MS else DEFAULT_LIMIT_MS


def _retry_after(response: httpx.Response) -> float:
    header = response.headers.get("retry-after", "")
    return float(header) if header.isdecimal() else 1.0


def _decoded(response: httpx.Response) -> Any:
    try:
        return response.json()
    except ValueError:
        return None
