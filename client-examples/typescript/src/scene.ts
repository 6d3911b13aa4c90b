import { readFileSync } from "node:fs";

import type { Pose } from "./answer.js";
import { exit, Failure } from "./failure.js";
import { isFields, type Fields } from "./json.js";

// What the service takes where a scene says nothing, and the most that it gives unless configured otherwise.
const defaultTimeLimitMs = 1_000;
const longestTimeLimitMs = 60_000;

/**
 * The table as the client knows it, in the words of the request. Any JSON will do: what makes a scene is for the service
 * to say.
 */
export class Scene {
  private constructor(readonly document: unknown) {}

  static read(path: string): Scene {
    try {
      return new Scene(JSON.parse(readFileSync(path, "utf8")));
    } catch (error) {
      throw new Failure(exit.refused, `${path} can't be read: ${String(error)}`);
    }
  }

  get timeLimitMs(): number {
    const named = this.settings["time_limit_ms"];
    return typeof named === "number" ? Math.min(Math.max(named, 0), longestTimeLimitMs) : defaultTimeLimitMs;
  }

  /** The same scene with ten times the time to plan, as far as the service gives it. */
  withMoreTime(): Scene {
    const settings = { ...this.settings, time_limit_ms: Math.min(10 * this.timeLimitMs, longestTimeLimitMs) };
    return new Scene({ ...this.fields, settings });
  }

  /** The same scene with one object elsewhere. */
  with(object: string, to: Pose): Scene {
    const { x, y, yaw } = to;
    const pose = yaw === undefined ? { x, y } : { x, y, yaw };
    const moved = this.items("objects", object).map((each) =>
      isFields(each) && each["id"] === object ? { ...each, ...pose } : each,
    );
    return new Scene({ ...this.fields, objects: moved });
  }

  /**
   * The same scene with one object at a drop-off. One that is then full is left out, and what is away is no longer wanted
   * away.
   */
  without(object: string, dropOff: string): Scene {
    const objects = this.items("objects", object).filter((each) => !isFields(each) || each["id"] !== object);
    const dropOffs = this.items("drop_offs", dropOff).flatMap((each) => {
      const capacity = isFields(each) && each["id"] === dropOff ? each["capacity"] : undefined;
      if (!isFields(each) || typeof capacity !== "number") {
        return [each];
      }
      return capacity > 1 ? [{ ...each, capacity: capacity - 1 }] : [];
    });
    return new Scene({ ...this.fields, objects, drop_offs: dropOffs, ...this.goalWithout(object) });
  }

  /** The list of this name, which has an item with this id. */
  private items(name: string, id: string): readonly unknown[] {
    const items: unknown = this.fields[name];
    if (!Array.isArray(items) || !items.some((each) => isFields(each) && each["id"] === id)) {
      throw new Failure(exit.refused, `the plan names ${id}, which is not among the ${name} of the scene`);
    }
    return items;
  }

  private goalWithout(object: string): Fields {
    const goal = this.fields["goal"];
    const wanted = isFields(goal) ? goal["all_of"] : undefined;
    return Array.isArray(wanted) ? { goal: { all_of: wanted.filter((id) => id !== object) } } : {};
  }

  private get fields(): Fields {
    return isFields(this.document) ? this.document : {};
  }

  private get settings(): Fields {
    const settings = this.fields["settings"];
    return isFields(settings) ? settings : {};
  }
}
