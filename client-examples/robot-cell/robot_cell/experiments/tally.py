"""What many episodes come to."""

from collections import Counter
from typing import Any

from .interval import wilson

APART = ("deadlock", "no_space", "out_of_reach")
"""Ends that are no fault of the plan or of the robot, as long as nothing was hit or dropped before."""
REACHED = ("in_hand", "all_away", "cleared", "partly_cleared")
"""Ends at which all was carried out that a plan asks for."""
Episode = dict[str, Any]


def contacts(episode: Episode) -> list[dict[str, Any]]:
    return [contact for step in episode["steps"] for contact in step["contacts"]]


def is_press(contact: dict[str, Any]) -> bool:
    """A closing hand pulls its dish to where it was seen, against a near neighbour, and lifts it along that. No margin
    prevents that."""
    return bool(contact["part"] == "dish" and contact["phase"] in ("closing", "lifting"))


def is_hit(contact: dict[str, Any]) -> bool:
    """Harder than a touch, by hand, arm or the dish in the hand."""
    return not contact["touch"] and not is_press(contact)


def went_wrong(episode: Episode) -> bool:
    """Something was hit or dropped."""
    return any(step["dropped"] for step in episode["steps"]) or any(map(is_hit, contacts(episode)))


def is_judged(episode: Episode) -> bool:
    return episode["end"] not in APART or went_wrong(episode)


def is_success(episode: Episode) -> bool:
    """The target in the hand, or at the drop-offs what can go; nothing hit, nothing dropped."""
    return episode["end"] in REACHED and not went_wrong(episode)


def is_clean(episode: Episode) -> bool:
    """A success without any contact and without a dish that was disturbed."""
    disturbed = any(step["disturbed"] for step in episode["steps"])
    return is_success(episode) and not disturbed and not contacts(episode)


def tally(episodes: list[Episode]) -> dict[str, Any]:
    """Counts and rates. Rates are over the judged episodes: not over those that ended [`APART`] with nothing gone wrong."""
    ends = Counter(str(episode["end"]) for episode in episodes)
    judged = [episode for episode in episodes if is_judged(episode)]
    successes, clean = sum(map(is_success, judged)), sum(map(is_clean, judged))
    steps = [step for episode in episodes for step in episode["steps"]]
    places = sorted(step["place_error"] for step in steps if step["place_error"] is not None)
    return {
        "episodes": len(episodes),
        "ends": dict(sorted(ends.items())),
        "judged": len(judged),
        "success": successes,
        "harmed": sum(map(went_wrong, judged)),
        "success_interval": wilson(successes, len(judged)),
        "clean": clean,
        "clean_interval": wilson(clean, len(judged)),
        "pressed": sum(any(map(is_press, contacts(episode))) for episode in episodes),
        "relocations": len(places),
        "grasps": len(steps),
        "contacts": _by_kind(steps),
        "disturbances": sum(len(step["disturbed"]) for step in steps),
        "drops": sum(step["dropped"] for step in steps),
        "place_error_mean": sum(places) / len(places) if places else None,
        "place_error_max": places[-1] if places else None,
        "pictures": sum(episode["pictures"] for episode in episodes),
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
