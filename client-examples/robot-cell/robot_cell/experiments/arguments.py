"""Kinds of numbers on the command line."""

import argparse
import math
import os


def positive(text: str) -> int:
    """A whole number from 1."""
    if (value := whole(text)) == 0:
        raise argparse.ArgumentTypeError("0 is too little")
    return value


def whole(text: str) -> int:
    """A whole number from 0."""
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"'{text}' is no whole number")
    return int(text)


def not_negative(text: str) -> float:
    """A length or an angle."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0 <= value < math.inf:
        raise argparse.ArgumentTypeError(f"'{text}' is no number from 0 on")
    return value


def add_jobs(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--jobs", type=positive, default=os.cpu_count() or 1, help="processes (default: one a core)")
