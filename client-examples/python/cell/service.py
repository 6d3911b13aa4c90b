"""The service as its client sees it: two questions, asked again where that can help."""

import asyncio
import sys
from dataclasses import dataclass
from typing import Any, Self

import httpx

TRIES = 5
FIRST_PAUSE = 0.2
"""Seconds before a lost connection is tried again; each pause is twice the last."""
LONGEST_WAIT = 60
BEYOND_THE_TIME_LIMIT = 5.0
"""Seconds that a call may take longer than the planning that it asks for."""


class Refused(Exception):
    """An answer that asking again does not change."""

    def __init__(self, status: int, problem: Any) -> None:
        title = problem.get("title") if isinstance(problem, dict) else None
        super().__init__(title or f"status {status}")
        self.status = status
        self.faults: list[dict[str, str]] = problem.get("errors", []) if isinstance(problem, dict) else []


class Unreachable(Exception):
    """An address or a certificate that asking again does not change."""


class GaveUp(Exception):
    """No answer, however often it was asked."""


@dataclass(frozen=True)
class Again:
    """Why there is no answer yet, and how long to wait for the next try."""

    reason: str
    pause: float


class Service:
    def __init__(self, url: str, key: str | None) -> None:
        headers = {"authorization": f"Bearer {key}"} if key else {}
        # The call's own limit is a limit of the whole call; httpx would count each read by itself. The key is for this
        # address alone.
        try:
            self._client = httpx.AsyncClient(base_url=url, headers=headers, timeout=None, follow_redirects=False)
        except httpx.InvalidURL as error:
            raise Unreachable(f"{url}: {error}") from error

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        await self._client.aclose()

    async def plan(self, scene: dict[str, Any], time_limit_ms: int) -> Any:
        """The answer's body."""
        return await self._ask("/v1/plans", scene, time_limit_ms)

    async def verify(self, scene: dict[str, Any], rest: dict[str, Any], tolerance: float, time_limit_ms: int) -> Any:
        """Whether what is left of a plan can be carried out on the table as it is now."""
        body = {"scene": scene, "plan": rest, "partial": True, "position_tolerance": tolerance}
        return await self._ask("/v1/plans/verify", body, time_limit_ms)

    async def _ask(self, path: str, body: dict[str, Any], time_limit_ms: int) -> Any:
        """The answer's body. Neither question changes anything on the server, so asking again is safe."""
        reason = ""
        for tried in range(1, TRIES + 1):
            outcome = await self._try(path, body, time_limit_ms / 1000 + BEYOND_THE_TIME_LIMIT, tried)
            if not isinstance(outcome, Again):
                return outcome
            reason = outcome.reason
            if tried < TRIES:
                print(f"{reason}: again in {outcome.pause:g} s", file=sys.stderr)
                await asyncio.sleep(outcome.pause)
        raise GaveUp(reason)

    async def _try(self, path: str, body: dict[str, Any], limit: float, tried: int) -> Any:
        try:
            async with asyncio.timeout(limit):
                response = await self._client.post(path, json=body)
        except TimeoutError:
            return Again(f"no answer within {limit:g} s", _pause(tried))
        except (httpx.UnsupportedProtocol, httpx.LocalProtocolError) as error:
            raise Unreachable(str(error)) from error
        except httpx.TransportError as error:
            # httpx has no error of its own for this.
            if "CERTIFICATE_VERIFY_FAILED" in str(error):
                raise Unreachable(str(error)) from error
            return Again(f"connection lost: {error}", _pause(tried))
        answer = _decoded(response)
        match response.status_code:
            case 200:
                return answer
            case 408 | 429 | 502 | 503 | 504 as status:
                return Again(str(Refused(status, answer)), _retry_after(response.headers.get("retry-after")))
            case status:
                raise Refused(status, answer)


def _pause(tried: int) -> float:
    return FIRST_PAUSE * 2.0 ** (tried - 1)


def _retry_after(header: str | None) -> float:
    """A date, which the header may hold too, is one that the service does not send."""
    return float(min(int(header), LONGEST_WAIT)) if header and header.isdecimal() else 1.0


def _decoded(response: httpx.Response) -> Any:
    """None where the body is no JSON: something else than the service has answered."""
    try:
        return response.json()
    except ValueError:
        return None
