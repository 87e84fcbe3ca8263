// End to end: pillowmesh on case iso2d with sizes divided by 1, 2, 4, ..., layers only (no relocation), single thread.
// In 3D (--case linear3d) sizes are divided by powers of 2^(2/3), so that rows are as far apart in cells.
// Prints JSON.
// Usage: node bench/scaling.mjs [--max-cells N] [--repeat N] [--peers] [--case NAME] [--smooth none|end|between]
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { cpus, tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { main, Failure, root } from '../scripts/run.mjs';
import { build } from '../scripts/build.mjs';
import { peerNames, runPeer } from './peers.mjs';
import { timed } from './process.mjs';

const { values: options } = parseArgs({
  options: {
    'max-cells': { type: 'string', default: '1000000' },
    repeat: { type: 'string', default: '3' },
    case: { type: 'string', default: 'iso2d' },
    smooth: { type: 'string', default: 'none' },
    peers: { type: 'boolean', default: false },
  },
});
const maxCells = Number(options['max-cells']);
const binary = join(root, 'build', 'release', 'bin', 'pillowmesh');

/** One run of the command; the fastest of `repeat`, because a busy machine only ever makes a run slower. */
function runOwn(scale) {
  const folder = mkdtempSync(join(tmpdir(), 'pillowmesh-bench-'));
  const report = join(folder, 'report.json');
  let best = null;
  try {
    for (let i = 0; i < Number(options.repeat); ++i) {
      const { seconds, peakBytes, status, stderr } = timed(binary, ['adapt', '--case', options.case,
        '--size-scale', String(scale), '--method', 'paper', '--smooth', options.smooth, '--report', report], folder);
      if (status !== 0 && status !== 1) throw new Failure(`pillowmesh ended with status ${status}:\n${stderr}`);
      const found = JSON.parse(readFileSync(report, 'utf8'));
      const adapting = found.seconds.total - found.seconds.read - found.seconds.measure - found.seconds.write;
      if (best && adapting >= best.seconds) continue;
      const { cells } = found.mesh;
      best = {
        program: 'pillowmesh',
        scale,
        dim: found.mesh.dim,
        cells,
        seconds: adapting,
        cells_per_second: cells / adapting,
        // With start, final measuring and report: what is comparable with other programs' runs.
        process_seconds: seconds,
        process_cells_per_second: cells / seconds,
        peak_bytes_per_cell: (found.peak_memory_bytes || peakBytes) / cells,
        valid: found.valid,
        stages: found.seconds,
        operations: found.operations,
      };
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
  return best;
}

/** Each row's rate relative to the run nearest to 30 000 cells: 1 when cost grows linearly with the output. */
function addRatios(rows) {
  const distance = (row) => Math.abs(Math.log(row.cells / 30_000));
  const reference = rows.reduce((a, b) => (distance(b) < distance(a) ? b : a));
  for (const row of rows) row.rate_relative_to_30k = row.cells_per_second / reference.cells_per_second;
}

await main(async () => {
  await build('release');
  const rows = [];
  // Each step gives about four times the cells: stop before the next would pass the limit by far.
  for (let scale = 1; rows.length === 0 || rows.at(-1).cells < maxCells / 2; scale /= rows[0].dim === 3 ? 2 ** (2 / 3) : 2) {
    rows.push(runOwn(scale));
    console.error(`${rows.at(-1).cells} cells, ${Math.round(rows.at(-1).cells_per_second)} per second`);
  }
  addRatios(rows);
  const peers = [];
  if (options.peers && options.case === 'iso2d') {
    for (const name of peerNames) {
      for (const { scale } of rows) {
        const row = runPeer(name, scale);
        peers.push(row);
        const rate = Math.round(row.process_cells_per_second);
        console.error(`${name}: ${row.error ?? `${row.cells} cells, ${rate} per second`}`);
        if (row.error || row.process_seconds > 100) break;
      }
    }
  }
  const machine = { cpu: cpus()[0]?.model, node: process.version };
  const { smooth } = options;
  console.log(JSON.stringify({ case: options.case, smooth, machine, pillowmesh: rows, peers }, null, 2));
});
