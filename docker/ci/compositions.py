"""Checks the compose files as they stand: one container, and a fleet that loses a replica while it works.

The argument is the folder that docker/new-secrets has filled."""

import json
import os
import signal
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any

from engine import PATIENCE, Reply, ask, docker, healthy, inspect, logs, readme_scene, run, until

SECRETS = sys.argv[1]
FOLDER = os.path.join(os.path.dirname(__file__), "..")
# Quick ones, sent while a replica dies.
JOBS = 300


def secret(name: str) -> str:
    """What a file of the secrets holds."""
    with open(os.path.join(SECRETS, name)) as file:
        return file.read().strip()


class Composition:
    """A compose file that is up."""

    def __init__(self, file: str) -> None:
        self.name = f"check-{file.split('.')[-2]}"
        self.command = ["docker-compose", "--project-name", self.name, "--file", os.path.join(FOLDER, file)]

    def compose(self, *arguments: str) -> str:
        return run(*self.command, *arguments).stdout.strip()

    def container(self, service: str) -> str:
        return self.compose("ps", "--quiet", service)

    def published(self, service: str, port: int) -> str:
        """Where this machine reaches a service."""
        return "http://" + self.compose("port", service, str(port))

    def direct(self, service: str) -> str:
        """Where a replica answers, past the proxy."""
        networks = json.loads(inspect(self.container(service), "json .NetworkSettings.Networks"))
        return f"http://{networks[self.name + '_front']['IPAddress']}:8080"


@contextmanager
def up(file: str) -> Iterator[Composition]:
    """Bring a compose file up, on free ports and with the secrets; away with it and its volumes in the end."""
    os.environ.update(SECRETS=SECRETS, PUBLISH="127.0.0.1:0", PUBLISH_PROMETHEUS="127.0.0.1:0")
    composition = Composition(file)
    try:
        composition.compose("up", "--detach")
        yield composition
    except BaseException:
        subprocess.run([*composition.command, "logs", "--no-color", "--tail", "50"], check=False, stdout=sys.stderr)
        raise
    finally:
        composition.compose("down", "--volumes")


def check_rotation(url: str, job: str) -> None:
    """A second key of the robots holds as soon as the file has it, sees the robots' jobs, and ends with its entry."""
    path = os.path.join(SECRETS, "api-keys.toml")
    with open(path) as file:
        before = file.read()
    key, entry = docker("run", "--rm", "singulate:0.1.0", "key", "new", "robots").split("\n\n", 1)

    def status() -> int:
        return ask(f"{url}/v1/jobs/{job}", key=key).status

    assert status() == 401
    with open(path, "a") as file:
        file.write(f"\n{entry}\n")
    until(lambda: status() == 200, "the new key holds")
    with open(path, "w") as file:
        file.write(before)
    until(lambda: status() == 401, "the new key has ended")


def check_one_machine() -> None:
    key = secret("robots-key")
    with up("compose.yaml") as one:
        name = one.container("singulate")
        healthy(name)
        url = one.published("singulate", 8080)
        assert ask(url + "/v1/plans", readme_scene()).status == 401
        job = ask(url + "/v1/jobs", readme_scene(), key).json()["id"]
        # The volume outlives the container.
        one.compose("up", "--detach", "--force-recreate")
        name = one.container("singulate")
        healthy(name)
        url = one.published("singulate", 8080)
        until(lambda: ask(f"{url}/v1/jobs/{job}", key=key).json()["state"] == "succeeded", "the job has succeeded")
        check_rotation(url, job)


def persist(url: str, body: Any, key: str, idempotency_key: str) -> str:
    """The id of a job, asked for again until it is accepted: what a client has to do."""

    def accepted() -> str | None:
        reply: Reply = ask(url + "/v1/jobs", body, key, {"idempotency-key": idempotency_key})
        if reply.status in (502, 503, 504):
            return None
        assert reply.status == 202, reply
        return str(reply.json()["id"])

    return str(until(accepted, f"{idempotency_key} is accepted"))


def slow_scene() -> dict[str, Any]:
    """A scene over which one of the paper's searches works for a second."""
    made = docker("run", "--rm", "singulate:0.1.0", "generate", "--objects", "25", "--table", "1.4", "0.7")
    return {**json.loads(made), "settings": {"search": "forward_astar", "time_limit_ms": 2000}, "priority": 100}


def all_jobs(url: str, key: str) -> list[str]:
    """The ids of all jobs of a key."""
    ids: list[str] = []
    cursor = ""
    while True:
        page = ask(f"{url}/v1/jobs?limit=100{cursor}", key=key).json()
        ids += [job["id"] for job in page["jobs"]]
        if page.get("next_cursor") is None:
            return ids
        cursor = f"&cursor={page['next_cursor']}"


def events(url: str, job: str, key: str) -> list[str]:
    """The names of all that has happened to an ended job."""
    text = ask(f"{url}/v1/jobs/{job}/events", key=key).text
    return [line.removeprefix("event: ") for line in text.splitlines() if line.startswith("event: ")]


def check_shared_jobs(fleet: Composition, key: str) -> None:
    """What one replica accepts, the other tells of."""
    one, other = fleet.direct("singulate-1"), fleet.direct("singulate-2")
    for submitted, read in ((one, other), (other, one)):
        job = ask(submitted + "/v1/jobs", readme_scene(), key).json()["id"]
        until(lambda: ask(f"{read}/v1/jobs/{job}?wait_ms=30000", key=key).json()["state"] == "succeeded", job)


def check_stream(proxy: str, key: str) -> None:
    """The proxy hands events on as they come: the first one is here before the job has ended."""
    job = persist(proxy, slow_scene(), key, "stream")
    request = urllib.request.Request(f"{proxy}/v1/jobs/{job}/events", headers={"authorization": f"Bearer {key}"})
    with urllib.request.urlopen(request, timeout=PATIENCE) as stream:
        first = stream.readline()
        state = ask(f"{proxy}/v1/jobs/{job}", key=key).json()["state"]
        assert first and state in ("queued", "running"), (first, state)


def check_loss(fleet: Composition, proxy: str, key: str) -> None:
    """One replica is killed in the middle of its jobs and of its clients' requests."""
    before = set(all_jobs(proxy, key))
    # What a replica may use, which is how many workers it has.
    cpus = int(inspect(fleet.container("singulate-2"), ".HostConfig.NanoCpus")) // 10**9
    # Enough for the workers of both replicas, several times over.
    scene = slow_scene()
    slow = [persist(proxy, scene, key, f"slow-{number}") for number in range(6 * cpus)]

    def busy() -> bool:
        # More than one replica has workers for: both have some.
        return len(ask(f"{proxy}/v1/jobs?state=running&limit=100", key=key).json()["jobs"]) > cpus

    until(busy, "both replicas work")
    victim = fleet.container("singulate-1")
    with ThreadPoolExecutor(8) as clients:
        quick = [clients.submit(persist, proxy, readme_scene(), key, f"quick-{number}") for number in range(JOBS)]
        until(lambda: sum(job.done() for job in quick) >= JOBS // 10, "the clients are at work")
        os.kill(int(inspect(victim, ".State.Pid")), signal.SIGKILL)
        ids = slow + [job.result() for job in quick]
    assert len(set(ids)) == len(ids) == 6 * cpus + JOBS

    attempts = 0
    for job in ids:
        url = f"{proxy}/v1/jobs/{job}?wait_ms=30000"

        def ended() -> Any:
            reply = ask(url, key=key)
            return reply.status == 200 and reply.json()["state"] not in ("queued", "running") and reply.json()

        told = until(ended, f"{job} has ended")
        assert told["state"] == "succeeded", told
        attempts = max(attempts, told["attempts"])
        assert events(proxy, job, key).count("finished") == 1, job
    assert attempts == 2, f"nothing was lost with the replica: at most {attempts} attempts"
    assert set(all_jobs(proxy, key)) == before | set(ids), "a job that nobody knows of"
    # Docker has started it again.
    healthy(victim)
    assert inspect(victim, ".RestartCount") == "1"
    print(f"{len(ids)} jobs accepted while a replica was killed: each succeeded once")


def check_prometheus(fleet: Composition) -> None:
    url = fleet.published("prometheus", 9090) + "/api/v1/query?query=up%7Bjob%3D%22singulate%22%7D"

    def seen() -> bool:
        found = {one["metric"]["instance"]: one["value"][1] for one in ask(url).json()["data"]["result"]}
        return found == {"singulate-1:8080": "1", "singulate-2:8080": "1"}

    until(seen, "Prometheus sees both replicas up")


def check_fleet() -> None:
    key = secret("robots-key")
    with up("compose.fleet.yaml") as fleet:
        proxy = fleet.published("proxy", 8080)
        until(lambda: ask(proxy + "/readyz").status == 200, "the proxy passes requests on")
        assert ask(proxy + "/v1/plans", readme_scene()).status == 401
        assert ask(proxy + "/v1/plans", readme_scene(), key).json()["verdict"] == "relocate"
        check_shared_jobs(fleet, key)
        check_stream(proxy, key)
        check_loss(fleet, proxy, key)
        check_prometheus(fleet)
        for service in ("singulate-1", "singulate-2"):
            name = fleet.container(service)
            fleet.compose("stop", service)
            assert inspect(name, ".State.ExitCode") == "0", logs(name)


if __name__ == "__main__":
    for check in (check_one_machine, check_fleet):
        begin = time.monotonic()
        check()
        print(f"{check.__name__}: well, {time.monotonic() - begin:.0f} s")
        sys.stdout.flush()
