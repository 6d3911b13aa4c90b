"""The service to ask, and the command that generates scenes."""

import json
import os
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from ..physics.world import Scene

PATIENCE = 30.0
"""Until a service answers that was just started, s."""
GREATEST_OVERLAP = 0.05
"""The service admits scenes whose dishes seem to overlap by so much, m: at a sigma of 5 mm two centres differ by 30 mm."""


def binary() -> str:
    """The program of the service. `run` names it."""
    return os.environ["SINGULATE"]


@contextmanager
def service() -> Iterator[str]:
    """The address of `SINGULATE_URL`, or that of a service of our own as long as it is needed."""
    if named := os.environ.get("SINGULATE_URL"):
        yield named
        return
    command = [binary(), "serve", "--listen", "127.0.0.1:0", "--insecure", "--log", "warn"]
    command += ["--jobs-url", "sqlite::memory:", "--max-overlap-tolerance", str(GREATEST_OVERLAP)]
    said = tempfile.TemporaryFile("w+")
    # In a session of its own: Ctrl-C is for this program, which then ends the service.
    with said, subprocess.Popen(command, stdout=said, env=_environment(), start_new_session=True) as server:
        try:
            yield _address(said, server)
        finally:
            server.terminate()


def _address(said: Any, server: subprocess.Popen[bytes]) -> str:
    give_up = time.monotonic() + PATIENCE
    while time.monotonic() < give_up:
        said.seek(0)
        words = said.read().split()
        if words[:3] == ["singulate", "listens", "on"] and len(words) > 3:
            return str(words[3])
        if server.poll() is not None:
            raise RuntimeError(f"the service ended with status {server.returncode}")
        time.sleep(0.05)
    raise RuntimeError(f"the service did not answer within {PATIENCE:g} s")


def generate(objects: int, seed: int, **recipe: str) -> Scene:
    """A scene of `singulate generate`, with more of its flags in `recipe`. The same seed gives the same scene."""
    command = [binary(), "generate", "--objects", str(objects), "--seed", str(seed)]
    for flag, values in recipe.items():
        command += [f"--{flag.replace('_', '-')}", *values.split()]
    made = subprocess.run(command, capture_output=True, text=True, check=True, env=_environment())
    scene: Scene = json.loads(made.stdout)
    scene["scene_id"] = f"{objects}/{seed}"
    return scene


def _environment() -> dict[str, str]:
    """Without settings of the caller."""
    return {name: value for name, value in os.environ.items() if not name.startswith("SINGULATE_")}
