/** How the client ends. */
export const exit = {
  reached: 0,
  refused: 1,
  invalidScene: 2,
  deadlock: 3,
  noSpace: 4,
  timedOut: 5,
  keyRefused: 6,
  partlyCleared: 7,
} as const;

export type Exit = (typeof exit)[keyof typeof exit];

/** Why there is no answer: words for stderr, and how the client ends. */
export class Failure extends Error {
  constructor(
    readonly exit: Exit,
    words: string,
  ) {
    super(words);
  }
}
