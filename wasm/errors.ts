// What can go wrong with the core, for those who talk to it without holding it.

/** Why the core could not be loaded. */
export type LoadFailure = 'unsupported' | 'missing' | 'broken';

export class LoadError extends Error {
  readonly reason: LoadFailure;
  constructor(reason: LoadFailure, message: string) {
    super(message);
    this.name = 'LoadError';
    this.reason = reason;
  }
}

/** The core trapped: out of memory, or a defect. The instance must not be used any more. */
export class CrashError extends Error {
  constructor(cause: unknown) {
    super(`The core stopped: ${cause instanceof Error ? cause.message : String(cause)}.`, { cause });
    this.name = 'CrashError';
  }
}

/** In the order of StatusCode in core/pillowmesh/mesh/status.h. */
export const statusNames = [
  'ok',
  'limit_not_met',
  'usage',
  'bad_input',
  'cancelled',
  'illegal',
  'other_build',
] as const;
export type StatusName = (typeof statusNames)[number];

/** A call that the core refused: what kind of refusal, and its sentence. */
export class CoreError extends Error {
  readonly status: StatusName;
  constructor(status: StatusName, message: string) {
    super(message);
    this.name = 'CoreError';
    this.status = status;
  }
}
