/** What the server says went wrong. */

import type { ErrorValue } from './generated/messages';
import { isObject, type Json } from './json';

/** An error of a call or stream: the message, what to do about it, and the names that do exist. */
export class CallError extends Error {
  constructor(
    message: string,
    readonly hint = '',
    readonly known: readonly string[] = [],
  ) {
    super(message);
    this.name = 'CallError';
  }

  /** Reads the protocol's `{"message", "hint", "known"}`. */
  static from(value: Json | undefined): CallError {
    if (!isObject(value)) return new CallError('The server gave no reason.');
    const { message, hint, known } = value as unknown as ErrorValue;
    return new CallError(message, hint, known);
  }
}

/** Any thrown thing as a `CallError`. */
export function asCallError(problem: unknown): CallError {
  if (problem instanceof CallError) return problem;
  return new CallError(problem instanceof Error ? problem.message : String(problem));
}

/** An error in one line: message, hint, what there is. */
export function inOneLine(problem: unknown): string {
  const error = asCallError(problem);
  const known = error.known.length > 0 ? `there is ${error.known.slice(0, 8).join(', ')}` : '';
  return [error.message, error.hint, known].filter(Boolean).join('; ');
}
