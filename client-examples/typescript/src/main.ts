// A cell controller in small: asks for a plan, does its first step, and goes on with the plan as long as it holds, until the
// goal is reached.

import { isDone, rest, type Answer, type End, type Pose, type Step } from "./answer.js";
import { exit, Failure, type Exit } from "./failure.js";
import { Scene } from "./scene.js";
import { Service } from "./service.js";

// Each round moves one object; a table that needs more is not what this gripper is for.
const mostRounds = 100;
// How far beside its place an object may be seen, m: the errors of this cell's robot and camera.
const positionTolerance = 0.005;

/** Three decimals as C prints them: what lies half way between two goes to the even one, and nothing is -0.000. */
function decimals(value: number): string {
  const isHalfWay = Number.isInteger(16 * value) && Math.abs((1_000 * value) % 1) === 0.5;
  const words = (isHalfWay ? (2 * Math.round(500 * value)) / 1_000 : value).toFixed(3);
  return words === "-0.000" ? "0.000" : words;
}

/** The verdict alone where there are no ids. */
function withIds(verdict: string, ids: readonly string[], rest: string): string {
  return ids.length > 0 ? `${verdict}: ${ids.join(", ")} ${rest}` : verdict;
}

function at({ x, y, yaw }: Pose): string {
  const parts = yaw === undefined ? [x, y] : [x, y, yaw];
  return parts.map(decimals).join(" ");
}

/** Stands for the robot: a real one picks and places here, and its camera says where the object came to lie. */
function carryOut(scene: Scene, step: Step): Scene {
  const { object, from, grasp } = step;
  switch (step.action) {
    case "pick_place": {
      const { to, turn, release } = step;
      const moved = scene.with(object, to);
      const turned = turn === undefined ? "" : `, turned by ${decimals(turn)}`;
      const grips = `grasp at ${at(grasp)}, release at ${at(release)}`;
      console.log(`move ${object} from ${at(from)} to ${at(to)}${turned}, ${grips}`);
      return moved;
    }
    case "pick_drop": {
      const left = scene.without(object, step.dropOff);
      console.log(`take ${object} from ${at(from)} away to ${step.dropOff}, grasp at ${at(grasp)}`);
      return left;
    }
  }
}

function finish(end: End): Exit {
  switch (end.kind) {
    case "grasp":
      console.log(`grasp ${end.target} at ${at(end.grip)}`);
      return exit.reached;
    case "all_away":
      console.log("all taken away");
      return exit.reached;
    case "cleared":
      console.log("cleared");
      return exit.reached;
    case "partly_cleared":
      if (end.stuck.length > 0) {
        console.log(withIds("stuck", end.stuck, "hold each other"));
      }
      console.log(withIds("partly cleared", end.left, end.proven ? "left" : "left, as far as is known"));
      return exit.partlyCleared;
  }
}

/** What comes too late is asked for once more, with ten times the time. */
async function planned(service: Service, scene: Scene): Promise<Answer> {
  const answer = await service.plan(scene);
  return answer.verdict === "timed_out" ? service.plan(scene.withMoreTime()) : answer;
}

async function run(path: string): Promise<Exit> {
  const service = new Service(
    process.env["SINGULATE_URL"] ?? "http://127.0.0.1:8080",
    process.env["SINGULATE_KEY"] ?? "",
  );
  let scene = Scene.read(path);
  let answer = await planned(service, scene);
  for (let round = 0; round < mostRounds; round++) {
    switch (answer.verdict) {
      case "relocate":
      case "graspable":
      case "cleared":
      case "partly_cleared": {
        const [step] = answer.steps;
        if (step === undefined) {
          return finish(answer.end);
        }
        scene = carryOut(scene, step);
        const left = rest(answer);
        const replan = !isDone(left) && (await service.replan(scene, left, positionTolerance));
        answer = replan ? await planned(service, scene) : left;
        break;
      }
      case "deadlock":
        console.log(withIds("deadlock", answer.core, "hold each other"));
        return exit.deadlock;
      case "no_space":
        console.log(withIds("no space", answer.needed, "would have to go"));
        return exit.noSpace;
      case "timed_out":
        console.log(withIds("timed out", answer.needed, "would have to go"));
        return exit.timedOut;
      default:
        // Does not compile where a verdict is left out.
        answer satisfies never;
    }
  }
  throw new Failure(exit.refused, `gave up: the goal is not reached after ${mostRounds} moves`);
}

async function main(): Promise<Exit> {
  const [path, ...others] = process.argv.slice(2);
  if (path === undefined || others.length > 0) {
    console.error("usage: main.js SCENE.json");
    return exit.refused;
  }
  try {
    return await run(path);
  } catch (error) {
    console.error(error instanceof Error ? error.message : error);
    return error instanceof Failure ? error.exit : exit.refused;
  }
}

process.exitCode = await main();
