import { exit, Failure } from "./failure.js";
import { boolean, fields, list, number, text, type Fields } from "./json.js";

/** Of an object: its own frame, or the centre of a disc, whose yaw is undefined if it may be grasped at every yaw. */
export interface Pose {
  readonly x: number;
  readonly y: number;
  readonly yaw: number | undefined;
}

/** Of the gripper: its axis, and the direction of finger 0. */
export interface Grip extends Pose {
  readonly yaw: number;
}

/** To another place on the table. */
export interface Relocation {
  readonly action: "pick_place";
  readonly object: string;
  readonly from: Pose;
  readonly to: Pose;
  readonly grasp: Grip;
  readonly release: Grip;
  /** How far the object turns on the way, if that is said, rad. */
  readonly turn: number | undefined;
}

/** Away from the table. */
export interface Removal {
  readonly action: "pick_drop";
  readonly object: string;
  readonly from: Pose;
  readonly grasp: Grip;
  readonly dropOff: string;
}

export type Step = Relocation | Removal;

/** What comes of the steps of a plan. */
export type End =
  /** The target can be grasped. */
  | { readonly kind: "grasp"; readonly target: string; readonly grip: Grip }
  /** All that is wanted away is away. */
  | { readonly kind: "all_away" }
  | { readonly kind: "cleared" }
  /** The objects of `stuck` lock themselves. Unless it is proven, more could perhaps be taken away. */
  | {
      readonly kind: "partly_cleared";
      readonly left: readonly string[];
      readonly stuck: readonly string[];
      readonly proven: boolean;
    };

/** What is left to do: the steps, then what comes of them. */
export interface Plan {
  readonly verdict: "graspable" | "relocate" | "cleared" | "partly_cleared";
  readonly steps: readonly Step[];
  readonly end: End;
  /** The same as the service has put it. */
  readonly body: Fields;
}

/** What the service says about a scene. The word `verdict` tells which fields there are. */
export type Answer =
  | Plan
  /** Nothing ever reaches the goal: the objects of the core hold each other. */
  | { readonly verdict: "deadlock"; readonly core: readonly string[] }
  /** The needed objects would have to go, but no places for them were found. */
  | { readonly verdict: "no_space"; readonly needed: readonly string[] }
  /** As far as is known the needed objects would have to go; time ran out. */
  | { readonly verdict: "timed_out"; readonly needed: readonly string[] };

/** What stands only where it says something. */
function readAngle(value: unknown, place: string): number | undefined {
  return value === undefined ? undefined : number(value, place);
}

function readPose(value: unknown, place: string): Pose {
  const { x, y, yaw } = fields(value, place);
  return { x: number(x, `${place}/x`), y: number(y, `${place}/y`), yaw: readAngle(yaw, `${place}/yaw`) };
}

function readGrip(value: unknown, place: string): Grip {
  const pose = readPose(value, place);
  return { ...pose, yaw: number(pose.yaw, `${place}/yaw`) };
}

function readIds(value: unknown, place: string): string[] {
  return list(value, place).map((id, at) => text(id, `${place}/${at}`));
}

/** Ids; none where there is null. */
function readKnown(value: unknown, place: string): string[] {
  return value === null ? [] : readIds(value, place);
}

/** The core of a lock; no ids where there is none. */
function readCore(value: unknown, place: string): string[] {
  return value === null ? [] : readIds(fields(value, place)["core"], `${place}/core`);
}

function readStep(value: unknown, place: string): Step {
  const step = fields(value, place);
  const action = text(step["action"], `${place}/action`);
  const pick = {
    object: text(step["object"], `${place}/object`),
    from: readPose(step["from"], `${place}/from`),
    grasp: readGrip(step["grasp"], `${place}/grasp`),
  };
  switch (action) {
    case "pick_place":
      return {
        action,
        ...pick,
        to: readPose(step["to"], `${place}/to`),
        release: readGrip(step["release"], `${place}/release`),
        turn: readAngle(step["turn"], `${place}/turn`),
      };
    case "pick_drop":
      return { action, ...pick, dropOff: text(step["drop_off"], `${place}/drop_off`) };
    default:
      throw new Failure(exit.refused, `unknown action: ${action}`);
  }
}

/** Without a target, objects are taken away and none is grasped in the end. */
function readEnd(answer: Fields): End {
  if (answer["target"] === null && answer["target_grasp"] === null) {
    return { kind: "all_away" };
  }
  const grip = readGrip(answer["target_grasp"], "/target_grasp");
  return { kind: "grasp", target: text(answer["target"], "/target"), grip };
}

function readRemains(answer: Fields): End {
  const [left, stuck] = [readIds(answer["left"], "/left"), readCore(answer["stuck"], "/stuck")];
  return { kind: "partly_cleared", left, stuck, proven: boolean(answer["proven"], "/proven") };
}

function readPlan(verdict: Plan["verdict"], end: End, answer: Fields): Plan {
  const steps = list(answer["relocations"], "/relocations").map((each, at) => readStep(each, `/relocations/${at}`));
  return { verdict, steps, end, body: answer };
}

/** Refuses what it does not understand, above all verdicts and actions of later versions. */
export function readAnswer(value: unknown): Answer {
  const answer = fields(value, "the body");
  const verdict = text(answer["verdict"], "/verdict");
  switch (verdict) {
    case "graspable":
    case "relocate": {
      const plan = readPlan(verdict, readEnd(answer), answer);
      const count = plan.steps.length;
      if (count > 0 !== (verdict === "relocate")) {
        throw new Failure(exit.refused, `the answer is not understood: ${verdict} with ${count} relocations`);
      }
      return plan;
    }
    case "cleared":
      return readPlan(verdict, { kind: "cleared" }, answer);
    case "partly_cleared":
      return readPlan(verdict, readRemains(answer), answer);
    case "deadlock":
      return { verdict, core: readCore(answer["deadlock"], "/deadlock") };
    case "no_space":
    case "timed_out":
      return { verdict, needed: readKnown(answer["needed"], "/needed") };
    default:
      throw new Failure(exit.refused, `unknown verdict: ${verdict}`);
  }
}

/** What is left of a plan after its first step. */
export function rest(plan: Plan): Plan {
  const relocations = list(plan.body["relocations"], "/relocations").slice(1);
  return { ...plan, steps: plan.steps.slice(1), body: { ...plan.body, relocations } };
}

/** Whether the robot has nothing left to do. */
export function isDone(plan: Plan): boolean {
  return plan.steps.length === 0 && plan.end.kind !== "grasp";
}

/** Whether a verification asks for a new plan. */
export function readReplan(value: unknown): boolean {
  return boolean(fields(value, "the body")["replan"], "/replan");
}
