"""The Docker Engine, and what runs in it, as the checks ask them."""

import http.client
import json
import os
import subprocess
import time
import urllib.error
import urllib.request
from collections.abc import Callable
from typing import Any

# Generous: a busy machine is no fault of the image.
PATIENCE = 120.0


class Reply:
    """What came back of a request."""

    def __init__(self, status: int, text: str) -> None:
        self.status = status
        self.text = text

    def json(self) -> Any:
        return json.loads(self.text)

    def __repr__(self) -> str:
        return f"{self.status} {self.text[:500]}"


def ask(url: str, body: Any = None, key: str | None = None, headers: dict[str, str] | None = None) -> Reply:
    """One request: a GET, or a POST of the body as JSON. Fails with OSError where nobody answers."""
    data = None if body is None else json.dumps(body).encode()
    request = urllib.request.Request(url, data, headers or {})
    if data is not None:
        request.add_header("content-type", "application/json")
    if key is not None:
        request.add_header("authorization", f"Bearer {key}")
    try:
        with urllib.request.urlopen(request, timeout=PATIENCE) as response:
            return Reply(response.status, response.read().decode())
    except urllib.error.HTTPError as error:
        return Reply(error.code, error.read().decode())


def run(*command: str) -> subprocess.CompletedProcess[str]:
    """A command that has to succeed; where it fails, its output is shown."""
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done


def docker(*arguments: str) -> str:
    """What the engine's client prints."""
    return run("docker", *arguments).stdout.strip()


def inspect(container: str, what: str) -> str:
    """One thing that the engine knows of a container, as a template names it."""
    return docker("inspect", "--format", "{{" + what + "}}", container)


def logs(container: str) -> str:
    """All that a container has said."""
    done = run("docker", "logs", container)
    return done.stdout + done.stderr


def url(container: str, scheme: str = "http") -> str:
    """Where this machine reaches a container's service."""
    return f"{scheme}://" + docker("port", container, "8080/tcp").splitlines()[0]


def resident_mb(container: str) -> float:
    """The memory that the container's process holds, MB."""
    with open(f"/proc/{inspect(container, '.State.Pid')}/status") as status:
        line = next(line for line in status if line.startswith("VmRSS:"))
    return int(line.split()[1]) * 1024 / 1e6


def until(condition: Callable[[], Any], what: str) -> Any:
    """What the condition gives once it is true. Nobody who can't be reached yet makes it fail."""
    end = time.monotonic() + PATIENCE
    while True:
        last: Any = None
        try:
            last = condition()
            if last:
                return last
        except (OSError, http.client.HTTPException) as error:
            last = error
        assert time.monotonic() < end, f"not in time: {what}; last: {last!r}"
        time.sleep(0.2)


def healthy(container: str) -> None:
    """Wait until the engine's own probes say so."""

    def state() -> bool:
        running, health = inspect(container, ".State.Running"), inspect(container, ".State.Health.Status")
        assert running == "true", f"{container} has ended:\n{logs(container)}"
        return health == "healthy"

    until(state, f"{container} is healthy")


def readme_scene() -> dict[str, Any]:
    """The scene of the README."""
    with open(os.path.join(os.path.dirname(__file__), "../../src/cli/example.json")) as file:
        scene: dict[str, Any] = json.load(file)
    return scene
