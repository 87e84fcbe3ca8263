// The command and the WebAssembly module are two builds of one core, by two compilers: they must give the same bits.
import { execFile, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { loadMetrics, type Core } from '../../wasm/loader.ts';
import { makeMetric } from '../../wasm/metrics.ts';
import { cases, type Options } from '../../wasm/session.ts';
import { load, moduleBytes, modulePaths, open, reportOf, runToEnd, write, type Report } from '../wasm/core.ts';

const command = fileURLToPath(new URL('../../build/release/bin/pillowmesh', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'pillowmesh-parity-'));
const core: Core = await load();

beforeAll(() => {
  for (const file of [command, ...Object.values(modulePaths).map((path) => fileURLToPath(path))])
    if (!existsSync(file)) throw new Error(`${file} is missing; build the presets release and wasm first`);
});
afterAll(() => rmSync(folder, { recursive: true }));

const flags = (options: Options): string[] => Object.entries(options).flatMap(([name, value]) => [`--${name}`, value]);

/**
 * Starts the command, which goes on beside what is done in WebAssembly until it is awaited. A run that ends at a limit
 * (status 1) counts: its mesh is compared as well.
 */
function adaptNatively(args: string[], name: string): Promise<{ file: Buffer; report: Report }> {
  const [out, report] = [join(folder, name), join(folder, 'report.json')];
  return new Promise((resolve, reject) => {
    execFile(command, ['adapt', ...args, '-q', '-o', out, '--report', report], (error, _, stderr) => {
      if (error !== null && error.code !== 1) reject(new Error(`status ${String(error.code)}: ${stderr}`));
      else resolve({ file: readFileSync(out), report: JSON.parse(readFileSync(report, 'utf8')) as Report });
    });
  });
}

function adaptInWasm(
  source: Parameters<typeof open>[1],
  formula: string | null,
  options: Options,
  name: string,
  on: Core = core,
): { file: Uint8Array; report: Report } {
  const session = open(on, source, formula === null ? undefined : { formula }, options);
  runToEnd(session);
  const result = { file: write(session, name), report: reportOf(session) };
  session.destroy();
  return result;
}

const text = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);

/** What both reports must agree in to the last bit; times and memory differ. */
const numbers = ({ mesh, edge_length, shape, irregular_vertices, complexity, valid }: Report): object => ({
  mesh,
  edge_length,
  shape,
  irregular_vertices,
  complexity,
  valid,
});

describe('native and WebAssembly give the same mesh and the same numbers', () => {
  for (const { name } of cases(core))
    test(`case ${name}`, async () => {
      // The portrait's 6000 cells would take a minute: up to a limit the same bits are as telling.
      const options: Options = { 'max-cells': name === 'riemann' ? '1500' : '12000', effort: 'fast' };
      const running = adaptNatively(['--case', name, ...flags(options)], 'mesh.vtu');
      const wasm = adaptInWasm({ kind: 'case', name }, null, options, 'mesh.vtu');
      const native = await running;
      expect(text(wasm.file) === text(native.file)).toBe(true);
const { layers, relocations } = native.report.operations;
      expect(layers + relocations, 'a run that does something').toBeGreaterThan(0);
      expect(numbers(wasm.report)).toEqual(numbers(native.report));
    }, 300_000);

  for (const name of ['iso2d', 'aniso2d', 'circle2d'])
    test(`case ${name} by the paper's method, in the module for that alone`, async () => {
      const options: Options = { method: 'paper' };
      const running = adaptNatively(['--case', name, ...flags(options)], 'mesh.vtu');
      const wasm = adaptInWasm({ kind: 'case', name }, null, options, 'mesh.vtu', await load(2));
      const native = await running;
      expect(text(wasm.file) === text(native.file)).toBe(true);
      expect(numbers(wasm.report)).toEqual(numbers(native.report));
    });

  const variants: Options[] = [
    { effort: 'normal' },
    { smooth: 'none' },
    { smooth: 'between' },
    { dice: '2', threshold: '1.7' },
    { thickness: '2', augment: '0' },
  ];
  for (const options of variants)
    test(`circle2d with ${flags(options).join(' ')}`, async () => {
      const running = adaptNatively(['--case', 'circle2d', ...flags(options)], 'mesh.mesh');
      const wasm = adaptInWasm({ kind: 'case', name: 'circle2d' }, null, options, 'mesh.mesh');
      const native = await running;
      expect(text(wasm.file) === text(native.file)).toBe(true);
    });

  for (const name of ['plate_hole_v4.msh', 'annulus_v2.msh', 'lshape_v2.msh'])
    test(`the file ${name}, its groups and their names`, () => {
      const [path, out] = [fileURLToPath(new URL(`../data/${name}`, import.meta.url)), join(folder, name)];
      expect(spawnSync(command, ['convert', path, out]).status).toBe(0);
      const session = open(core, { kind: 'file', name, bytes: readFileSync(path) });
      expect(text(write(session, name)) === readFileSync(out, 'utf8')).toBe(true);
      session.destroy();
    });

  test('a formula of every function, on a mesh that comes as a file', async () => {
    const formula =
      'a = 0.02 + 0.05*abs(sin(3*x)*cos(2*y)) + 0.01*exp(-x^2)*tanh(y) + 0.01*log(2 + x);' +
      'theta = atan2(y - 0.3, x + 0.2) + 0.1*asin(0.5*x) - 0.1*acos(0.5*y);' +
      'h1 = max(a, 0.03) + 0.01*floor(2*x); h2 = min(2*h1, sqrt(0.04 + pow(x, 2.5)) + tan(0.1*y))';
    const path = join(folder, 'start.msh');
    const start = open(core, { kind: 'grid', spec: 'grid:6,5:0,1,0,1' });
    const bytes = write(start, 'start.msh');
    expect(spawnSync(command, ['convert', 'grid:6,5:0,1,0,1', path]).status).toBe(0);
    expect(text(readFileSync(path)) === text(bytes)).toBe(true);
    const running = adaptNatively([path, '--metric', formula], 'mesh.msh');
    const wasm = adaptInWasm({ kind: 'file', name: 'start.msh', bytes }, formula, {}, 'mesh.msh');
    const native = await running;
    expect(text(wasm.file) === text(native.file)).toBe(true);
    expect(numbers(wasm.report)).toEqual(numbers(native.report));
  });

  test('a metric made of dabs, a function and a wall, graded, to a number of cells', async () => {
    const mesh = open(await load(2), { kind: 'grid', spec: 'grid:6,5:0,1,0,1' });
    const nodal = makeMetric(await loadMetrics(moduleBytes('metrics')), mesh.input(), {
      hessianOf: 'tanh(5*(x + sin(2*y) - 1))',
      dabs: [{ x: 0.3, y: 0.4, radius: 0.1, size: 0.05 }],
      layers: ['ymin:0.01:1.3'],
      operations: { 'target-cells': '400', gradation: '1.4', hmin: '0.004' },
    });
    mesh.setMetric({ nodal });
    const found = reportOf(mesh);
    mesh.destroy();
    writeFileSync(join(folder, 'dabs.txt'), '0.3 0.4 0.1 0.05\n');
    const sources = ['--hessian-of', 'tanh(5*(x + sin(2*y) - 1))', '--sketch', join(folder, 'dabs.txt')];
    const operations = ['--boundary-layer', 'ymin:0.01:1.3', '--gradation', '1.4', '--hmin', '0.004'];
    // Measured, not adapted: to a number of cells the command adapts more than once.
    const run = ['measure', 'grid:6,5:0,1,0,1', ...sources, ...operations, '--target-cells', '400', '--report', '-'];
    const native = spawnSync(command, run, { encoding: 'utf8' });
    expect(native.stderr).toBe('');
    expect(numbers(found)).toEqual(numbers(JSON.parse(native.stdout) as Report));
    expect(found.complexity).toBeCloseTo(400, -1);
  });
});
