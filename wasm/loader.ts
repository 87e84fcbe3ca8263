// Instantiates the core: a standalone WebAssembly module with a C interface (c_api.h) and a handful of WASI imports.
// Works in a page, a worker and Node; asks for nothing but WebAssembly itself (no eval, no generated glue).

import { LoadError } from './errors.ts';

export { CrashError, LoadError, type LoadFailure } from './errors.ts';

type Pointer = number;
type Status = number;

/** The functions of c_api.h. */
export interface Exports {
  memory: WebAssembly.Memory;
  pm_alloc(bytes: number): Pointer;
  pm_free(memory: Pointer): void;
  pm_version(): Pointer;
  pm_cases(): Pointer;
  pm_create(): Pointer;
  pm_destroy(session: Pointer): void;
  pm_message(session: Pointer): Pointer;
  pm_ints(session: Pointer): Pointer;
  pm_int_count(session: Pointer): number;
  pm_doubles(session: Pointer): Pointer;
  pm_double_count(session: Pointer): number;
  pm_bytes(session: Pointer): Pointer;
  pm_byte_count(session: Pointer): number;
  pm_load_input(session: Pointer, name: Pointer, nameSize: number, bytes: Pointer, size: number): Status;
  pm_load_grid(session: Pointer, spec: Pointer, size: number): Status;
  pm_load_case(session: Pointer, name: Pointer, size: number): Status;
  pm_set_metric(session: Pointer, formula: Pointer, size: number, scale: number): Status;
  pm_set_nodal(session: Pointer, bytes: Pointer, size: number, scale: number): Status;
  pm_set_option(session: Pointer, name: Pointer, nameSize: number, value: Pointer, size: number): Status;
  pm_begin(session: Pointer): Status;
  pm_step(session: Pointer, steps: number): Status;
  pm_take_events(session: Pointer): Status;
  pm_dimension(session: Pointer): number;
  pm_mesh(session: Pointer): Status;
  pm_report(session: Pointer): Status;
  pm_input(session: Pointer): Status;
  pm_tensors(session: Pointer, points: Pointer, count: number): Status;
  pm_cell_shapes(session: Pointer, points: Pointer, pointCount: number, cells: Pointer, cellCount: number): Status;
  pm_edge_lengths(session: Pointer, points: Pointer, pointCount: number, cells: Pointer, cellCount: number): Status;
}

/** The functions of files_api.h. */
export interface FilesExports {
  memory: WebAssembly.Memory;
  pm_alloc(bytes: number): Pointer;
  pm_free(memory: Pointer): void;
  pm_files_create(): Pointer;
  pm_files_destroy(files: Pointer): void;
  pm_files_message(files: Pointer): Pointer;
  pm_files_bytes(files: Pointer): Pointer;
  pm_files_byte_count(files: Pointer): number;
  pm_files_dimension(files: Pointer): number;
  pm_files_read(files: Pointer, name: Pointer, nameSize: number, bytes: Pointer, size: number): Status;
  pm_files_write(files: Pointer, name: Pointer, nameSize: number, bytes: Pointer, size: number): Status;
}

/** The functions of metrics_api.h. */
export interface MetricsExports {
  memory: WebAssembly.Memory;
  pm_alloc(bytes: number): Pointer;
  pm_free(memory: Pointer): void;
  pm_metrics_create(): Pointer;
  pm_metrics_destroy(metrics: Pointer): void;
  pm_metrics_message(metrics: Pointer): Pointer;
  pm_metrics_bytes(metrics: Pointer): Pointer;
  pm_metrics_byte_count(metrics: Pointer): number;
  pm_metrics_mesh(metrics: Pointer, bytes: Pointer, size: number): Status;
  pm_metrics_formula(metrics: Pointer, formula: Pointer, size: number): Status;
  pm_metrics_background(metrics: Pointer, name: Pointer, nameSize: number, bytes: Pointer, size: number): Status;
  pm_metrics_sol(metrics: Pointer, name: Pointer, nameSize: number, bytes: Pointer, size: number): Status;
  pm_metrics_hessian_sol(metrics: Pointer, name: Pointer, nameSize: number, bytes: Pointer, size: number): Status;
  pm_metrics_hessian_of(metrics: Pointer, formula: Pointer, size: number): Status;
  pm_metrics_image(metrics: Pointer, gray: Pointer, size: number, width: number): Status;
  pm_metrics_portrait(metrics: Pointer): Status;
  pm_metrics_sketch(metrics: Pointer, dabs: Pointer, size: number, paper: number): Status;
  pm_metrics_layer(metrics: Pointer, layer: Pointer, size: number): Status;
  pm_metrics_curvature(metrics: Pointer, perTurn: number): Status;
  pm_metrics_implied(metrics: Pointer, bytes: Pointer, size: number): Status;
  pm_metrics_option(metrics: Pointer, name: Pointer, nameSize: number, value: Pointer, size: number): Status;
  pm_metrics_build(metrics: Pointer): Status;
}

/** The loaded core: its exports, and the module for further instances. */
export interface Core {
  readonly exports: Exports;
  readonly module: WebAssembly.Module;
}

/** Where the module comes from: an address to fetch, its bytes, or a module compiled before. */
export type CoreSource = string | URL | BufferSource | WebAssembly.Module;

/** The module of file formats, loaded. */
export interface FilesModule {
  readonly exports: FilesExports;
  readonly module: WebAssembly.Module;
}

/** The module that makes metrics, loaded. */
export interface MetricsModule {
  readonly exports: MetricsExports;
  readonly module: WebAssembly.Module;
}

/**
 * Which core: for quadrilaterals by the paper's method, for hexahedra, or for quadrilaterals by either method. The first
 * is the smallest.
 */
export type CoreName = 2 | 3 | 'full';

/** Where the modules are: the cores, that for file formats, and that which makes metrics, for those who use it. */
export type ModuleSources<T = CoreSource> = Record<CoreName | 'files', T> & { metrics?: T };

/** The modules, each loaded when first asked for; after a failure it is tried again. */
export interface Modules {
  core(name: CoreName): Promise<Core>;
  files(): Promise<FilesModule>;
  metrics(): Promise<MetricsModule>;
}

/** `read` may turn a source into another, e.g. an address into bytes, when it is wanted. */
export function modulesFrom(
  sources: ModuleSources,
  read: (source: CoreSource) => CoreSource | Promise<CoreSource> = (source) => source,
): Modules {
  const cores = new Map<CoreName, Promise<Core>>();
  const files = new Map<'files', Promise<FilesModule>>();
  const metrics = new Map<'metrics', Promise<MetricsModule>>();
  return {
    core: (name) => once(cores, name, async () => loadCore(await read(sources[name]))),
    files: () => once(files, 'files', async () => loadFiles(await read(sources.files))),
    metrics: () => once(metrics, 'metrics', async () => loadMetrics(sources.metrics && (await read(sources.metrics)))),
  };
}

function once<K, T>(loading: Map<K, Promise<T>>, key: K, load: () => Promise<T>): Promise<T> {
  const promise = loading.get(key) ?? load();
  loading.set(key, promise);
  promise.catch(() => loading.delete(key));
  return promise;
}

/** Modules compiled by their addresses: all sessions of a page or worker share them, each with an instance of its own. */
const compiled = new Map<string, Promise<WebAssembly.Module>>();

function compile(source: CoreSource): Promise<WebAssembly.Module> {
  const address = typeof source === 'string' || source instanceof URL ? String(source) : null;
  return address === null ? compileNow(source) : once(compiled, address, () => compileNow(source));
}

async function compileNow(source: CoreSource): Promise<WebAssembly.Module> {
  if (typeof WebAssembly !== 'object')
    throw new LoadError('unsupported', 'This browser cannot run WebAssembly, which pillowmesh computes with.');
  if (source instanceof WebAssembly.Module) return source;
  let bytes: BufferSource;
  if (typeof source === 'string' || source instanceof URL) {
    let response: Response;
    try {
      response = await fetch(source);
    } catch (error) {
      throw new LoadError('missing', `The core could not be fetched: ${(error as Error).message}.`);
    }
    if (!response.ok)
      throw new LoadError('missing', `The core could not be fetched: the server answered ${response.status}.`);
    bytes = await response.arrayBuffer();
  } else {
    bytes = source;
  }
  try {
    return await WebAssembly.compile(bytes);
  } catch (error) {
    throw new LoadError('broken', `The core's file is damaged or not WebAssembly: ${(error as Error).message}`);
  }
}

/** The few calls that the standard library makes: a clock, and what it would do at the end of a program. */
function imports(memory: () => WebAssembly.Memory): WebAssembly.Imports {
  const success = 0;
  const notSupported = 58; // WASI errno ENOTSUP
  const wasi = {
    clock_time_get(_clock: number, _precision: bigint, out: Pointer): number {
      const nanoseconds = BigInt(Math.round(performance.now() * 1e6));
      new DataView(memory().buffer).setBigUint64(out, nanoseconds, true);
      return success;
    },
    proc_exit(code: number): never {
      throw new WebAssembly.RuntimeError(`exit ${code}`);
    },
    environ_sizes_get(count: Pointer, size: Pointer): number {
      const view = new DataView(memory().buffer);
      view.setUint32(count, 0, true);
      view.setUint32(size, 0, true);
      return success;
    },
    environ_get: () => success,
    fd_write: () => notSupported,
    fd_read: () => notSupported,
    fd_seek: () => notSupported,
    fd_close: () => notSupported,
    fd_fdstat_get: () => notSupported,
  };
  return { wasi_snapshot_preview1: wasi, env: { emscripten_notify_memory_growth: () => undefined } };
}

/** Compiles and instantiates a module with the function `wanted`. Rejects with a LoadError that says what is wrong. */
async function load<E extends { memory: WebAssembly.Memory }>(
  source: CoreSource,
  wanted: keyof E,
): Promise<{ exports: E; module: WebAssembly.Module }> {
  const module = await compile(source);
  const holder: { memory?: WebAssembly.Memory } = {};
  let instance: WebAssembly.Instance;
  try {
    instance = await WebAssembly.instantiate(
      module,
      imports(() => holder.memory!),
    );
  } catch (error) {
    throw new LoadError('broken', `The core does not fit its loader: ${(error as Error).message}`);
  }
  const exports = instance.exports as unknown as E & { _initialize?(): void };
  if (typeof exports[wanted] !== 'function')
    throw new LoadError('broken', 'The file is WebAssembly, but not the core of pillowmesh.');
  holder.memory = exports.memory;
  exports._initialize?.();
  return { exports, module };
}

/** A core: pillowmesh.wasm, pillowmesh_full.wasm or pillowmesh3d.wasm. */
export function loadCore(source: CoreSource): Promise<Core> {
  return load<Exports>(source, 'pm_create');
}

/** The module of file formats: pillowmesh_files.wasm. */
export function loadFiles(source: CoreSource): Promise<FilesModule> {
  return load<FilesExports>(source, 'pm_files_create');
}

/** The module that makes metrics: pillowmesh_metrics.wasm. */
export async function loadMetrics(source: CoreSource | undefined): Promise<MetricsModule> {
  if (source === undefined) throw new LoadError('missing', 'The module that makes metrics is not part of this page.');
  return load<MetricsExports>(source, 'pm_metrics_create');
}
