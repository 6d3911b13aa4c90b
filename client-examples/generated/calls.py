"""Calls every operation of the interface document with the client that is generated from it."""

import json
import os
import re
import sys
import uuid
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import httpx
from singulate_client import AuthenticatedClient
from singulate_client.api.jobs import (
    cancel_job,
    forget_job,
    job_events,
    list_jobs,
    show_job,
    submit_job,
    submit_jobs,
)
from singulate_client.api.operation import livez, metrics, openapi, readyz, version
from singulate_client.api.planning import knowledge, plan, survey, verify
from singulate_client.models import (
    AnyObject,
    AnswerBody,
    BatchBody,
    DeadlockBody,
    JobBody,
    JobListBody,
    JobSceneBody,
    JobsBody,
    JobStateWord,
    KnowledgeBody,
    PickDropBody,
    PickDropWord,
    PickPlaceBody,
    PlanBody,
    ProbeBody,
    Problem,
    RectangleShape,
    SceneBody,
    SurveyBody,
    VerdictWord,
    VerificationBody,
    VerifyBody,
    VersionBody,
)
from singulate_client.types import Response

T = TypeVar("T")
WAIT_MS = 30_000
"""Long enough for any machine; the jobs here take a millisecond."""


def operations(document: dict[str, Any]) -> dict[str, Callable[[str, str], bool]]:
    """By the operations' ids: whether a method and a path are this operation."""

    def matcher(method: str, template: str) -> Callable[[str, str], bool]:
        path = re.compile(re.sub(r"\{[^}]*\}", "[^/]+", template))
        return lambda seen, at: seen == method.upper() and path.fullmatch(at) is not None

    return {
        operation["operationId"]: matcher(method, template)
        for template, item in document["paths"].items()
        for method, operation in item.items()
    }


def parsed(response: Response[Any], kind: type[T], status: int = 200) -> T:
    """The typed body, if it came with this status."""
    assert response.status_code == status, f"{response.status_code}: {response.content!r}"
    assert isinstance(response.parsed, kind), f"{type(response.parsed)} is no {kind}"
    return response.parsed


def probe(client: AuthenticatedClient, document: dict[str, Any]) -> None:
    assert parsed(livez.sync_detailed(client=client), ProbeBody).status == "ok"
    assert parsed(readyz.sync_detailed(client=client), ProbeBody).status == "ok"
    assert parsed(version.sync_detailed(client=client), VersionBody).name == "singulate"
    served = parsed(openapi.sync_detailed(client=client), AnyObject)
    assert served.to_dict() == document, "the service is of another version than the document"
    # OpenMetrics is text that the generator has no type for.
    text = metrics.sync_detailed(client=client).content.decode()
    assert "singulate_http_request_seconds" in text and text.endswith("# EOF\n"), text


def ask(client: AuthenticatedClient, scene: dict[str, Any], faulty: dict[str, Any]) -> AnswerBody:
    body = SceneBody.from_dict(scene)
    answer = parsed(plan.sync_detailed(client=client, body=body), AnswerBody)
    assert answer.verdict is VerdictWord.RELOCATE and answer.cost == len(answer.relocations) == 1
    stated = VerifyBody(scene=body, plan=PlanBody.from_dict(answer.to_dict()))
    assert parsed(verify.sync_detailed(client=client, body=stated), VerificationBody).valid
    count = len(body.objects)
    movable = [item for item in body.objects if not item.fixed]
    assert len(parsed(survey.sync_detailed(client=client, body=body), SurveyBody).objects) == len(movable)
    assert len(parsed(knowledge.sync_detailed(client=client, body=body), KnowledgeBody).objects) <= count
    problem = parsed(plan.sync_detailed(client=client, body=SceneBody.from_dict(faulty)), Problem, 422)
    assert {item.code for item in problem.errors} >= {"duplicate_id", "unknown_target"}
    return answer


def clear(client: AuthenticatedClient, scene: dict[str, Any]) -> None:
    """A goal, drop-offs and a hand's greatest opening, and all that an answer says of a clearing."""
    body = SceneBody.from_dict(scene)
    answer = parsed(plan.sync_detailed(client=client, body=body), AnswerBody)
    assert answer.verdict is VerdictWord.PARTLY_CLEARED and answer.proven is True
    assert answer.target is None and answer.target_grasp is None
    steps = [step for step in answer.relocations if isinstance(step, PickDropBody)]
    assert len(steps) == len(answer.relocations) > 0 and steps[0].action is PickDropWord.PICK_DROP
    assert {step.drop_off for step in steps} == {"tray", "bin"}
    assert isinstance(answer.stuck, DeadlockBody) and answer.left == answer.stuck.core
    stated = VerifyBody(scene=body, plan=PlanBody.from_dict(answer.to_dict()))
    assert parsed(verify.sync_detailed(client=client, body=stated), VerificationBody).valid


def turn(client: AuthenticatedClient, scene: dict[str, Any]) -> None:
    """Shapes, heights and a palm, and where the gripper and a box stand at each end of a step."""
    body = SceneBody.from_dict(scene)
    assert any(isinstance(item.shape, RectangleShape) for item in body.objects)
    answer = parsed(plan.sync_detailed(client=client, body=body), AnswerBody)
    assert "default_grasps" in {warning.code for warning in answer.warnings}
    assert answer.target_grasp is not None
    (step,) = answer.relocations
    assert isinstance(step, PickPlaceBody) and isinstance(step.turn, float)
    assert isinstance(step.from_.yaw, float) and isinstance(step.to.yaw, float)
    box = next(item for item in body.objects if item.id == step.object_)
    assert (step.grasp.x, step.grasp.y) == (box.x, box.y), "a box is held over its middle"
    box.x, box.y, box.yaw = step.to.x, step.to.y, step.to.yaw
    left = PlanBody.from_dict({**answer.to_dict(), "relocations": []})
    rest = VerifyBody(scene=body, plan=left, partial=True)
    assert parsed(verify.sync_detailed(client=client, body=rest), VerificationBody).replan is False
    known = parsed(knowledge.sync_detailed(client=client, body=body), KnowledgeBody).objects
    assert any(item.grasps for item in known)


def hand_in(client: AuthenticatedClient, scene: dict[str, Any]) -> JobBody:
    body = JobSceneBody.from_dict(scene)
    key = str(uuid.uuid4())
    job = parsed(submit_job.sync_detailed(client=client, body=body, idempotency_key=key), JobBody, 202)
    again = parsed(submit_job.sync_detailed(client=client, body=body, idempotency_key=key), JobBody, 202)
    assert again.id == job.id, "one key, one job"
    ended = parsed(show_job.sync_detailed(job.id, client=client, wait_ms=WAIT_MS), JobBody)
    assert ended.state is JobStateWord.SUCCEEDED and isinstance(ended.result, AnswerBody)
    assert events(client, job.id)[-1] == "finished"
    listed = parsed(list_jobs.sync_detailed(client=client, state=JobStateWord.SUCCEEDED, limit=100), JobListBody)
    assert job.id in {item.id for item in listed.jobs}
    problem = parsed(cancel_job.sync_detailed(job.id, client=client), Problem, 409)
    assert problem.type_.value.endswith(":job_finished")
    assert forget_job.sync_detailed(job.id, client=client).status_code == 204
    parsed(show_job.sync_detailed(job.id, client=client), Problem, 404)
    batch = parsed(submit_jobs.sync_detailed(client=client, body=BatchBody(scenes=[body, body])), JobsBody, 202)
    for member in batch.jobs:
        parsed(show_job.sync_detailed(member.id, client=client, wait_ms=WAIT_MS), JobBody)
        assert forget_job.sync_detailed(member.id, client=client).status_code == 204
    return ended


def events(client: AuthenticatedClient, job: str) -> list[str]:
    """The generator takes a stream for one job: its client lends its connection, and the lines are read here."""
    url = f"/v1/jobs/{job}/events"
    with client.get_httpx_client().stream("GET", url) as response:
        response.raise_for_status()
        names = [line.removeprefix("event:").strip() for line in response.iter_lines() if line.startswith("event:")]
    # It can be called for what it does type: a job that is not there.
    parsed(job_events.sync_detailed(str(uuid.uuid4()), client=client), Problem, 404)
    return names


def refuse_unknown(scene: dict[str, Any], answer: AnswerBody, job: JobBody) -> None:
    """A verdict or an action that the client does not know is an error in an answer; a job holds it, but not as an
    AnswerBody."""
    known = answer.to_dict()
    pushed = [{**step, "action": "push"} for step in known["relocations"]]
    for unknown in (known | {"verdict": "perhaps"}, known | {"relocations": pushed}):
        served = {"/v1/plans": unknown, f"/v1/jobs/{job.id}": job.to_dict() | {"result": unknown}}
        transport = httpx.MockTransport(
            lambda request, served=served: httpx.Response(200, json=served[request.url.path])
        )
        client = AuthenticatedClient("http://service", "", httpx_args={"transport": transport})
        try:
            plan.sync_detailed(client=client, body=SceneBody.from_dict(scene))
        except (ValueError, KeyError):
            pass
        else:
            raise AssertionError("what it does not know is no error")
        result: object = parsed(show_job.sync_detailed(job.id, client=client), JobBody).result
        assert not isinstance(result, AnswerBody) and result == unknown


def main(document_path: str, scenes: str) -> None:
    document = json.loads(Path(document_path).read_text())
    known = operations(document)
    called: set[str] = set()

    def note(request: httpx.Request) -> None:
        called.update(name for name, is_it in known.items() if is_it(request.method, request.url.path))

    client = AuthenticatedClient(
        base_url=os.environ["SINGULATE_URL"],
        token=os.environ["SINGULATE_KEY"],
        httpx_args={"event_hooks": {"request": [note]}},
    )
    with client:
        probe(client, document)
        names = ("one-move", "invalid", "clear-table", "tote")
        scene, faulty, full, boxes = (json.loads(Path(scenes, f"{name}.json").read_text()) for name in names)
        del faulty["colour"]
        clear(client, full)
        turn(client, boxes)
        refuse_unknown(scene, ask(client, scene, faulty), hand_in(client, scene))
    missed = sorted(known.keys() - called)
    assert not missed, f"operations that are never called: {missed}"
    print(f"generated, Python: {len(called)} operations called")


if __name__ == "__main__":
    main(*sys.argv[1:])
