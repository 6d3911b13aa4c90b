"""The controller of a cell: look, ask, carry out one step, look again, until the goal is reached."""

from dataclasses import dataclass, field
from typing import Any

from ..physics.camera import Camera
from ..physics.cell import Cell, Outcome, Spot
from ..physics.world import Scene
from .service import DEFAULT_LIMIT_MS, LONGEST_LIMIT_MS, Body, Refused, Service

STEPS = 50
"""More steps than any of these plans has. A controller that needs more goes round in circles."""
PICTURES = 5
"""How often the camera looks again where its errors make a scene that the service refuses."""
ROUNDS_WITHOUT_PROGRESS = 3
WITHOUT_PLAN = {"deadlock", "no_space", "timed_out"}
WITH_PLAN = {"relocate", "graspable", "cleared", "partly_cleared"}
FAULTS = {
    "unknown_object",
    "fixed_object_moved",
    "target_moved",
    "number_out_of_range",
    "wrong_from",
    "off_table",
    "in_keep_out",
    "too_close",
    "wrong_gap",
    "grasp_blocked",
    "release_blocked",
    "target_blocked",
    "wrong_slack",
}
"""Warnings with which a plan must not be carried out. Only the paper's methods make such plans."""
WRONG_UNITS = {"out_of_proportion", "wide_yaw_tolerance"}
"""Warnings that a number of the scene is in another unit."""


@dataclass
class Episode:
    """How an episode ended: `in_hand`, `all_away`, `cleared`, `partly_cleared`, a verdict without a plan, `out_of_reach`, `no_path`, `refused`, `no_progress`,
    `lost` (something was dropped while the target was lifted)."""

    end: str = ""
    outcomes: list[Outcome] = field(default_factory=list)
    pictures: int = 0
    """Those of scenes that the service refused included."""
    plans: int = 0
    verifications: int = 0
    planning_seconds: float = 0.0
    """Of all calls, as the client waits for them."""
    service_seconds: float = 0.0
    """Of all plans, by the `statistics` of the answers."""
    faulty_plans: int = 0
    """Plans of the paper's methods in which the service's own checker finds a fault."""
    detail: str = ""

    def to_json(self) -> dict[str, object]:
        return {
            "end": self.end,
            "steps": [outcome.to_json() for outcome in self.outcomes],
            "pictures": self.pictures,
            "plans": self.plans,
            "verifications": self.verifications,
            "planning_s": self.planning_seconds,
            "service_s": self.service_seconds,
            "faulty_plans": self.faulty_plans,
            "detail": self.detail,
        }


class Controller:
    """`position_tolerance` (m) is how far two pictures of one dish may differ: with it the controller asks whether the
    plan that it has still holds, and plans anew only where it does not. Without it (None) it plans after every step.
    `trusting` carries out plans with known faults, which only the paper's methods make."""

    def __init__(
        self,
        service: Service,
        cell: Cell,
        camera: Camera,
        *,
        position_tolerance: float | None = None,
        trusting: bool = False,
    ) -> None:
        self._service, self._cell, self._camera = service, cell, camera
        self._tolerance, self._trusting = position_tolerance, trusting
        self._left: Body | None = None
        """What is left of the plan: the steps after the one that was carried out last."""

    def run(self) -> Episode:
        """Raises GaveUp without a service, and Refused where it asks for another key."""
        episode = Episode()
        plans, verifications, seconds = self._service.plans, self._service.verifications, self._service.seconds
        try:
            episode.end = self._follow(episode)
        except Refused as reason:
            if reason.status in (401, 403):
                raise
            episode.end, episode.detail = "refused", str(reason)
        episode.pictures = self._camera.pictures
        episode.plans = self._service.plans - plans
        episode.verifications = self._service.verifications - verifications
        episode.planning_seconds = self._service.seconds - seconds
        return episode

    def _follow(self, episode: Episode) -> str:
        costs: list[int] = []
        for _ in range(STEPS):
            scene, plan = self._next_plan(episode)
            verdict = plan["verdict"]
            if verdict in WITHOUT_PLAN:
                episode.detail = _reason(plan)
                return str(verdict)
            if verdict not in WITH_PLAN:
                raise Refused(200, {"title": f"unknown verdict '{verdict}'"})
            costs.append(len(plan["relocations"]))
            if _stuck(costs):
                return "no_progress"
            if not plan["relocations"]:
                return self._finish(episode, scene, plan)
            outcome = self._carry_out(scene, plan["relocations"][0])
            self._note(episode, outcome)
            if outcome.failure:
                return outcome.failure
            self._left = {**plan, "relocations": plan["relocations"][1:]}
        return "no_progress"

    def _finish(self, episode: Episode, scene: Scene, plan: Body) -> str:
        """The end of a plan without steps: the grasp, where a target is wanted."""
        if plan["target_grasp"]:
            outcome = self._cell.take(plan["target"], _seen(scene, plan["target"], plan["target_grasp"]["yaw"]))
            self._note(episode, outcome)
            return outcome.failure or ("lost" if outcome.dropped else "in_hand")
        if plan["verdict"] == "partly_cleared":
            episode.detail = _remains(plan)
        return str(plan["verdict"]) if plan["verdict"] in ("cleared", "partly_cleared") else "all_away"

    def _note(self, episode: Episode, outcome: Outcome) -> None:
        episode.outcomes.append(outcome)
        episode.detail = outcome.detail

    def _carry_out(self, scene: Scene, step: Body) -> Outcome:
        name, action = step["object"], step["action"]
        if action == "pick_place":
            release = Spot(step["to"]["x"], step["to"]["y"], step["release"]["yaw"])
            return self._cell.relocate(name, _seen(scene, name, step["grasp"]["yaw"]), release)
        if action == "pick_drop":
            if step["drop_off"] not in {drop_off["id"] for drop_off in scene["drop_offs"]}:
                raise Refused(200, {"title": f"unknown drop-off '{step['drop_off']}'"})
            return self._cell.take_away(name, _seen(scene, name, step["grasp"]["yaw"]), step["drop_off"])
        raise Refused(200, {"title": f"unknown action '{action}'"})

    def _next_plan(self, episode: Episode) -> tuple[Scene, Body]:
        scene = self._camera.look()
        if self._left is not None and _is_done(self._left):
            return scene, self._left
        if self._left is not None and self._tolerance is not None:
            try:
                answer = self._service.verify(scene, self._left, self._tolerance)
            except Refused as refused:
                if refused.status != 422:
                    raise
            else:
                if not answer["replan"]:
                    return scene, self._left
        scene, plan = self._plan(scene)
        episode.service_seconds += sum(plan.get("statistics", {}).values()) / 1000
        codes = {warning["code"] for warning in plan["warnings"] if not _is_of_drop_off(warning)}
        episode.faulty_plans += bool(codes & FAULTS)
        if bad := codes & (WRONG_UNITS if self._trusting else WRONG_UNITS | FAULTS):
            raise Refused(200, {"title": f"a plan with the warnings {sorted(bad)}"})
        return scene, plan

    def _plan(self, scene: Scene) -> tuple[Scene, Body]:
        for _ in range(PICTURES - 1):
            try:
                return scene, self._ask(scene)
            except Refused as refused:
                # Two centres that seem too near each other, or one beyond the edge: the next picture has other errors.
                if refused.status != 422:
                    raise
            scene = self._camera.look()
        return scene, self._ask(scene)

    def _ask(self, scene: Scene) -> Body:
        answer = self._service.plan(scene)
        if answer["verdict"] != "timed_out":
            return answer
        settings: dict[str, Any] = scene.get("settings") or {}
        longer = min(10 * (settings.get("time_limit_ms") or DEFAULT_LIMIT_MS), LONGEST_LIMIT_MS)
        return self._service.plan({**scene, "settings": {**settings, "time_limit_ms": longer}})


def _seen(scene: Scene, name: str, yaw: float) -> Spot:
    item = next(item for item in scene["objects"] if item["id"] == name)
    return Spot(item["x"], item["y"], yaw)


def _reason(plan: Body) -> str:
    if plan["deadlock"]:
        return f"{', '.join(plan['deadlock']['core'])} hold each other"
    return f"{', '.join(plan['needed'])} would have to go" if plan["needed"] else ""


def _is_of_drop_off(warning: Body) -> bool:
    """Such as that a drop-off accepts what was taken away before, whose code is also that of a fault of a plan."""
    return str(warning["pointer"]).startswith("/drop_offs")


def _remains(plan: Body) -> str:
    words = f"{', '.join(plan['left'])} left" + ("" if plan["proven"] else ", as far as is known")
    return words + (f"; {', '.join(plan['stuck']['core'])} hold each other" if plan["stuck"] else "")


def _is_done(plan: Body) -> bool:
    """Whether nothing is left to do. There is no asking either: the drop-offs may be full, and no wanted dish be left."""
    return not plan["relocations"] and not plan["target_grasp"]


def _stuck(costs: list[int]) -> bool:
    """Whether the cost has not fallen for some rounds."""
    last = costs[-ROUNDS_WITHOUT_PROGRESS - 1 :]
    return len(last) > ROUNDS_WITHOUT_PROGRESS and min(last[1:]) >= last[0]
