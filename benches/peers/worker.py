"""A solver in a process of its own, so that it can be stopped, and so that no two solvers share one."""

import json
import os
import select
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent


@dataclass(frozen=True)
class Timing:
    """One solver's answer: from the base in memory to the proven optimum (None: the target can't be derived)."""

    optimum: int | None
    seconds: float
    solve_seconds: float
    how: str


class Worker:
    """A solver's process, started when it is first asked and again after it was stopped."""

    def __init__(self, script: str) -> None:
        self.script = script
        self.process: subprocess.Popen[bytes] | None = None

    def ask(self, instance: dict[str, Any], how: str, limit: float) -> Timing | None:
        """None where the answer takes longer than `limit` seconds."""
        process = self.process = self.process or self._start()
        assert process.stdin is not None and process.stdout is not None
        question = {"how": how, "target": instance["target"], "options": instance["options"]}
        process.stdin.write(json.dumps(question).encode() + b"\n")
        process.stdin.flush()
        ready, _, _ = select.select([process.stdout], [], [], limit)
        if not ready:
            self.stop()
            return None
        line = process.stdout.readline()
        if not line:
            raise RuntimeError(f"{self.script} ended with status {process.wait()}")
        answer = json.loads(line)
        return Timing(answer["optimum"], answer["seconds"], answer["solve_seconds"], how)

    def stop(self) -> None:
        """End the process."""
        if self.process:
            self.process.kill()
            self.process.communicate()
            self.process = None

    def _start(self) -> subprocess.Popen[bytes]:
        environment = os.environ | {"PYTHONDONTWRITEBYTECODE": "1"}
        command = [sys.executable, str(HERE / self.script)]
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment)
        assert process.stdout is not None
        # Loading a solver is on nobody's bill.
        if process.stdout.readline() != b"ready\n":
            raise RuntimeError(f"{self.script} does not start")
        return process
