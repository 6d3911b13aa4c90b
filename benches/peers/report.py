"""What a run says of each class, and what is wrong with it."""

import statistics
from collections.abc import Iterable
from dataclasses import dataclass
from math import inf
from typing import Any

from worker import Timing

PEERS = ["clingo", "cpsat", "pyperplan"]
SYNTHETIC, CROWD = "synthetic", "crowd-10000"
LEAST_MEDIAN_RATIO = 10.0
LEAST_INSTANCES = 500
# Seconds: the search's on pressed clusters, knowledge and deadlock in the crowd.
SEARCH_BOUNDS = {"pressed-300": 0.010, "pressed-600": 0.010}
CROWD_BOUND = 0.020


@dataclass(frozen=True)
class Result:
    """One instance, ours and theirs; a peer that did not finish is None, one that was not asked is not there."""

    kind: str
    name: str
    objects: int
    ours: Timing | None
    our_seconds: float
    knowledge_seconds: float | None
    peers: dict[str, Timing | None]

    def best(self) -> float | None:
        """The fastest peer's time, s."""
        return min((timing.seconds for timing in self.peers.values() if timing), default=None)

    def ratio(self) -> float | None:
        """How many times as long as ours the fastest peer takes: 0 where ours did not finish, None where nobody did."""
        best = self.best()
        if self.ours is None:
            return None if best is None else 0.0
        return inf if best is None else best / self.our_seconds

    def brief(self) -> dict[str, Any]:
        """For the file: seconds to three digits; null for who did not finish."""

        def told(timing: Timing) -> dict[str, Any]:
            return {"seconds": short(timing.seconds), "solve_seconds": short(timing.solve_seconds), "how": timing.how}

        answer = self.ours or next((timing for timing in self.peers.values() if timing), None)
        return {
            "class": self.kind,
            "name": self.name,
            "objects": self.objects,
            "derivable": None if answer is None else answer.optimum is not None,
            "optimum": answer and answer.optimum,
            "ours": short(self.our_seconds) if self.ours else None,
            "knowledge": None if self.knowledge_seconds is None else short(self.knowledge_seconds),
            "peers": {name: told(timing) if timing else None for name, timing in self.peers.items()},
        }


def short(seconds: float) -> float:
    """Three digits."""
    return float(f"{seconds:.3g}")


def by_class(results: Iterable[Result]) -> dict[str, list[Result]]:
    """In the order of the run."""
    classes: dict[str, list[Result]] = {}
    for result in results:
        classes.setdefault(result.kind, []).append(result)
    return classes


def milliseconds(seconds: list[float]) -> str:
    """Median and worst; infinite where a solver did not finish."""
    return f"{1e3 * statistics.median(seconds):10.3f} {1e3 * max(seconds):10.3f}"


def table(kind: str, results: list[Result]) -> str:
    """A class on a few lines. Times in ms: median, worst; then the median of solving alone."""
    optima = [r.ours.optimum for r in results if r.ours and r.ours.optimum is not None]
    deadlocks = sum(r.ours is not None and r.ours.optimum is None for r in results)
    span = f"{min(optima)} to {max(optima)}" if optima else "none"
    lines = [f"{kind}: {len(results)} instances, optimum {span}, {deadlocks} deadlocks"]
    lines.append(f"  {'':<10} {'median ms':>10} {'worst ms':>10} {'solve only':>10}  unsolved")
    ours = [r.our_seconds if r.ours else inf for r in results]
    lines.append(f"  {'ours':<10} {milliseconds(ours)} {'':>10}  {ours.count(inf)}")
    knowledge = [r.our_seconds + r.knowledge_seconds for r in results if r.knowledge_seconds is not None]
    if knowledge:
        lines.append(f"  {'+knowledge':<10} {milliseconds(knowledge)}")
    for peer in [peer for peer in PEERS if peer in results[0].peers]:
        timings = [r.peers[peer] for r in results]
        times = [timing.seconds if timing else inf for timing in timings]
        alone = statistics.median(timing.solve_seconds if timing else inf for timing in timings)
        ways = [timing.how for timing in timings if timing]
        how = ", ".join(f"{name} {ways.count(name)}" for name in dict.fromkeys(ways))
        lines.append(f"  {peer:<10} {milliseconds(times)} {1e3 * alone:10.3f}  {times.count(inf)}  ({how})")
    ratios = [ratio for r in results if (ratio := r.ratio()) is not None]
    if ratios:
        won = sum(ratio > 1 for ratio in ratios)
        lines.append(
            f"  fastest peer/ours: median {statistics.median(ratios):.1f}, worst {min(ratios):.2f}; "
            f"ours faster on {won} of {len(ratios)}"
        )
    return "\n".join(lines)


def faults(results: list[Result], full: bool) -> list[str]:
    """Whatever must not be. A few instances, the deepest first, are no measure of a class: they have to agree and to be won
    in the median; all other bounds are for a full run."""
    found = []
    for kind, of_class in by_class(results).items():
        for r in of_class:
            answers = {timing.optimum for timing in [r.ours, *r.peers.values()] if timing}
            if len(answers) > 1:
                found.append(f"{kind}, {r.name}: the optima differ: {r.ours}, {r.peers}")
        if kind not in (SYNTHETIC, CROWD):
            found += slow_class(kind, of_class, full)
    return found + missed(results) if full else found


def slow_class(kind: str, results: list[Result], full: bool) -> list[str]:
    """What a scene-born class has against our search: unsolved instances, and a median ratio below what is wanted."""
    found = [f"{kind}, {r.name}: not solved by ours" for r in results if r.ours is None]
    ratios = [ratio for r in results if (ratio := r.ratio()) is not None]
    if ratios:
        median = statistics.median(ratios)
        if median <= 1 or (full and median < LEAST_MEDIAN_RATIO):
            found.append(f"{kind}: median ratio {median:.2f}")
    return found


def missed(results: list[Result]) -> list[str]:
    """The bounds of single instances, and how many there must be."""
    found = []
    for r in results:
        where, ratio = f"{r.kind}, {r.name}", r.ratio()
        if r.kind not in (SYNTHETIC, CROWD) and ratio is not None and ratio <= 1:
            found.append(f"{where}: the fastest peer takes {ratio:.2f} times as long as ours")
        if r.our_seconds > SEARCH_BOUNDS.get(r.kind, float("inf")):
            found.append(f"{where}: the search takes {1e3 * r.our_seconds:.1f} ms")
        if r.kind == CROWD and r.our_seconds + (r.knowledge_seconds or 0.0) > CROWD_BOUND:
            found.append(f"{where}: knowledge and deadlock take more than {1e3 * CROWD_BOUND:g} ms")
    asked = sum(r.kind != CROWD for r in results)
    if asked < LEAST_INSTANCES:
        found.append(f"only {asked} instances")
    return found
