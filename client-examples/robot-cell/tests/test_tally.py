"""What many episodes come to: no failure may get lost."""

from typing import Any

from robot_cell.experiments.interval import wilson
from robot_cell.experiments.tally import is_clean, is_judged, is_success, tally


def contact(phase: str, part: str, touch: bool) -> dict[str, Any]:
    return {"phase": phase, "part": part, "other": "plate", "depth": 1e-4, "force": 5.0, "touch": touch}


def step(*contacts: dict[str, Any], **more: Any) -> dict[str, Any]:
    done = {"object": "cup", "contacts": list(contacts), "disturbed": {}, "dropped": False, "place_error": 1e-4}
    return {**done, "seconds": 8.0, "failure": "", **more}


def episode(end: str, *steps: dict[str, Any]) -> dict[str, Any]:
    return {"end": end, "steps": list(steps), "plans": 2, "verifications": 1, "pictures": 3}


def test_a_hit_by_anything_in_the_hand_is_no_success() -> None:
    assert is_success(episode("in_hand", step())) and is_clean(episode("in_hand", step()))
    for part in ("finger", "palm", "arm", "dish"):
        assert not is_success(episode("in_hand", step(contact("carrying", part, touch=False)))), part
    assert not is_success(episode("in_hand", step(dropped=True)))
    assert not is_success(episode("lost", step()))


def test_a_goal_is_reached_with_a_target_in_the_hand_or_with_what_can_go_at_the_drop_offs() -> None:
    for end in ("in_hand", "all_away", "cleared", "partly_cleared"):
        assert is_success(episode(end, step())) and not is_success(episode(end, step(dropped=True)))


def test_a_touch_and_a_press_of_the_closing_hand_are_a_success_but_not_clean() -> None:
    for met in (contact("descent", "finger", touch=True), contact("closing", "dish", touch=False)):
        assert is_success(episode("in_hand", step(met))) and not is_clean(episode("in_hand", step(met)))
    assert not is_clean(episode("in_hand", step(disturbed={"plate": 0.002})))


def test_an_episode_is_left_out_only_if_nothing_went_wrong() -> None:
    for end in ("deadlock", "no_space", "out_of_reach"):
        assert not is_judged(episode(end, step()))
        assert is_judged(episode(end, step(contact("descent", "finger", touch=False))))
        assert is_judged(episode(end, step(dropped=True)))
    for end in ("timed_out", "no_path", "refused", "no_progress", "lost"):
        assert is_judged(episode(end))


def test_the_sums() -> None:
    met = contact("closing", "dish", touch=False)
    found = tally([episode("in_hand", step(met), step(place_error=None)), episode("deadlock"), episode("lost", step())])
    assert (found["episodes"], found["judged"], found["success"], found["clean"], found["harmed"]) == (3, 2, 1, 0, 0)
    assert (found["relocations"], found["grasps"], found["pressed"], found["pictures"]) == (2, 3, 1, 9)
    assert found["contacts"] == {"closing": {"dish hit": 1}} and found["ends"] == {
        "deadlock": 1,
        "in_hand": 1,
        "lost": 1,
    }


def test_intervals_are_those_of_wilson() -> None:
    low, high = wilson(40, 40)
    assert abs(low - 0.9124) < 1e-4 and high > 0.9999
    low, high = wilson(5, 10)
    assert abs(low - 0.2366) < 1e-4 and abs(high - 0.7634) < 1e-4
