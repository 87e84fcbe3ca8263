// The built module, loaded once per test file.
import { readFileSync } from 'node:fs';
import { readFile, writeFile, type Input } from '../../wasm/files.ts';
import { loadCore, loadFiles, loadMetrics, type Core, type CoreName } from '../../wasm/loader.ts';
import { makeMetric } from '../../wasm/metrics.ts';
import {
  Session,
  cases,
  forOtherCore,
  type MeshSource,
  type MetricSpec,
  type Options,
  type Outcome,
} from '../../wasm/session.ts';

const built = (name: string): URL => new URL(`../../build/wasm/${name}.wasm`, import.meta.url);
export const modulePaths = {
  2: built('pillowmesh'),
  full: built('pillowmesh_full'),
  3: built('pillowmesh3d'),
  files: built('pillowmesh_files'),
  metrics: built('pillowmesh_metrics'),
};
export const moduleBytes = (which: CoreName | 'files' | 'metrics'): Buffer<ArrayBuffer> =>
  readFileSync(modulePaths[which]) as Buffer<ArrayBuffer>;
/** The core for quadrilaterals with all methods, unless another is asked for. */
export const load = (which: CoreName = 'full'): Promise<Core> => loadCore(moduleBytes(which));
const solidCore = await loadCore(moduleBytes(3));
const files = await loadFiles(moduleBytes('files'));
const metrics = await loadMetrics(moduleBytes('metrics'));

export const read = (name: string, bytes: Uint8Array): Input => readFile(files, name, bytes);
export const write = (session: Session, name: string): Uint8Array<ArrayBuffer> =>
  writeFile(files, name, session.input());

/** openSession for tests that have all modules loaded; `core` is one for quadrilaterals. */
function loaded(core: Core, source: MeshSource): Session {
  if (source.kind === 'file') {
    const { dim, bytes } = read(source.name, source.bytes);
    const session = new Session(dim === 2 ? core : solidCore);
    session.load({ kind: 'input', name: source.name, bytes });
    return session;
  }
  const session = new Session(core);
  try {
    session.load(source);
    return session;
  } catch (error) {
    session.destroy();
    if (core === solidCore || !forOtherCore(error)) throw error;
    return loaded(solidCore, source);
  }
}

export function open(core: Core, source: MeshSource, metric?: MetricSpec, options: Options = {}): Session {
  const session = loaded(core, source);
  if (metric) session.setMetric(metric);
  else if (source.kind === 'case' && !cases(core).find(({ name }) => name === source.name)?.formula)
    session.setMetric({ nodal: makeMetric(metrics, session.input(), { image: 'portrait' }) });
  for (const [name, value] of Object.entries(options)) session.setOption(name, value);
  return session;
}

export function runToEnd(session: Session): Outcome {
  session.begin();
  for (;;) {
    const outcome = session.step(100);
    if (outcome) return outcome;
  }
}

export interface Report {
  mesh: { dim: number; vertices: number; edges: number; cells: number };
  edge_length: { count: number; min: number; mean: number; max: number; cv: number };
  shape: { count: number; min: number; mean: number; max: number; cv: number };
  irregular_vertices: number;
  complexity: number;
  valid: boolean;
  operations: Record<string, number>;
}

export const reportOf = (session: Session): Report => JSON.parse(session.report()) as Report;
