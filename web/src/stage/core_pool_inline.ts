// In place of core_pool.ts in the single script (vite.standalone.ts): worker and modules are part of it. The module with
// full adaptation stands for that without, so that quadrilaterals are not there twice.
import type { ModuleSources } from '../../../wasm/loader.ts';
import { Pool } from '../../../wasm/pool.ts';
import full from '../../../build/wasm/pillowmesh_full.wasm?packed';
import solid from '../../../build/wasm/pillowmesh3d.wasm?packed';
import files from '../../../build/wasm/pillowmesh_files.wasm?packed';
import metrics from '../../../build/wasm/pillowmesh_metrics.wasm?packed';
import { loadServer } from './server_code_bundled.ts';
import InlineWorker from '../../../wasm/worker.ts?worker&inline';

let pool: Pool | null = null;

/** The bytes that vite.standalone.ts has compressed and written as base64. */
async function unpack(packed: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(packed), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

async function unpackAll(): Promise<ModuleSources<ArrayBuffer>> {
  const [two, three, formats, makers] = await Promise.all([full, solid, files, metrics].map(unpack));
  return { 2: two, full: two, 3: three, files: formats, metrics: makers };
}

export function corePool(): Pool {
  return (pool ??= new Pool(() => new InlineWorker(), unpackAll(), 1, loadServer));
}
