"""Starts the container of kubernetes.yaml with its variables, its Secret and its security context, and asks its probes."""

import os
import tempfile
from typing import Any

import yaml
from engine import ask, docker, inspect, logs, until, url


def manifest() -> dict[str, Any]:
    """Everything of kubernetes.yaml, by kind."""
    with open(os.path.join(os.path.dirname(__file__), "../kubernetes.yaml")) as file:
        return {one["kind"]: one for one in yaml.safe_load_all(file)}


def variables(container: dict[str, Any]) -> list[str]:
    """What the pod tells the service; the database is one that is there."""
    pairs = {one["name"]: one.get("value", "sqlite::memory:") for one in container["env"]}
    assert "sqlite::memory:" in pairs["SINGULATE_JOBS_URL"], pairs
    return [argument for name, value in pairs.items() for argument in ("--env", f"{name}={value}")]


def secret_files(pod: dict[str, Any], secret: dict[str, str], folder: str) -> list[str]:
    """The Secret as the pod sees it: root's, read by a group."""
    mount, volume = pod["containers"][0]["volumeMounts"][0], pod["volumes"][0]["secret"]
    for item in volume["items"]:
        path = os.path.join(folder, item["path"])
        with open(path, "w") as file:
            file.write(secret[item["key"]])
        os.chmod(path, volume["defaultMode"])
        os.chown(path, 0, pod["securityContext"]["fsGroup"])
    os.chmod(folder, 0o755)
    return ["--volume", f"{folder}:{mount['mountPath']}:ro"]


def check_pod() -> None:
    kinds = manifest()
    pod = kinds["Deployment"]["spec"]["template"]["spec"]
    container, context = pod["containers"][0], pod["securityContext"]
    assert container["securityContext"]["capabilities"]["drop"] == ["ALL"]
    assert container["securityContext"]["readOnlyRootFilesystem"] and context["runAsNonRoot"]
    hardened = ["--read-only", "--cap-drop", "ALL", "--security-opt", "no-new-privileges", "--tmpfs", "/data:ro"]
    user = ["--user", f"{context['runAsUser']}:{context['fsGroup']}"]
    limits = container["resources"]["limits"]
    size = ["--cpus", limits["cpu"], "--memory", limits["memory"].replace("Mi", "m")]
    with tempfile.TemporaryDirectory() as folder:
        files = secret_files(pod, kinds["Secret"]["stringData"], folder)
        options = [*hardened, *user, *size, *files, *variables(container), "--publish", "127.0.0.1::8080"]
        name = docker("run", "--detach", *options, container["image"])
        try:
            for probe in ("startupProbe", "readinessProbe", "livenessProbe"):
                path = container[probe]["httpGet"]["path"]

                def answers() -> bool:
                    assert inspect(name, ".State.Running") == "true", logs(name)
                    return ask(url(name) + path).status == 200

                until(answers, probe)
            assert ask(url(name) + "/v1/jobs").status == 401
        finally:
            docker("rm", "--force", "--volumes", name)
    grace = pod["terminationGracePeriodSeconds"] - container["lifecycle"]["preStop"]["sleep"]["seconds"]
    assert grace > 10, "drain_ms, by default 10 s, must fit in"


if __name__ == "__main__":
    check_pod()
    print("check_pod: well")
