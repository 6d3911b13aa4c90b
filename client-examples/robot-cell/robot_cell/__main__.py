"""`run COMMAND`: see README.md beside this package."""

import argparse
import json
import signal
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any

from .client.service import GaveUp, Refused
from .experiments import controller, film, hand, noise, own_scene, palm, relocations, table3, tolerance
from .experiments.server import service

COMMANDS: dict[str, Any] = {
    "table3": table3,
    "relocations": relocations,
    "noise": noise,
    "controller": controller,
    "hand": hand,
    "palm": palm,
    "tolerance": tolerance,
    "scene": own_scene,
    "film": film,
}
"""Modules with `add_arguments`, `measure`, `text`, and where the exit status is not always 0 `status`."""
INTERRUPTED = 130


def main() -> int:
    options = arguments()
    command = COMMANDS[options.command]
    for ended in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(ended, lambda *_: sys.exit(1))
    try:
        with service() as url:
            figures = {"command": called(options), "versions": versions(), **command.measure(options, url)}
    except (OSError, RuntimeError, ValueError, GaveUp, Refused) as error:
        print(error, file=sys.stderr)
        return 2 if isinstance(error, Refused) else 1
    except KeyboardInterrupt:
        print("stopped", file=sys.stderr)
        return INTERRUPTED
    if options.out:
        options.out.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")
    print(command.text(figures))
    return int(command.status(figures)) if hasattr(command, "status") else 0


def called(options: argparse.Namespace) -> str:
    """The command, without what does not change the figures."""
    words = [options.command]
    for name, value in vars(options).items():
        if name not in ("command", "jobs", "out", "frames", "picture") and value is not None:
            listed = value if isinstance(value, list) else [value]
            words += [*([] if name == "scene" else [f"--{name.replace('_', '-')}"]), *map(str, listed)]
    return " ".join(["client-examples/robot-cell/run", *words])


def versions() -> dict[str, str]:
    """Of the packages that the figures depend on."""
    return {name: version(name) for name in ("mujoco", "ompl", "numpy")}


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="run", description="Carries out plans of singulate in physics.")
    commands = parser.add_subparsers(dest="command", required=True)
    for name, module in COMMANDS.items():
        about = module.__doc__.strip().splitlines()[0]
        command = commands.add_parser(name, help=about, description=about)
        command.add_argument("--out", type=new_file, help="a file for the figures as JSON")
        module.add_arguments(command)
    return parser.parse_args()


def new_file(text: str) -> Path:
    """Told before hours of work, not after."""
    path = Path(text)
    if path.is_dir() or not path.absolute().parent.is_dir():
        raise argparse.ArgumentTypeError(f"{path} can't be written")
    return path


if __name__ == "__main__":
    sys.exit(main())
