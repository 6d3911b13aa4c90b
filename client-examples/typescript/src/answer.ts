import { exit, Failure } from "./failure.js";
import { boolean, fields, list, number, text, type Fields } from "./json.js";

export interface Point {
  readonly x: number;
  readonly y: number;
}

export interface Relocation {
  readonly action: "pick_place";
  readonly object: string;
  readonly from: Point;
  readonly to: Point;
  readonly graspYaw: number;
  readonly releaseYaw: number;
}

/** What is left to do: the steps, then the grasp of the target. */
export interface Plan {
  readonly verdict: "graspable" | "relocate";
  readonly steps: readonly Relocation[];
  readonly target: string;
  readonly yaw: number;
  /** The same as the service has put it. */
  readonly body: Fields;
}

/** What the service says about a scene. The word `verdict` tells which fields there are. */
export type Answer =
  | Plan
  /** Nothing ever frees the target: the objects of the core hold each other. */
  | { readonly verdict: "deadlock"; readonly core: readonly string[] }
  /** The needed objects would have to go, but no places for them were found. */
  | { readonly verdict: "no_space"; readonly needed: readonly string[] }
  /** As far as is known the needed objects would have to go; time ran out. */
  | { readonly verdict: "timed_out"; readonly needed: readonly string[] };

function readPoint(value: unknown, place: string): Point {
  const point = fields(value, place);
  return { x: number(point["x"], `${place}/x`), y: number(point["y"], `${place}/y`) };
}

function readYaw(value: unknown, place: string): number {
  return number(fields(value, place)["yaw"], `${place}/yaw`);
}

/** Ids; none where there is null. */
function readIds(value: unknown, place: string): string[] {
  return value === null ? [] : list(value, place).map((id, at) => text(id, `${place}/${at}`));
}

function readRelocation(value: unknown, place: string): Relocation {
  const relocation = fields(value, place);
  const action = text(relocation["action"], `${place}/action`);
  if (action !== "pick_place") {
    throw new Failure(exit.refused, `unknown action: ${action}`);
  }
  return {
    action,
    object: text(relocation["object"], `${place}/object`),
    from: readPoint(relocation["from"], `${place}/from`),
    to: readPoint(relocation["to"], `${place}/to`),
    graspYaw: readYaw(relocation["grasp"], `${place}/grasp`),
    releaseYaw: readYaw(relocation["release"], `${place}/release`),
  };
}

/** Refuses what it does not understand, above all verdicts and actions of later versions. */
export function readAnswer(value: unknown): Answer {
  const answer = fields(value, "the body");
  const verdict = text(answer["verdict"], "/verdict");
  switch (verdict) {
    case "graspable":
    case "relocate": {
      const steps = list(answer["relocations"], "/relocations").map((each, at) =>
        readRelocation(each, `/relocations/${at}`),
      );
      if (steps.length > 0 !== (verdict === "relocate")) {
        throw new Failure(exit.refused, `the answer is not understood: ${verdict} with ${steps.length} relocations`);
      }
      const yaw = readYaw(answer["target_grasp"], "/target_grasp");
      return { verdict, steps, target: text(answer["target"], "/target"), yaw, body: answer };
    }
    case "deadlock": {
      const deadlock = answer["deadlock"];
      return { verdict, core: deadlock === null ? [] : readIds(fields(deadlock, "/deadlock")["core"], "/deadlock/core") };
    }
    case "no_space":
    case "timed_out":
      return { verdict, needed: readIds(answer["needed"], "/needed") };
    default:
      throw new Failure(exit.refused, `unknown verdict: ${verdict}`);
  }
}

/** What is left of a plan after its first step. */
export function rest(plan: Plan): Plan {
  const relocations = list(plan.body["relocations"], "/relocations").slice(1);
  return { ...plan, steps: plan.steps.slice(1), body: { ...plan.body, relocations } };
}

/** Whether a verification asks for a new plan. */
export function readReplan(value: unknown): boolean {
  return boolean(fields(value, "the body")["replan"], "/replan");
}
