"""What is measured, each a command: its arguments, its figures as JSON, and their text."""

from typing import Any

Figures = dict[str, Any]
"""What a command writes with `--out`."""
