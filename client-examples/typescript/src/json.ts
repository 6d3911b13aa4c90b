// Reading of JSON of which nothing is known yet. What is not as it should be is refused with its place.

import { exit, Failure } from "./failure.js";

export type Fields = { readonly [name: string]: unknown };

export function isFields(value: unknown): value is Fields {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function refuse(what: string, place: string): never {
  throw new Failure(exit.refused, `the answer is not understood: ${place} is not ${what}`);
}

export function fields(value: unknown, place: string): Fields {
  return isFields(value) ? value : refuse("an object", place);
}

export function list(value: unknown, place: string): readonly unknown[] {
  return Array.isArray(value) ? value : refuse("a list", place);
}

export function text(value: unknown, place: string): string {
  return typeof value === "string" ? value : refuse("a text", place);
}

export function number(value: unknown, place: string): number {
  return typeof value === "number" ? value : refuse("a number", place);
}

export function boolean(value: unknown, place: string): boolean {
  return typeof value === "boolean" ? value : refuse("a boolean", place);
}
