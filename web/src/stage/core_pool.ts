// The one pool of workers that all pictures of a page compute in, and where its files are.
import { Pool } from '../../../wasm/pool.ts';
import planeUrl from '../../../build/wasm/pillowmesh.wasm?url';
import fullUrl from '../../../build/wasm/pillowmesh_full.wasm?url';
import solidUrl from '../../../build/wasm/pillowmesh3d.wasm?url';
import filesUrl from '../../../build/wasm/pillowmesh_files.wasm?url';
import metricsUrl from '../../../build/wasm/pillowmesh_metrics.wasm?url';
import workerUrl from '../../../wasm/worker.ts?worker&url';
import { loadServer } from './server_code.ts';

let pool: Pool | null = null;

/** More workers than this would only share the same processors. */
const most = (): number => Math.max(1, Math.min(3, (navigator.hardwareConcurrency ?? 2) - 1));

const absolute = (url: string): string => new URL(url, import.meta.url).href;

/** For a script that comes from another host: a worker of the page's own that imports the other's code. */
function importingWorker(address: string): Worker {
  const code = new Blob([`import ${JSON.stringify(address)};`], { type: 'text/javascript' });
  return new Worker(URL.createObjectURL(code), { type: 'module' });
}

/**
 * The module of every visit is compiled while it arrives, beside the worker's start. Where that fails its address stands
 * for it: the worker tries again, and tells what is wrong.
 */
async function compiled(address: string): Promise<WebAssembly.Module | string> {
  try {
    return await WebAssembly.compileStreaming(fetch(address));
  } catch {
    return address;
  }
}

export function corePool(): Pool {
  if (pool) return pool;
  const address = absolute(workerUrl);
  const foreign = new URL(address).origin !== location.origin;
  const modules = compiled(absolute(planeUrl)).then((plane) => ({
    2: plane,
    full: absolute(fullUrl),
    3: absolute(solidUrl),
    files: absolute(filesUrl),
    metrics: absolute(metricsUrl),
  }));
  return (pool = new Pool(
    () => (foreign ? importingWorker(address) : new Worker(address, { type: 'module' })),
    modules,
    most(),
    () => loadServer(address),
  ));
}
