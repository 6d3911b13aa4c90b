// A cell controller in small: asks for a plan, does its first step, and asks again until the target can be grasped.

import type { Relocation } from "./answer.js";
import { exit, Failure, type Exit } from "./failure.js";
import { Scene } from "./scene.js";
import { Service } from "./service.js";

// Each round moves one object; a table that needs more is not what this gripper is for.
const mostRounds = 100;

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

/** Stands for the robot: a real one picks and places here, and its camera says where the object came to lie. */
function relocate(scene: Scene, { object, from, to, graspYaw, releaseYaw }: Relocation): Scene {
  const moved = scene.with(object, to);
  const way = `from ${decimals(from.x)} ${decimals(from.y)} to ${decimals(to.x)} ${decimals(to.y)}`;
  console.log(`move ${object} ${way}, grasp at ${decimals(graspYaw)}, release at ${decimals(releaseYaw)}`);
  return moved;
}

async function run(path: string): Promise<Exit> {
  const service = new Service(
    process.env["SINGULATE_URL"] ?? "http://127.0.0.1:8080",
    process.env["SINGULATE_KEY"] ?? "",
  );
  let scene = Scene.read(path);
  for (let round = 0; round < mostRounds; round++) {
    let answer = await service.plan(scene);
    if (answer.verdict === "timed_out") {
      answer = await service.plan(scene.withMoreTime());
    }
    switch (answer.verdict) {
      case "relocate":
        scene = relocate(scene, answer.relocations[0]);
        break;
      case "graspable":
        console.log(`grasp ${answer.target} at ${decimals(answer.yaw)}`);
        return exit.graspable;
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
  throw new Failure(exit.refused, `gave up: not graspable after ${mostRounds} moves`);
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
