// The built module, loaded once per test file.
import { readFileSync } from 'node:fs';
import { loadCore, type Core } from '../../wasm/loader.ts';
import { Session, type MeshSource, type MetricSpec, type Options, type Outcome } from '../../wasm/session.ts';

export const modulePath = new URL('../../build/wasm/pillowmesh.wasm', import.meta.url);
export const moduleBytes = (): Buffer<ArrayBuffer> => readFileSync(modulePath) as Buffer<ArrayBuffer>;
export const load = (): Promise<Core> => loadCore(moduleBytes());

export function open(core: Core, source: MeshSource, metric?: MetricSpec, options: Options = {}): Session {
  const session = new Session(core);
  session.load(source);
  if (metric) session.setMetric(metric);
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
}

export const reportOf = (session: Session): Report => JSON.parse(session.report()) as Report;
