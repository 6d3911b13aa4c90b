"""Figures as lines of text."""

from collections.abc import Sequence

from .interval import wilson


def rows(head: Sequence[str], body: Sequence[Sequence[str]]) -> str:
    """A table with columns as wide as they need."""
    widths = [max(len(row[at]) for row in (head, *body)) for at in range(len(head))]
    return "\n".join("  ".join(cell.rjust(width) for cell, width in zip(row, widths)) for row in (head, *body))


def share(hits: int, trials: int) -> str:
    """`38 of 40 (83 to 99 %)`, the 95 % interval of Wilson."""
    low, high = wilson(hits, trials)
    return f"{hits} of {trials} ({100 * low:.0f} to {100 * high:.0f} %)"
