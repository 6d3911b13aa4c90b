"""The uncertainty of a rate."""

import math

Z = 1.959964
"""Of 95 %."""


def wilson(hits: int, trials: int) -> tuple[float, float]:
    """The 95 % score interval of Wilson (1927) for the rate of `hits` in `trials`."""
    if trials == 0:
        return 0.0, 1.0
    rate, square = hits / trials, Z * Z / trials
    middle = (rate + square / 2) / (1 + square)
    half = Z / (1 + square) * math.sqrt(rate * (1 - rate) / trials + square / (4 * trials))
    return max(0.0, middle - half), min(1.0, middle + half)
