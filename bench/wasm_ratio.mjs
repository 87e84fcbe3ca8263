// The WebAssembly modules against the native command: wall time of the same run (paper's method, defaults), the command
// as a process, WebAssembly in Node through the session, warm. Both take turns, and the fastest of each counts, because
// a busy machine only ever makes a run slower. Prints JSON.
// Usage: node bench/wasm_ratio.mjs [--repeat N] [--modules FOLDER] [CASE...]
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { runnerImport } from 'vite';
import { Failure, main, root } from '../scripts/run.mjs';
import { timed } from './process.mjs';

const { values: options, positionals } = parseArgs({
  options: { repeat: { type: 'string', default: '5' }, modules: { type: 'string', default: 'build/wasm' } },
  allowPositionals: true,
});
const chosen = positionals.length > 0 ? positionals : ['iso2d', 'aniso2d', 'circle2d', 'linear3d', 'sphere3d'];
const binary = join(root, 'build', 'release', 'bin', 'pillowmesh');
const typescript = async (path) => (await runnerImport(join(root, path), { logLevel: 'error' })).module;

function runNatively(name) {
  const { seconds, status, stderr } = timed(binary, ['adapt', '--case', name, '--method', 'paper', '-q'], root);
  if (status !== 0 && status !== 1) throw new Failure(`pillowmesh ended with status ${status}:\n${stderr}`);
  return seconds;
}

await main(async () => {
  const { modulesFrom } = await typescript('wasm/loader.ts');
  const { openSession } = await typescript('wasm/session.ts');
  const bytes = (name) => readFileSync(join(root, options.modules, `${name}.wasm`));
  const modules = modulesFrom({
    2: bytes('pillowmesh'),
    full: bytes('pillowmesh_full'),
    3: bytes('pillowmesh3d'),
    files: bytes('pillowmesh_files'),
  });

  async function runInNode(name) {
    const start = performance.now();
    const { session } = await openSession(modules, { kind: 'case', name });
    session.setOption('method', 'paper');
    session.begin();
    while (!session.step(100)) session.takeEvents();
    const { mesh } = JSON.parse(session.report());
    session.destroy();
    return { seconds: (performance.now() - start) / 1000, cells: mesh.cells };
  }

  const rows = [];
  for (const name of chosen) {
    let { cells } = await runInNode(name); // warm: compiled by the optimising tier
    let [native, wasm] = [Infinity, Infinity];
    for (let i = 0; i < Number(options.repeat); ++i) {
      native = Math.min(native, runNatively(name));
      wasm = Math.min(wasm, (await runInNode(name)).seconds);
    }
    rows.push({ case: name, cells, native_seconds: native, wasm_seconds: wasm, ratio: wasm / native });
    console.error(`${name}: ${(wasm / native).toFixed(2)}`);
  }
  console.log(JSON.stringify({ node: process.version, repeat: Number(options.repeat), rows }, null, 2));
});
