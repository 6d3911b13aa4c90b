import { exit, Failure } from "./failure.js";
import { fields, list, number, text } from "./json.js";

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

/** What the service says about a scene. The word `verdict` tells which fields there are. */
export type Answer =
  /** The target can be grasped as the table stands. */
  | { readonly verdict: "graspable"; readonly target: string; readonly yaw: number }
  /** These relocations, of which there is at least one, free the target. */
  | { readonly verdict: "relocate"; readonly relocations: readonly [Relocation, ...Relocation[]] }
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
      return { verdict, target: text(answer["target"], "/target"), yaw: readYaw(answer["target_grasp"], "/target_grasp") };
    case "relocate": {
      const [first, ...later] = list(answer["relocations"], "/relocations").map((each, at) =>
        readRelocation(each, `/relocations/${at}`),
      );
      if (first === undefined) {
        throw new Failure(exit.refused, "the answer is not understood: relocate without a relocation");
      }
      return { verdict, relocations: [first, ...later] };
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
