import { setTimeout as sleep } from "node:timers/promises";

import { readAnswer, readReplan, type Answer, type Plan } from "./answer.js";
import { exit, Failure } from "./failure.js";
import { isFields } from "./json.js";
import type { Scene } from "./scene.js";

// After a lost connection; neither question changes anything, so to ask again is safe. One pause less than there are tries.
const pausesMs = [200, 400, 800, 1_600];
// A service that wants more patience than this is down, as far as a robot is concerned.
const longestWaitSeconds = 60;
// For the way there and back, on top of the time to plan.
const transferMs = 5_000;

/** No answer this time, but perhaps the next. Where the service names no wait, the next pause counts. */
interface Again {
  readonly reason: string;
  readonly waitMs?: number;
}

type Outcome = { readonly answer: unknown } | { readonly again: Again };

/** Nothing where it is not JSON. */
function parse(body: string): unknown {
  try {
    return JSON.parse(body);
  } catch {
    return undefined;
  }
}

/** What a problem document calls itself; something between client and service may answer without one. */
function title(problem: unknown, status: number): string {
  const words = isFields(problem) ? problem["title"] : undefined;
  return typeof words === "string" ? words : `HTTP ${status}`;
}

/** Every fault of the scene on a line of its own. */
function faults(problem: unknown): string {
  const errors: unknown = isFields(problem) ? problem["errors"] : undefined;
  const lines = Array.isArray(errors)
    ? errors.filter(isFields).map((fault) => `${fault["code"]} ${fault["pointer"]}: ${fault["detail"]}`)
    : [];
  return lines.length > 0 ? lines.join("\n") : title(problem, 422);
}

/** Seconds, or a second where the header is absent or a date. */
function retryAfterMs(header: string | null): number {
  const seconds = header !== null && /^\d+$/.test(header) ? Number(header) : 1;
  return 1_000 * Math.min(Math.max(seconds, 1), longestWaitSeconds);
}

function judge(response: Response, body: string): Outcome {
  const document = parse(body);
  switch (response.status) {
    case 200:
      return document === undefined ? { again: { reason: "the answer is cut off" } } : { answer: document };
    case 401:
    case 403:
      throw new Failure(exit.keyRefused, title(document, response.status));
    case 422:
      throw new Failure(exit.invalidScene, faults(document));
    case 408:
    case 429:
    case 502:
    case 503:
    case 504: {
      const waitMs = retryAfterMs(response.headers.get("retry-after"));
      return { again: { reason: title(document, response.status), waitMs } };
    }
    default:
      throw new Failure(exit.refused, title(document, response.status));
  }
}

/** Whether the service's certificate is not trusted: asking again does not change that. */
function isOfCertificate(error: unknown): boolean {
  const cause = error instanceof Error && error.cause instanceof Error ? error.cause : undefined;
  return cause !== undefined && "code" in cause && /CERT|SIGNATURE/.test(String(cause.code));
}

/** What `fetch` found; the word of the system where it has one. */
function reason(error: unknown): string {
  const cause = error instanceof Error && error.cause instanceof Error ? error.cause : error;
  return cause instanceof Error ? cause.message : String(cause);
}

/** The planning service, asked until it answers. */
export class Service {
  private readonly address: string;
  private readonly headers: Readonly<Record<string, string>>;

  /** An empty key is not sent. */
  constructor(url: string, key: string) {
    if (!/^https?:$/.test(new URL(url).protocol)) {
      throw new Failure(exit.refused, `SINGULATE_URL is no address of HTTP: ${url}`);
    }
    this.address = url.replace(/\/+$/, "");
    this.headers = {
      accept: "application/json",
      "content-type": "application/json",
      ...(key === "" ? {} : { authorization: `Bearer ${key}` }),
    };
  }

  async plan(scene: Scene): Promise<Answer> {
    return readAnswer(await this.ask("/v1/plans", scene.document, scene.timeLimitMs));
  }

  /** Whether what is left of a plan can't be carried out any more on the table as it is now. */
  async replan(scene: Scene, left: Plan, tolerance: number): Promise<boolean> {
    const body = { scene: scene.document, plan: left.body, partial: true, position_tolerance: tolerance };
    return readReplan(await this.ask("/v1/plans/verify", body, scene.timeLimitMs));
  }

  private async ask(path: string, body: unknown, timeLimitMs: number): Promise<unknown> {
    for (let failed = 0; ; failed++) {
      const outcome = await this.once(path, JSON.stringify(body), timeLimitMs);
      if ("answer" in outcome) {
        return outcome.answer;
      }
      const pauseMs = pausesMs[failed];
      if (pauseMs === undefined) {
        throw new Failure(exit.refused, `gave up: ${outcome.again.reason}`);
      }
      const waitMs = outcome.again.waitMs ?? pauseMs;
      console.error(`${outcome.again.reason}; asking again in ${waitMs} ms`);
      await sleep(waitMs);
    }
  }

  private async once(path: string, body: string, timeLimitMs: number): Promise<Outcome> {
    let response: Response;
    let answer: string;
    try {
      // The signal covers the body too, which may break off after its head has come.
      const signal = AbortSignal.timeout(timeLimitMs + transferMs);
      const { headers } = this;
      // A redirect is an answer like others: the key is for this address alone.
      response = await fetch(this.address + path, { method: "POST", headers, body, signal, redirect: "manual" });
      answer = await response.text();
    } catch (error) {
      if (isOfCertificate(error)) {
        throw new Failure(exit.refused, reason(error));
      }
      return { again: { reason: reason(error) } };
    }
    return judge(response, answer);
  }
}
