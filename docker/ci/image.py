"""Checks the image as it is meant to be run: read-only, without rights, small. Prints what it measures."""

import os
import re
import ssl
import sys
import tempfile
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime

from engine import ask, docker, healthy, inspect, logs, readme_scene, resident_mb, run, until, url

IMAGE = "singulate:0.1.0"
MAX_IMAGE_BYTES = 25_000_000
# The longest from SIGTERM to the end of a service that has nothing to answer, s.
MAX_END = 1.0
PLANS = 2000
HARDENED = [
    "--read-only", "--user", "65532", "--cap-drop", "ALL", "--security-opt", "no-new-privileges",
    "--memory", "128m", "--pids-limit", "64",
]  # fmt: skip


@contextmanager
def container(*arguments: str, command: tuple[str, ...] = ()) -> Iterator[str]:
    """A container of the image that runs."""
    name = docker("run", "--detach", *HARDENED, "--publish", "127.0.0.1::8080", *arguments, IMAGE, *command)
    try:
        yield name
    finally:
        docker("rm", "--force", "--volumes", name)


def plans(at: str, key: str | None = None) -> None:
    """The README's scene is planned."""
    reply = ask(at + "/v1/plans", readme_scene(), key)
    assert reply.status == 200 and (reply.json()["verdict"], reply.json()["cost"]) == ("relocate", 2), reply


def ends_well(name: str) -> float:
    """Asked to end, it ends with status 0 and in time."""
    begin = datetime.now(UTC)
    docker("kill", "--signal", "TERM", name)
    assert docker("wait", name) == "0", logs(name)
    end = re.sub(r"\.(\d{6})\d*Z", r".\1+00:00", inspect(name, ".State.FinishedAt"))
    took = (datetime.fromisoformat(end) - begin).total_seconds()
    assert took < MAX_END, f"SIGTERM took {took} s"
    return took


def check_contents() -> None:
    size = int(docker("image", "inspect", "--format", "{{.Size}}", IMAGE))
    print(f"image: {size / 1e6:.1f} MB")
    assert size < MAX_IMAGE_BYTES
    name = docker("create", IMAGE)
    try:
        listed = run("bash", "-c", f"docker export {name} | tar -t").stdout.split()
    finally:
        docker("rm", "--volumes", name)
    # Folders and what the engine itself puts into every container are no contents.
    engines = {".dockerenv", "dev/console", "etc/hostname", "etc/hosts", "etc/mtab", "etc/resolv.conf"}
    files = {file for file in listed if not file.endswith("/")} - engines
    assert files == {"singulate", "LICENSE", "etc/ssl/certs/ca-certificates.crt"}, files
    assert docker("image", "inspect", "--format", "{{.Config.User}}", IMAGE) == "65532:65532"
    labels = docker("image", "inspect", "--format", "{{json .Config.Labels}}", IMAGE)
    assert all(f"image.{label}" in labels for label in ("title", "description", "licenses", "version", "revision")), labels
    assert "unknown" not in labels, labels


def check_refusal() -> None:
    """With neither keys nor the word that none are wanted it says how both are said."""
    with container() as name:
        until(lambda: inspect(name, ".State.Running") == "false", "it refuses to start")
        assert inspect(name, ".State.ExitCode") == "2", logs(name)
        assert "--api-keys-file" in logs(name) and "--insecure" in logs(name), logs(name)


def check_keys() -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "api-keys.toml")
        key, entry = docker("run", "--rm", IMAGE, "key", "new", "robots", "--rate", "10000").split("\n\n", 1)
        with open(path, "w") as file:
            file.write(entry + "\n")
        mount = ["--volume", f"{path}:/keys.toml:ro", "--env", "SINGULATE_API_KEYS_FILE=/keys.toml"]
        with container(*mount) as name:
            healthy(name)
            at, at_rest = url(name), resident_mb(name)
            assert ask(at + "/v1/plans", readme_scene()).status == 401
            assert ask(at + "/v1/plans", readme_scene(), key[:-1]).status == 401
            for _ in range(PLANS):
                plans(at, key)
            print(f"resident memory: {at_rest:.1f} MB at rest, {resident_mb(name):.1f} MB after {PLANS} plans")
            print(f"SIGTERM to end: {ends_well(name) * 1000:.0f} ms, with the engine's part in it")


def check_insecure() -> None:
    """By the flag and by the variable; a job outlives its container, and a processor more or less is noticed."""
    volume = docker("volume", "create")
    mount = ["--volume", f"{volume}:/data"]
    try:
        with container(*mount, command=("serve", "--insecure")) as name:
            healthy(name)
            plans(url(name))
            reply = ask(url(name) + "/v1/jobs", readme_scene())
            assert reply.status == 202, reply
            ends_well(name)
        with container(*mount, "--cpus", "1", "--env", "SINGULATE_INSECURE=true") as name:
            healthy(name)
            job = f"{url(name)}/v1/jobs/{reply.json()['id']}"
            until(lambda: ask(job).json()["state"] == "succeeded", "the job has succeeded")
            serving = next(line for line in logs(name).splitlines() if "serving" in line)
            assert re.search(r"threads=1\b", re.sub(r"\x1b\[\d*m", "", serving)), serving
            plans(url(name))
            ends_well(name)
    finally:
        docker("volume", "rm", volume)


def check_tls() -> None:
    """By TLS too, of which only flags speak, the engine's probe finds its way."""
    with tempfile.TemporaryDirectory() as folder:
        os.chmod(folder, 0o755)
        certificate = ["-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days", "2"]
        names = ["-subj", "/CN=singulate", "-addext", "subjectAltName=IP:127.0.0.1", "-addext", "basicConstraints=critical,CA:FALSE"]
        run("openssl", "req", *certificate, *names, "-keyout", f"{folder}/key.pem", "-out", f"{folder}/certificate.pem")
        os.chmod(f"{folder}/key.pem", 0o644)
        serve = ("serve", "--insecure", "--tls-cert", "/tls/certificate.pem", "--tls-key", "/tls/key.pem")
        with container("--volume", f"{folder}:/tls:ro", command=serve) as name:
            healthy(name)
            trusted = ssl.create_default_context(cafile=f"{folder}/certificate.pem")
            with urllib.request.urlopen(url(name, "https") + "/readyz", context=trusted) as response:
                assert response.status == 200
            ends_well(name)


if __name__ == "__main__":
    for check in (check_contents, check_refusal, check_keys, check_insecure, check_tls):
        begin = time.monotonic()
        check()
        print(f"{check.__name__}: well, {time.monotonic() - begin:.0f} s")
        sys.stdout.flush()
