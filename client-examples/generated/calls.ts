// Calls every operation of the interface document with the client that hey-api generates from it, with its validators on.

import assert from "node:assert/strict";
import { randomUUID } from "node:crypto";
import { readFileSync } from "node:fs";
import { isDeepStrictEqual } from "node:util";

import { client } from "./client/client.gen.ts";
import * as api from "./client/index.ts";
import type { AnswerBody, JobBody, PlanBody, Problem } from "./client/index.ts";
import { zJobSceneBody, zSceneBody, zVerifyBody } from "./client/zod.gen.ts";

/** Long enough for any machine; the jobs here take a millisecond. */
const WAIT_MS = 30_000;

interface Outcome<T> {
  data?: T | undefined;
  error?: unknown;
  response?: Response | undefined;
}

interface Described {
  paths: Record<string, Record<string, { operationId: string }>>;
}

/** The typed body, if it came with this status. */
function parsed<T>(outcome: Outcome<T>, status = 200): T {
  assert.equal(outcome.response?.status, status, JSON.stringify(outcome.error));
  assert(outcome.data !== undefined, String(outcome.error));
  return outcome.data;
}

/** The problem, if the call was refused with this status. */
function refused(outcome: Outcome<unknown>, status: number): Problem {
  assert.equal(outcome.response?.status, status);
  const problem = outcome.error as Problem;
  assert.equal(problem.status, status);
  return problem;
}

async function probe(document: Described): Promise<void> {
  assert.equal(parsed(await api.livez()).status, "ok");
  assert.equal(parsed(await api.readyz()).status, "ok");
  assert.equal(parsed(await api.version()).name, "singulate");
  const served = parsed(await api.openapi());
  assert(isDeepStrictEqual(served, document), "the service is of another version than the document");
  // OpenMetrics is none of the texts that the generator knows: without `parseAs` it is a Blob.
  const text = parsed(await api.metrics({ parseAs: "text" }));
  assert(text.includes("singulate_http_request_seconds") && text.endsWith("# EOF\n"), text);
}

async function ask(scene: unknown, faulty: unknown): Promise<AnswerBody> {
  // What the validator gives back is sent: were a number a bigint to it, the service would get a string.
  const body = zSceneBody.parse(scene);
  const answer = parsed(await api.plan({ body }));
  assert.equal(answer.verdict, "relocate");
  assert.equal(answer.relocations.length, 1);
  // By its type too an answer is a plan to verify.
  const plan: PlanBody = answer;
  assert(parsed(await api.verify({ body: { scene: body, plan } })).valid);
  assert(parsed(await api.verify({ body: zVerifyBody.parse({ scene, plan }) })).valid);
  const movable = body.objects.filter((object) => object.fixed !== true);
  assert.equal(parsed(await api.survey({ body })).objects.length, movable.length);
  assert.equal(parsed(await api.knowledge({ body })).objects.length, body.objects.length);
  // The validator would keep a faulty scene here: to see what the service says of it, it is left out.
  const unchecked = { body: faulty as typeof body, requestValidator: undefined };
  const codes = refused(await api.plan(unchecked), 422).errors.map((item) => item.code);
  assert(codes.includes("duplicate_id") && codes.includes("unknown_target"), codes.join());
  // The generator types the first media type only: a drawing is asked for by hand.
  const drawing: unknown = parsed(await api.plan({ body, headers: { Accept: "image/svg+xml" }, parseAs: "text" }));
  assert(typeof drawing === "string" && drawing.startsWith("<svg"));
  return answer;
}

/** A goal, drop-offs and a hand's greatest opening, and all that an answer says of a clearing. */
async function clear(scene: unknown): Promise<void> {
  const body = zSceneBody.parse(scene);
  const answer = parsed(await api.plan({ body }));
  assert.equal(answer.verdict, "partly_cleared");
  assert.deepEqual([answer.proven, answer.target, answer.target_grasp], [true, null, null]);
  const dropOffs = answer.relocations.map((step) => (step.action === "pick_drop" ? step.drop_off : undefined));
  assert.deepEqual(new Set(dropOffs), new Set(["tray", "bin"]));
  assert.deepEqual(answer.left, answer.stuck?.core);
  assert(parsed(await api.verify({ body: { scene: body, plan: answer } })).valid);
}

/** Shapes, heights and a palm, and where the gripper and a box stand at each end of a step. */
async function turn(scene: unknown): Promise<void> {
  const body = zSceneBody.parse(scene);
  assert(body.objects.some((object) => object.shape?.kind === "rectangle"));
  const answer = parsed(await api.plan({ body }));
  assert(answer.warnings.some((warning) => warning.code === "default_grasps"));
  const [step, ...others] = answer.relocations;
  assert(step?.action === "pick_place" && others.length === 0 && step.turn !== undefined && answer.target_grasp);
  const { to, grasp } = step;
  const objects = body.objects.map((object) => (object.id === step.object ? { ...object, ...to } : object));
  const box = body.objects.find((object) => object.id === step.object);
  assert.deepEqual([grasp.x, grasp.y], [box?.x, box?.y], "a box is held over its middle");
  assert(to.yaw !== undefined && step.from.yaw !== undefined);
  const plan: PlanBody = { ...answer, relocations: [] };
  const moved = { ...body, objects };
  assert.equal(parsed(await api.verify({ body: { scene: moved, plan, partial: true } })).replan, false);
  const known = parsed(await api.knowledge({ body })).objects;
  assert(known.some((object) => (object.grasps ?? []).length > 0));
}

async function handIn(scene: unknown): Promise<JobBody> {
  const body = zJobSceneBody.parse(scene);
  const headers = { "Idempotency-Key": randomUUID() };
  const { id } = parsed(await api.submitJob({ body, headers }), 202);
  assert.equal(parsed(await api.submitJob({ body, headers }), 202).id, id, "one key, one job");
  const path = { id };
  const ended = parsed(await api.showJob({ path, query: { wait_ms: WAIT_MS } }));
  assert.equal(ended.state, "succeeded");
  assert.equal(ended.result?.verdict, "relocate");
  const events = await api.jobEvents({ path, sseMaxRetryAttempts: 1 });
  const states: string[] = [];
  for await (const job of events.stream) {
    assert(job);
    states.push(job.state);
  }
  assert.deepEqual([states.at(0), states.at(-1)], ["queued", "succeeded"]);
  const listed = parsed(await api.listJobs({ query: { state: "succeeded", limit: 100 } }));
  assert(listed.jobs.some((job) => job.id === id));
  assert(refused(await api.cancelJob({ path }), 409).type.endsWith(":job_finished"));
  parsed(await api.forgetJob({ path }), 204);
  refused(await api.showJob({ path }), 404);
  for (const job of parsed(await api.submitJobs({ body: { scenes: [body, body] } }), 202).jobs) {
    const path = { id: job.id };
    parsed(await api.showJob({ path, query: { wait_ms: WAIT_MS } }));
    parsed(await api.forgetJob({ path }), 204);
  }
  return ended;
}

/** A verdict or an action that the client does not know is an error, not an answer: the validator sees to it. */
async function refuseUnknown(scene: unknown, answer: AnswerBody, job: JobBody): Promise<void> {
  const served = (body: unknown) => async () => Response.json(body);
  const pushed = answer.relocations.map((step) => ({ ...step, action: "push" }));
  for (const [part, value] of [["verdict", "perhaps"], ["relocations", pushed]] as const) {
    const unknown = { ...answer, [part]: value };
    const planned = await api.plan({ body: zSceneBody.parse(scene), fetch: served(unknown) });
    const shown = await api.showJob({ path: { id: job.id }, fetch: served({ ...job, result: unknown }) });
    for (const outcome of [planned, shown]) {
      assert(outcome.data === undefined && String(outcome.error).includes(part), String(outcome.error));
    }
  }
}

async function main(documentPath: string, scenes: string): Promise<void> {
  const read = (path: string): unknown => JSON.parse(readFileSync(path, "utf8"));
  const document = read(documentPath) as Described;
  const missed = new Map<string, RegExp>();
  for (const [path, operations] of Object.entries(document.paths)) {
    for (const [method, operation] of Object.entries(operations)) {
      const template = path.replaceAll(/\{[^}]*\}/g, "[^/]+");
      missed.set(operation.operationId, new RegExp(`^${method.toUpperCase()} ${template}$`));
    }
  }
  const count = missed.size;
  client.setConfig({ baseUrl: process.env["SINGULATE_URL"] ?? "", auth: process.env["SINGULATE_KEY"] ?? "" });
  client.interceptors.request.use((request) => {
    const called = `${request.method} ${new URL(request.url).pathname}`;
    for (const [name, pattern] of missed) if (pattern.test(called)) missed.delete(name);
    return request;
  });
  const scene = { ...(read(`${scenes}/one-move.json`) as object), settings: { time_limit_ms: 1000 } };
  const { colour: _, ...faulty } = read(`${scenes}/invalid.json`) as { colour: unknown };
  await probe(document);
  await clear(read(`${scenes}/clear-table.json`));
  await turn(read(`${scenes}/tote.json`));
  const answer = await ask(scene, faulty);
  await refuseUnknown(scene, answer, await handIn(scene));
  assert.deepEqual([...missed.keys()], [], "operations that are never called");
  console.log(`generated, TypeScript: ${count} operations called`);
}

const [documentPath = "", scenes = ""] = process.argv.slice(2);
await main(documentPath, scenes);
