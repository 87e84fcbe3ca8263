// The messages between a page and the worker that computes.
import type { LoadFailure, StatusName } from './errors.ts';
import type { ModuleSources } from './loader.ts';
import type { MetricRequest } from './metrics.ts';
import type { Case, MeshArrays, MeshSource, MetricSpec, Options, Outcome } from './session.ts';

/** The calls that a worker answers: arguments and result of each. */
export interface Calls {
  about: { args: Record<never, never>; result: { version: string; cases: Case[] } };
  /**
   * Loads a mesh and sets its metric, for so many `cells` if that is said; keeps the old ones when either is refused. A
   * case brings its own metric.
   */
  open: { args: { source: MeshSource; metric?: MetricSpec; cells?: number }; result: MeshArrays };
  /** Another metric on the same mesh. */
  metric: { args: MetricSpec; result: null };
  /**
   * Adapts the mesh; events arrive while it runs. Answered when the run is over. Where layers alone do not make the number
   * of cells that the metric asks for, other sizes are tried first; then the events arrive together.
   */
  run: { args: { options: Options }; result: RunResult };
  /** The bytes of a metric for the open mesh, for `metric`: made by a module of its own, loaded when first asked for. */
  makeMetric: { args: MetricRequest; result: Uint8Array };
  pause: { args: Record<never, never>; result: null };
  resume: { args: Record<never, never>; result: null };
  cancel: { args: Record<never, never>; result: null };
  /** Shape of each cell and length of each edge of any mesh, in the metric. */
  measure: { args: { points: Float64Array; cells: Int32Array; lengths: boolean }; result: Measures };
  tensors: { args: { points: Float64Array }; result: Float64Array };
  /**
   * The mesh as a file, or for a name that ends in .json the report: as it is now or, given a number of events, as it
   * was after so many of them or the next few.
   */
  write: { args: { name: string; events?: number }; result: Uint8Array };
  report: { args: Record<never, never>; result: string };
}

export type CallName = keyof Calls;

export interface RunResult {
  outcome: Outcome;
  events: number;
  seconds: number;
  /** JSON text, docs/report.md. */
  report: string;
}

export interface Measures {
  /** NaN for dead cells. */
  shapes: Float64Array;
  /** Each edge once, as a pair of vertices, and its length. Empty unless asked for. */
  edges: Int32Array;
  lengths: Float64Array;
}

export type Request = { [N in CallName]: { id: number; name: N; args: Calls[N]['args'] } }[CallName];

/** An error as it crosses: rebuilt as an Error with these fields on the other side. */
export interface Failure {
  kind: 'refused' | 'crashed' | 'load';
  message: string;
  /** refused: the core's status. */
  status?: StatusName;
  /** load: why. */
  reason?: LoadFailure;
}

export type Reply =
  | { type: 'answer'; id: number; result: Calls[CallName]['result'] }
  | { type: 'failure'; id: number; failure: Failure }
  /** More events of the run that was started by request `id`. */
  | { type: 'events'; id: number; ints: Int32Array; doubles: Float64Array };

/** What a worker says once it listens: until then it may turn out that it cannot be started. */
export interface Hello {
  type: 'hello';
}

/** A message to a worker: a new session, which talks over a port of its own, and where the modules are. */
export interface Setup {
  type: 'connect';
  port: MessagePort;
  modules: ModuleSources<string | ArrayBuffer | WebAssembly.Module>;
}

/** The last message over a port: the session is not wanted any more. */
export interface Goodbye {
  type: 'goodbye';
}
