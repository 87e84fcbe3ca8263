// The core for programs, in Node and in browsers: sessions over modules that are loaded when they are wanted.
//
//   const mesh = await openMesh({ kind: 'grid', spec: 'grid:8,8:0,1,0,1' });
//   const { report } = await mesh.adapt({ formula: 'h = 0.02 + 0.2*x' });
//   await fs.writeFile('adapted.vtu', await mesh.file('adapted.vtu'));
import { decodeEvents, type MeshEvent } from './events.ts';
import { writeFile } from './files.ts';
import { modulesFrom, type CoreSource, type Modules, type ModuleSources } from './loader.ts';
import {
  beginRun,
  openSession,
  type MeshArrays,
  type MeshSource,
  type MetricSpec,
  type Opened,
  type Options,
  type Outcome,
} from './session.ts';

export * from './events.ts';
export { readFile, writeFile, type Input } from './files.ts';
export * from './loader.ts';
export { makeMetric, type Dab, type GrayImage, type MetricRequest } from './metrics.ts';
export * from './session.ts';

/** The modules that come with this package; `sources` takes the place of some of them. */
export function packageModules(sources: Partial<ModuleSources> = {}): Modules {
  const all: ModuleSources = {
    2: new URL('./pillowmesh.wasm', import.meta.url),
    full: new URL('./pillowmesh_full.wasm', import.meta.url),
    3: new URL('./pillowmesh3d.wasm', import.meta.url),
    files: new URL('./pillowmesh_files.wasm', import.meta.url),
    metrics: new URL('./pillowmesh_metrics.wasm', import.meta.url),
    ...sources,
  };
  return modulesFrom(all, readIfFile);
}

/** Node fetches no files. Asked for in a way that bundlers for browsers do not follow. */
async function readIfFile(source: CoreSource): Promise<CoreSource> {
  if (!(source instanceof URL) || source.protocol !== 'file:' || typeof process === 'undefined') return source;
  const fs = process.getBuiltinModule?.('node:fs/promises');
  return fs ? new Uint8Array(await fs.readFile(source)) : source;
}

let shared: Modules | null = null;

/** A mesh with a core of its own. */
export class AdaptableMesh {
  private readonly modules: Modules;
  private opened: Opened;

  constructor(modules: Modules, opened: Opened) {
    this.modules = modules;
    this.opened = opened;
  }

  /**
   * Adapts the mesh as it was opened, to its case's metric if none is given, with options by their command-line names.
   * `onEvents` gets the operations as they are done. Runs to the end without a pause: in a page, use a worker.
   */
  async adapt(
    metric?: MetricSpec,
    options: Options = {},
    onEvents?: (events: MeshEvent[]) => void,
  ): Promise<{ outcome: Outcome; report: unknown }> {
    const next = await beginRun(this.modules, this.opened, { metric, options });
    this.opened.session.destroy();
    this.opened = next;
    const { session } = next;
    let outcome = session.step();
    for (; !outcome; outcome = session.step()) {
      const { ints, doubles } = session.takeEvents();
      if (onEvents && ints.length > 0) onEvents(decodeEvents(session.dimension(), ints, doubles));
    }
    return { outcome, report: this.report() };
  }

  /** Points and cells as they are now; a dead cell has corners -1. */
  arrays(): MeshArrays {
    return this.opened.session.mesh();
  }

  /** The report on the mesh as it is now (docs/report.md). */
  report(): unknown {
    return JSON.parse(this.opened.session.report());
  }

  /** The mesh as a file: the ending of `name` chooses the format. */
  async file(name: string): Promise<Uint8Array> {
    return writeFile(await this.modules.files(), name, this.opened.session.input());
  }

  /** Frees the core's memory; the mesh must not be used afterwards. */
  close(): void {
    this.opened.session.destroy();
  }
}

/**
 * Opens a case (its metric scaled for so many `cells`, if that is said), a grid or a file's bytes. Rejects with a CoreError
 * that says what is wrong.
 */
export async function openMesh(source: MeshSource, modules?: Modules, cells?: number): Promise<AdaptableMesh> {
  const from = modules ?? (shared ??= packageModules());
  return new AdaptableMesh(from, await openSession(from, source, undefined, cells));
}
