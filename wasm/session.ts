// A typed session over the C interface: a mesh, a metric, options, and the run made of them.
import { CrashError, type Core, type Exports } from './loader.ts';

/** In the order of StatusCode in core/pillowmesh/mesh/status.h. */
export const statusNames = ['ok', 'limit_not_met', 'usage', 'bad_input', 'cancelled', 'illegal'] as const;
export type StatusName = (typeof statusNames)[number];
const more = 100;

/** A call that the core refused: what kind of refusal, and its sentence. */
export class CoreError extends Error {
  readonly status: StatusName;
  constructor(status: StatusName, message: string) {
    super(message);
    this.name = 'CoreError';
    this.status = status;
  }
}

/** A case of the gallery. */
export interface Case {
  name: string;
  dim: number;
  title: string;
  mesh: string;
  formula: string;
  source: string;
}

/** What to adapt. */
export type MeshSource =
  { kind: 'case'; name: string } | { kind: 'grid'; spec: string } | { kind: 'file'; name: string; bytes: Uint8Array };

export interface MetricSpec {
  formula: string;
  /** All sizes are multiplied by this; 1 by default. */
  scale?: number;
}

/** Options by their command-line names without dashes, e.g. {threshold: '2', smooth: 'end'}. */
export type Options = Record<string, string>;

/** Points and cells alone; a dead cell has corners -1. */
export interface MeshArrays {
  dim: number;
  points: Float64Array;
  cells: Int32Array;
}

/** Each edge once, and its metric length. */
export interface EdgeLengths {
  edges: Int32Array;
  lengths: Float64Array;
}

/** How a run ended. */
export interface Outcome {
  status: StatusName;
  message: string;
}

const encoder = new TextEncoder();
const decoder = new TextDecoder();

function readText(exports: Exports, pointer: number): string {
  const bytes = new Uint8Array(exports.memory.buffer);
  return decoder.decode(bytes.subarray(pointer, bytes.indexOf(0, pointer)));
}

/** The version of the core. */
export function version(core: Core): string {
  return readText(core.exports, core.exports.pm_version());
}

/** The gallery. */
export function cases(core: Core): Case[] {
  return JSON.parse(readText(core.exports, core.exports.pm_cases())) as Case[];
}

type Argument = string | Uint8Array | Int32Array | Float64Array;

export class Session {
  private readonly core: Exports;
  private readonly handle: number;

  constructor(core: Core) {
    this.core = core.exports;
    this.handle = this.core.pm_create();
  }

  /** Frees the core's memory; the session must not be used afterwards. */
  destroy(): void {
    this.core.pm_destroy(this.handle);
  }

  load(source: MeshSource): void {
    const { core, handle } = this;
    switch (source.kind) {
      case 'case':
        return this.check(this.pass([source.name], (p, n) => core.pm_load_case(handle, p, n)));
      case 'grid':
        return this.check(this.pass([source.spec], (p, n) => core.pm_load_grid(handle, p, n)));
      case 'file':
        return this.check(
          this.pass([source.name, source.bytes], (p, n, q, m) => core.pm_load_file(handle, p, n, q, m)),
        );
    }
  }

  setMetric({ formula, scale = 1 }: MetricSpec): void {
    this.check(this.pass([formula], (p, n) => this.core.pm_set_metric(this.handle, p, n, scale)));
  }

  setOption(name: string, value: string): void {
    this.check(this.pass([name, value], (p, n, q, m) => this.core.pm_set_option(this.handle, p, n, q, m)));
  }

  begin(): void {
    this.check(this.guard(() => this.core.pm_begin(this.handle)));
  }

  /** At most `steps` steps of the adapter. Returns how the run ended, or null while it is not over. */
  step(steps = 1): Outcome | null {
    const status = this.guard(() => this.core.pm_step(this.handle, steps));
    return status === more ? null : { status: statusNames[status], message: this.message() };
  }

  /** Events since the last call; decode with decodeEvents. The arrays are the caller's. */
  takeEvents(): { ints: Int32Array; doubles: Float64Array } {
    this.check(this.guard(() => this.core.pm_take_events(this.handle)));
    return { ints: this.ints(), doubles: this.doubles() };
  }

  /** 2 or 3; 0 before a mesh is loaded. */
  dimension(): number {
    return this.core.pm_dimension(this.handle);
  }

  /** The mesh as it is now. */
  mesh(): MeshArrays {
    this.check(this.guard(() => this.core.pm_mesh(this.handle)));
    return { dim: this.dimension(), points: this.doubles(), cells: this.ints() };
  }

  /** The report on the mesh as it is now, as JSON text (docs/report.md). */
  report(): string {
    this.check(this.guard(() => this.core.pm_report(this.handle)));
    return decoder.decode(this.bytes());
  }

  /** The mesh as it is now as a file; the ending of `name` chooses the format. */
  write(name: string): Uint8Array<ArrayBuffer> {
    this.check(this.pass([name], (p, n) => this.core.pm_write_file(this.handle, p, n)));
    return this.bytes();
  }

  /** The metric at points: m11 m12 m22 [m13 m23 m33] each. */
  tensors(points: Float64Array): Float64Array {
    const count = points.length / this.dimension();
    this.check(this.pass([points], (p) => this.core.pm_tensors(this.handle, p, count)));
    return this.doubles();
  }

  /** The shape eta of each cell; NaN for dead ones. */
  cellShapes(points: Float64Array, cells: Int32Array): Float64Array {
    const [n, m] = this.counts(points, cells);
    this.check(this.pass([points, cells], (p, _, c) => this.core.pm_cell_shapes(this.handle, p, n, c, m)));
    return this.doubles();
  }

  /** The edges of the cells, each once, with metric lengths. */
  edgeLengths(points: Float64Array, cells: Int32Array): EdgeLengths {
    const [n, m] = this.counts(points, cells);
    this.check(this.pass([points, cells], (p, _, c) => this.core.pm_edge_lengths(this.handle, p, n, c, m)));
    return { edges: this.ints(), lengths: this.doubles() };
  }

  private counts(points: Float64Array, cells: Int32Array): [number, number] {
    const dim = this.dimension() || 2;
    return [points.length / dim, cells.length >> dim];
  }

  private check(status: number): void {
    if (status !== 0) throw new CoreError(statusNames[status] ?? 'illegal', this.message());
  }

  private message(): string {
    return readText(this.core, this.core.pm_message(this.handle));
  }

  private guard<T>(call: () => T): T {
    try {
      return call();
    } catch (error) {
      throw new CrashError(error);
    }
  }

  /** Copies the arguments into the core's memory, calls with (pointer, bytes) of each, frees. */
  private pass(args: Argument[], call: (p: number, n: number, q: number, m: number) => number): number {
    return this.guard(() => {
      const flat: number[] = [];
      for (const argument of args) {
        const data = typeof argument === 'string' ? encoder.encode(argument) : argument;
        const bytes = new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
        const pointer = this.core.pm_alloc(Math.max(bytes.length, 1));
        if (pointer === 0) throw new RangeError('out of memory');
        new Uint8Array(this.core.memory.buffer).set(bytes, pointer);
        flat.push(pointer, bytes.length);
      }
      const status = call(flat[0], flat[1], flat[2] ?? 0, flat[3] ?? 0);
      for (let i = 0; i < flat.length; i += 2) this.core.pm_free(flat[i]);
      return status;
    });
  }

  private ints(): Int32Array<ArrayBuffer> {
    const { core, handle } = this;
    return new Int32Array(core.memory.buffer, core.pm_ints(handle), core.pm_int_count(handle)).slice();
  }

  private doubles(): Float64Array<ArrayBuffer> {
    const { core, handle } = this;
    return new Float64Array(core.memory.buffer, core.pm_doubles(handle), core.pm_double_count(handle)).slice();
  }

  private bytes(): Uint8Array<ArrayBuffer> {
    const { core, handle } = this;
    return new Uint8Array(core.memory.buffer, core.pm_bytes(handle), core.pm_byte_count(handle)).slice();
  }
}
