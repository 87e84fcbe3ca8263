// A typed session over the C interface: a mesh, a metric, options, and the run made of them.
import { CoreError, CrashError, statusNames, type StatusName } from './errors.ts';
import { readFile } from './files.ts';
import type { Core, Exports, Modules } from './loader.ts';
import { makeMetric } from './metrics.ts';
import { guard, pass, readBytes, readText, type Argument } from './memory.ts';

export { CoreError, statusNames, type StatusName } from './errors.ts';

const more = 100;

/** A case of the gallery. */
export interface Case {
  name: string;
  dim: number;
  title: string;
  mesh: string;
  /** Empty for riemann, whose metric is made of a picture. */
  formula: string;
  source: string;
}

/** What to adapt. */
export type MeshSource =
  { kind: 'case'; name: string } | { kind: 'grid'; spec: string } | { kind: 'file'; name: string; bytes: Uint8Array };

/** The same with a file read: what a session loads. `bytes` are those of `readFile`. */
export type Loadable = Exclude<MeshSource, { kind: 'file' }> | { kind: 'input'; name: string; bytes: Uint8Array };

/** A formula, or the bytes that makeMetric (metrics.ts) gave. */
export type MetricSpec = ({ formula: string } | { nodal: Uint8Array }) & {
  /** All sizes are multiplied by this; 1 by default. */
  scale?: number;
  /** Before that they are scaled so that so many cells of unit size fill the domain: what full adaptation makes of it. */
  cells?: number;
};

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

/** The version of the core. */
export function version(core: Core): string {
  return readText(core.exports, core.exports.pm_version());
}

/** The gallery. */
export function cases(core: Core): Case[] {
  return JSON.parse(readText(core.exports, core.exports.pm_cases())) as Case[];
}

/** What a run takes besides its mesh. A case brings its own metric. */
export interface Specification {
  metric?: MetricSpec;
  options: Options;
}

/** A session with its mesh, and what it takes to make it again. */
export interface Opened {
  core: Core;
  session: Session;
  source: Loadable;
  /** What was given, or is made for a case that has no formula; it has been set. */
  metric?: MetricSpec;
}

/**
 * A session with the mesh loaded, and its metric if one is given or it is a case, scaled for so many `cells`, on the core
 * of its dimension. A file tells its dimension when it is read. Of anything else the core for 2D is asked first, and that
 * for 3D when it answers that the mesh is none of its own.
 */
export async function openSession(
  modules: Modules,
  mesh: MeshSource,
  given?: MetricSpec,
  cells?: number,
): Promise<Opened> {
  const opened = await openMeshAlone(modules, mesh);
  const { core, session } = opened;
  const own = mesh.kind === 'case' ? cases(core).find(({ name }) => name === mesh.name)?.formula : undefined;
  const made = async (): Promise<MetricSpec> =>
    ({ nodal: makeMetric(await modules.metrics(), session.input(), { image: 'portrait' }) });
  try {
    let metric = given ?? (own === '' ? await made() : undefined);
    if (cells && (metric || own)) metric = { ...(metric ?? { formula: own! }), cells };
    if (metric) session.setMetric(metric);
    return { ...opened, metric };
  } catch (error) {
    if (!(error instanceof CrashError)) session.destroy();
    throw error;
  }
}

async function openMeshAlone(modules: Modules, mesh: MeshSource): Promise<Opened> {
  if (mesh.kind === 'file') {
    const { dim, bytes } = readFile(await modules.files(), mesh.name, mesh.bytes);
    return loaded(await modules.core(dim), { kind: 'input', name: mesh.name, bytes });
  }
  try {
    return loaded(await modules.core(2), mesh);
  } catch (error) {
    if (!forOtherCore(error)) throw error;
    return loaded(await modules.core(3), mesh);
  }
}

/** Whether a core has answered that what is asked is for another core. */
export function forOtherCore(error: unknown): boolean {
  return error instanceof CoreError && error.status === 'other_build';
}

/**
 * The same mesh, metric and options, and a run begun: on the same core or, when its options ask for full adaptation and
 * the core leaves that out, on that which has it. What was opened is to be destroyed by the caller.
 */
export async function beginRun(modules: Modules, opened: Opened, specification: Specification): Promise<Opened> {
  const begun = (core: Core): Opened => {
    const { source, metric } = opened;
    const next = prepared(core, source, { ...specification, metric: specification.metric ?? metric });
    try {
      next.session.begin();
      return { ...next, metric };
    } catch (error) {
      if (!(error instanceof CrashError)) next.session.destroy();
      throw error;
    }
  };
  try {
    return begun(opened.core);
  } catch (error) {
    if (!forOtherCore(error)) throw error;
    return begun(await modules.core('full'));
  }
}

/** A session with mesh, metric and options. */
export function prepared(core: Core, source: Loadable, { metric, options }: Specification): Opened {
  const opened = loaded(core, source);
  try {
    if (metric) opened.session.setMetric(metric);
    for (const [name, value] of Object.entries(options)) opened.session.setOption(name, value);
    return opened;
  } catch (error) {
    if (!(error instanceof CrashError)) opened.session.destroy();
    throw error;
  }
}

function loaded(core: Core, source: Loadable): Opened {
  const session = new Session(core);
  try {
    session.load(source);
    return { core, session, source };
  } catch (error) {
    if (!(error instanceof CrashError)) session.destroy();
    throw error;
  }
}

/** One mesh at a time, all of the dimension that its core is for. */
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

  load(source: Loadable): void {
    const { core, handle } = this;
    switch (source.kind) {
      case 'case':
        return this.check(this.pass([source.name], (p, n) => core.pm_load_case(handle, p, n)));
      case 'grid':
        return this.check(this.pass([source.spec], (p, n) => core.pm_load_grid(handle, p, n)));
      case 'input':
        return this.check(
          this.pass([source.name, source.bytes], (p, n, q, m) => core.pm_load_input(handle, p, n, q, m)),
        );
    }
  }

  setMetric({ scale = 1, cells, ...metric }: MetricSpec): void {
    const { core, handle } = this;
    const set = (factor: number): void => {
      if ('nodal' in metric) this.check(this.pass([metric.nodal], (p, n) => core.pm_set_nodal(handle, p, n, factor)));
      else this.check(this.pass([metric.formula], (p, n) => core.pm_set_metric(handle, p, n, factor)));
    };
    if (!cells) return set(scale);
    set(1);
    const { complexity } = JSON.parse(this.report()) as { complexity: number };
    set(scale * (complexity / cells) ** (1 / this.dimension()));
  }

  setOption(name: string, value: string): void {
    this.check(this.pass([name, value], (p, n, q, m) => this.core.pm_set_option(this.handle, p, n, q, m)));
  }

  begin(): void {
    this.check(guard(() => this.core.pm_begin(this.handle)));
  }

  /** At most `steps` steps of the adapter. Returns how the run ended, or null while it is not over. */
  step(steps = 1): Outcome | null {
    const status = guard(() => this.core.pm_step(this.handle, steps));
    return status === more ? null : { status: statusNames[status], message: this.message() };
  }

  /** Events since the last call; decode with decodeEvents. The arrays are the caller's. */
  takeEvents(): { ints: Int32Array; doubles: Float64Array } {
    this.check(guard(() => this.core.pm_take_events(this.handle)));
    return { ints: this.ints(), doubles: this.doubles() };
  }

  /** 2 or 3; 0 before a mesh is loaded. */
  dimension(): number {
    return this.core.pm_dimension(this.handle);
  }

  /** The mesh as it is now. */
  mesh(): MeshArrays {
    this.check(guard(() => this.core.pm_mesh(this.handle)));
    return { dim: this.dimension(), points: this.doubles(), cells: this.ints() };
  }

  /** The report on the mesh as it is now, as JSON text (docs/report.md). */
  report(): string {
    this.check(guard(() => this.core.pm_report(this.handle)));
    return new TextDecoder().decode(this.bytes());
  }

  /** The mesh as it is now, for `writeFile` or another session. */
  input(): Uint8Array<ArrayBuffer> {
    this.check(guard(() => this.core.pm_input(this.handle)));
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

  private pass(args: Argument[], call: (p: number, n: number, q: number, m: number) => number): number {
    return pass(this.core, args, call);
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
    return readBytes(core, core.pm_bytes(handle), core.pm_byte_count(handle));
  }
}
