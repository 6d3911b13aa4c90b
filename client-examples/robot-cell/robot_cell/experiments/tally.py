"""What many episodes come to."""

from collections import Counter
from typing import Any

from .interval import wilson

NO_PLAN = ("deadlock", "no_space", "timed_out")
APART = ("out_of_reach",)
Episode = dict[str, Any]


def contacts(episode: Episode) -> list[dict[str, Any]]:
    return [contact for step in episode["steps"] for contact in step["contacts"]]


def is_hit(contact: dict[str, Any]) -> bool:
    """Of the hand or the arm, and harder than a touch."""
    return contact["part"] != "dish" and not contact["touch"]


def is_success(episode: Episode) -> bool:
    """The target in the hand, nothing hit by it, nothing dropped."""
    dropped = any(step["dropped"] for step in episode["steps"])
    return episode["end"] == "in_hand" and not dropped and not any(map(is_hit, contacts(episode)))


def is_clean(episode: Episode) -> bool:
    """A success without any contact and without a dish that was disturbed."""
    disturbed = any(step["disturbed"] for step in episode["steps"])
    return is_success(episode) and not disturbed and not contacts(episode)


def tally(episodes: list[Episode]) -> dict[str, Any]:
    """Counts and rates. Rates are over the episodes that had a plan to the end and were in reach."""
    ends = Counter(str(episode["end"]) for episode in episodes)
    judged = [episode for episode in episodes if episode["end"] not in (*NO_PLAN, *APART)]
    successes, clean = sum(map(is_success, judged)), sum(map(is_clean, judged))
    steps = [step for episode in episodes for step in episode["steps"]]
    places = sorted(step["place_error"] for step in steps if step["place_error"] is not None)
    return {
        "episodes": len(episodes),
        "ends": dict(sorted(ends.items())),
        "judged": len(judged),
        "success": successes,
        "success_interval": wilson(successes, len(judged)),
        "clean": clean,
        "clean_interval": wilson(clean, len(judged)),
        "relocations": len(places),
        "grasps": len(steps),
        "contacts": _by_kind(steps),
        "disturbances": sum(len(step["disturbed"]) for step in steps),
        "greatest_disturbance": max((way for step in steps for way in step["disturbed"].values()), default=0.0),
        "drops": sum(step["dropped"] for step in steps),
        "place_error_mean": sum(places) / len(places) if places else None,
        "place_error_max": places[-1] if places else None,
        "plans": sum(episode["plans"] for episode in episodes),
        "verifications": sum(episode["verifications"] for episode in episodes),
    }


def _by_kind(steps: list[dict[str, Any]]) -> dict[str, dict[str, int]]:
    """Steps with a contact, by phase and by what met what: `descent` → `{"finger hit": 3}`."""
    kinds: dict[str, Counter[str]] = {}
    for step in steps:
        seen = {(c["phase"], f"{c['part']} {'touch' if c['touch'] else 'hit'}") for c in step["contacts"]}
        for phase, what in seen:
            kinds.setdefault(phase, Counter())[what] += 1
    return {phase: dict(sorted(of_phase.items())) for phase, of_phase in sorted(kinds.items())}
