// The real command: exit status, messages, files. Needs build/release/bin/pillowmesh, or $PILLOWMESH_BIN.
import { spawn, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { setTimeout as sleep } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';

const root = fileURLToPath(new URL('../..', import.meta.url));
const command = process.env.PILLOWMESH_BIN ?? join(root, 'build', 'release', 'bin', 'pillowmesh');
const data = (name: string) => join(root, 'tests', 'data', name);

let folder = '';
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'pillowmesh_cli_'));
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));
const file = (name: string) => join(folder, name);

function pillowmesh(...args: string[]) {
  const done = spawnSync(command, args, { encoding: 'utf8', cwd: folder, timeout: 50_000, maxBuffer: 1 << 26 });
  if (done.error) throw done.error;
  return { status: done.status, out: done.stdout, err: done.stderr };
}

/** Runs what must succeed. */
function ok(...args: string[]) {
  const done = pillowmesh(...args);
  expect(done.err).toBe('');
  expect(done.status).toBe(0);
  return done.out;
}

/** Expects an exit status and one line on stderr that holds all of `parts`. */
function refused(status: number, args: string[], ...parts: string[]) {
  const done = pillowmesh(...args);
  expect(done.status, done.err).toBe(status);
  expect(done.out).toBe('');
  expect(done.err).toMatch(/^pillowmesh: .+\n$/);
  for (const part of parts) expect(done.err).toContain(part);
}

interface Statistics {
  count: number;
  min: number;
  mean: number;
  max: number;
  cv: number;
}
interface Report {
  mesh: { dim: number; vertices: number; edges: number; cells: number };
  edge_length: Statistics & { share_in_range: number };
  shape: Statistics;
  complexity: number;
  valid: boolean;
  seconds: Record<string, number>;
  peak_memory_bytes: number;
  operations: Record<string, number>;
}
const report = (...args: string[]) => JSON.parse(ok(...args, '--report', '-')) as Report;

/** Numbers of quads and of boundary lines by group in a VTU file written as text. */
function vtu(path: string) {
  const text = readFileSync(path, 'utf8');
  const array = (name: string) =>
    (new RegExp(`Name="${name}"[^>]*>([^<]*)<`).exec(text)?.[1] ?? '').trim().split(/\s+/).map(Number);
  const types = array('types');
  const group = array('group');
  const lines: Record<number, number> = {};
  types.forEach((type, i) => {
    const g = group[i] ?? -1;
    if (type === 3) lines[g] = (lines[g] ?? 0) + 1;
  });
  return { quads: types.filter((t) => t === 9).length, lines };
}

describe('help', () => {
  test('--version prints name and version', () => {
    expect(ok('--version')).toMatch(/^pillowmesh \d+\.\d+\.\d+\n$/);
  });

  test.each([[[]], [['adapt']], [['measure']], [['metric']], [['convert']], [['cases']]])('--help of %j shows an example', (names) => {
    expect(ok(...names, '--help')).toMatch(/Examples?:\n {2}pillowmesh/);
  });

  test('--help of adapt names every option', () => {
    const help = ok('adapt', '--help');
    const options = 'metric case size-scale method threshold smooth dice thickness augment max-cells steps report output';
    for (const option of options.split(' ')) expect(help).toContain(`--${option}`);
  });

  test('every example of the help is understood', () => {
    for (const name of ['adapt', 'measure', 'convert']) {
      const examples = ok(name, '--help').split('\n').filter((line) => line.startsWith('  pillowmesh '));
      expect(examples.length).toBeGreaterThan(0);
      for (const example of examples) {
        const words = [...example.trim().matchAll(/"([^"]*)"|(\S+)/g)].map((m) => m[1] ?? m[2] ?? '').slice(1);
        // Understood: it runs, or it misses only the example's file.
        const { status, err } = pillowmesh(...words);
        if (status !== 0) expect(err).toMatch(/(plate\.\w+|out\.vtu): cannot be read/);
      }
    }
  });

  test('cases lists the cases of the paper with mesh and metric', () => {
    const text = ok('cases');
    for (const name of ['iso2d', 'aniso2d', 'circle2d']) expect(text).toContain(name);
    expect(text).toContain('grid:7,9:0,7,0,9');
  });
});

describe('usage errors have exit status 2', () => {
  const grid = 'grid:2,2:0,1,0,1';
  const metric = ['--metric', 'h = 0.3'];
  test.each<[string, string[], string[]]>([
    ['no subcommand', [], ['subcommand']],
    ['an unknown subcommand', ['adpat'], ["did you mean 'adapt'?"]],
    ['an unknown option', ['adapt', '--case', 'iso2d', '--colour', 'red'], ['--colour', 'pillowmesh adapt --help']],
    ['a background without a metric file', ['adapt', '--case', 'iso2d', '--background', 'a.mesh'], ['--metric-file']],
    ['a Hessian without a number of cells', ['measure', grid, '--hessian-of', 'x^2'], ['--target-cells N or --error E']],
    ['a mistake in a function', ['measure', grid, '--hessian-of', 'x^2 + w', '--error', '1'], ['column 7', "'w'"]],
    ['a boundary group that is not there', ['measure', grid, '--boundary-layer', 'inlet:0.1:1.2'], ["'inlet'", 'xmin']],
    ['a picture on hexahedra', ['measure', 'grid:1,1,1:0,1,0,1,0,1', '--metric-image', 'a.png'], ['two-dimensional']],
    ['a gradation of 1', ['adapt', '--case', 'iso2d', '--gradation', '1'], ['--gradation', 'above 1']],
    ['bounds the wrong way round', ['measure', '--case', 'iso2d', '--hmin', '2', '--hmax', '1'], ['--hmin is above --hmax']],
    ['a number of cells beyond the bounds', ['measure', '--case', 'iso2d', '--hmin', '1', '--target-cells', '1e5'], ['about 63 cells']],
    ['a metric written as .vtk', ['metric', '--case', 'iso2d', '-o', 'a.vtk'], ['.sol']],
    ['the paper’s options with the other method', ['adapt', '--case', 'iso2d', '--method', 'full', '--dice', '2'], ['--dice', '--method paper']],
    ['an unknown effort', ['adapt', '--case', 'iso2d', '--effort', 'more'], ['fast, normal, best', "'more'"]],
    ['an unknown method', ['adapt', '--case', 'iso2d', '--method', 'magic'], ['--method', 'paper', "'magic'"]],
    ['an unknown smoothing', ['adapt', '--case', 'iso2d', '--smooth', 'often'], ['none, end, between', "'often'"]],
    ['a threshold that is no number', ['adapt', '--case', 'iso2d', '--threshold', 'x'], ['--threshold', "'x'"]],
    ['dice 0', ['adapt', '--case', 'iso2d', '--dice', '0'], ['--dice', "'0'"]],
    ['no metric', ['adapt', grid], ['--metric', '--case NAME']],
    ['no mesh', ['adapt', ...metric], ['a mesh is missing']],
    ['metric and case', ['adapt', grid, ...metric, '--case', 'iso2d'], ['exclude each other']],
    ['an unknown case', ['measure', '--case', 'isod2d'], ["no case 'isod2d'", "did you mean 'iso2d'?", 'circle2d']],
    ['a case of another dimension', ['measure', 'grid:2,2,2:0,1,0,1,0,1', '--case', 'iso2d'], ['2-dimensional']],
    ['a malformed formula', ['measure', grid, '--metric', 'h = 0.1 + * x'], ['column 11']],
    ['a malformed grid', ['measure', 'grid:2,2:0,1,0', ...metric], ['grid']],
    ['a size scale of 0', ['measure', '--case', 'iso2d', '--size-scale', '0'], ['--size-scale']],
    ['an unknown ending', ['convert', grid, 'a.stl'], ["'.stl'", '.vtu']],
    ['an output folder that is not there', ['convert', grid, 'none/a.vtu'], ['none/a.vtu', 'no folder']],
    ['a binary .mesh', ['convert', grid, 'a.mesh', '--binary'], ['.meshb']],
    ['an unknown Gmsh version', ['convert', grid, 'a.msh', '--gmsh-version', '3'], ['2.2 or 4.1']],
    ['an argument too many', ['convert', grid, 'a.msh', 'b.msh'], ['b.msh']],
  ])('%s', (_name, args, parts) => refused(2, args, ...parts));

  test('the output is never the input', () => {
    ok('convert', grid, file('same.msh'));
    const before = readFileSync(file('same.msh'), 'utf8');
    refused(2, ['convert', file('same.msh'), file('same.msh')], 'is the input file');
    refused(2, ['adapt', file('same.msh'), ...metric, '-o', `${folder}/./same.msh`], 'is the input file');
    refused(2, ['measure', file('same.msh'), ...metric, '--report', file('same.msh')], 'is the input file');
    expect(readFileSync(file('same.msh'), 'utf8')).toBe(before);
  });
});

describe('bad input has exit status 3 and one sentence with file, place and reason', () => {
  const metric = ['--metric', 'h = 0.3'];
  test('quads mixed with triangles', () => {
    refused(3, ['adapt', data('mixed_tri_quad_v2.msh'), ...metric], 'mixed_tri_quad_v2.msh, line 95', '17 triangles');
  });

  test('a file that is not there, and a folder', () => {
    refused(3, ['measure', 'none.msh', ...metric], 'none.msh: cannot be read');
    refused(3, ['measure', `${folder}/../`, ...metric], 'no ending');
  });

  test.each<[string, (text: string) => string, string[]]>([
    ['truncated', (text) => text.slice(0, text.length / 2), ['line', 'truncated']],
    ['empty', () => '', ['empty']],
    ['inverted', (text) => text.replace(/^(100 3 .*) (\d+) (\d+) (\d+) (\d+)$/m, '$1 $5 $4 $3 $2'), ['line']],
    ['degenerate', (text) => text.replace(/^(100 3 .*) (\d+) (\d+) (\d+) (\d+)$/m, '$1 $2 $3 $4 $2'), ['line', 'twice']],
    ['with a vertex out of range', (text) => text.replace(/^(100 3 .*) (\d+)$/m, '$1 9999'), ['line', 'node 9999']],
    ['with a coordinate that is no number', (text) => text.replace('\n7 ', '\n7 nan '), ['line']],
    ['with a count that lies', (text) => text.replace('$Nodes\n', '$Nodes\n99999999'), ['line', 'promises']],
  ])('a file that is %s', (name, change, parts) => {
    const path = file(`${name.replaceAll(' ', '_')}.msh`);
    const text = readFileSync(data('lshape_v2.msh'), 'utf8');
    const changed = change(text);
    expect(changed).not.toBe(text);
    writeFileSync(path, changed);
    refused(3, ['adapt', path, ...metric, '-o', file('never.vtu')], path, ...parts);
    expect(existsSync(file('never.vtu'))).toBe(false);
  });

  test('a hanging node', () => {
    const path = file('hanging.mesh');
    const points = '0 0 0\n1 0 0\n2 0 0\n1 .5 0\n2 .5 0\n1 1 0\n2 1 0\n0 1 0\n';
    const quads = '1 2 6 8 0\n2 3 5 4 0\n4 5 7 6 0\n';
    writeFileSync(path, `MeshVersionFormatted 2\nDimension 2\nVertices\n8\n${points}Quadrilaterals\n3\n${quads}End\n`);
    refused(3, ['measure', path, ...metric], path, 'hang');
  });

  test('a metric that is not positive somewhere', () => {
    refused(3, ['adapt', 'grid:4,4:0,1,0,1', '--metric', 'h = x - 0.5', '-o', file('never.vtu')]);
    expect(existsSync(file('never.vtu'))).toBe(false);
  });
});

describe('measure', () => {
  test('prints the paper\'s initial row of case 1', () => {
    expect(ok('measure', '--case', 'iso2d')).toMatch(/edge length l +142 +1 +4\.205 +20 +1\.042/);
  });

  test('writes the same numbers as JSON to a file and to stdout', () => {
    const table = ok('measure', '--case', 'aniso2d', '--report', file('report.json'));
    expect(table).toContain('63 quads');
    const written = JSON.parse(readFileSync(file('report.json'), 'utf8')) as Report;
    expect(written.mesh).toEqual({ dim: 2, vertices: 80, edges: 142, cells: 63 });
    expect(written.valid).toBe(true);
    expect(written.seconds.total).toBeGreaterThan(0);
    expect(written.peak_memory_bytes).toBeGreaterThan(1e6);
    expect(report('measure', '--case', 'aniso2d').edge_length).toEqual(written.edge_length);
  });

  test('--size-scale 2 halves every length', () => {
    const one = report('measure', '--case', 'iso2d');
    const two = report('measure', '--case', 'iso2d', '--size-scale', '2');
    expect(two.edge_length.max).toBeCloseTo(one.edge_length.max / 2, 9);
    expect(two.complexity).toBeCloseTo(one.complexity / 4, 6);
  });

  test('takes hexahedra', () => {
    expect(report('measure', 'grid:2,2,2:0,1,0,1,0,1', '--metric', 'h = 0.5').mesh.cells).toBe(8);
  });
});

describe('convert', () => {
  test.each(['a.mesh', 'a.meshb', 'a.msh', 'a.vtk', 'a.vtu'])('keeps the groups of the boundary by way of %s', (name) => {
    ok('convert', data('lshape_v4.msh'), file(name));
    ok('convert', file(name), file('back.vtu'));
    expect(vtu(file('back.vtu'))).toEqual({ quads: 108, lines: { 2: 10, 3: 34 } });
  });

  test('writes the variant that is asked for', () => {
    const start = (name: string, ...options: string[]) => {
      ok('convert', data('lshape_v4.msh'), file(name), ...options);
      return readFileSync(file(name), 'latin1').slice(0, 25);
    };
    expect(start('v.msh')).toContain('4.1 0 8');
    expect(start('v.msh', '--binary')).toContain('4.1 1 8');
    expect(start('v.msh', '--gmsh-version', '2.2')).toContain('2.2 0 8');
    expect(start('v.msh', '--gmsh-version', '2.2', '--binary')).toContain('2.2 1 8');
  });

  test('gives the same bytes each time', () => {
    ok('convert', data('plate_hole_v4.msh'), file('one.vtu'));
    ok('convert', data('plate_hole_v4.msh'), file('two.vtu'));
    expect(readFileSync(file('two.vtu'))).toEqual(readFileSync(file('one.vtu')));
  });
});

describe('metrics from functions, pictures, sketches, walls and meshes', () => {
  const measured = (...args: string[]) => JSON.parse(ok('measure', ...args, '--report', '-')) as Report;
  const pgm = (name: string, pixel: (x: number, y: number) => number) => {
    const n = 48;
    const pixels = Uint8Array.from({ length: n * n }, (_, k) => 255 * pixel((k % n) / n, Math.floor(k / n) / n));
    writeFileSync(file(name), Buffer.concat([Buffer.from(`P5\n${n} ${n}\n255\n`), pixels]));
    return file(name);
  };

  test('the Hessian of a function, as a formula and recovered from its values', () => {
    const of = ['--target-cells', '400', '--gradation', '2'];
    const exact = measured('grid:10,10:0,1,0,1', '--hessian-of', 'sin(4*x)*cos(3*y) + x^2', ...of);
    expect(exact.complexity).toBeCloseTo(400, -1);
    ok('convert', 'grid:60,60:0,1,0,1', file('u.mesh'));
    const values = Array.from({ length: 61 * 61 }, (_, k) => Math.sin((4 * (k % 61)) / 60) * Math.cos((3 * Math.floor(k / 61)) / 60) + ((k % 61) / 60) ** 2);
    writeFileSync(file('u.sol'), `MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n${values.length}\n1 1\n${values.join('\n')}\nEnd\n`);
    const found = measured('grid:10,10:0,1,0,1', '--hessian-file', file('u.sol'), '--background', file('u.mesh'), ...of);
    expect(found.edge_length.mean / exact.edge_length.mean).toBeCloseTo(1, 1);
  });

  test('a picture makes cells; one colour and what is no picture are refused', () => {
    const disc = pgm('disc.pgm', (x, y) => (Math.hypot(x - 0.5, y - 0.5) < 0.3 ? 1 : 0));
    expect(measured('grid:4,4:0,1,0,1', '--metric-image', disc, '--target-cells', '1000').complexity).toBeCloseTo(1000, -1);
    refused(3, ['measure', 'grid:4,4:0,1,0,1', '--metric-image', pgm('one.pgm', () => 0.5)], 'one.pgm', 'one colour');
    writeFileSync(file('no.png'), 'no picture');
    refused(3, ['measure', 'grid:4,4:0,1,0,1', '--metric-image', file('no.png')], 'no.png', 'PNG');
  });

  test('a sketch makes small cells where it says, and its mistakes are named by line', () => {
    writeFileSync(file('s.txt'), '# x y radius size\n0.5 0.5 0.2 0.02\n0.2, 0.8, 0.1, 0.01, 45, 4\n');
    expect(measured('grid:4,4:0,1,0,1', '--sketch', file('s.txt')).complexity).toBeGreaterThan(300);
    writeFileSync(file('bad.txt'), '0.5 0.5 0.2 0.02\n0.5 0.5\n');
    refused(3, ['measure', 'grid:4,4:0,1,0,1', '--sketch', file('bad.txt')], 'bad.txt, line 2', 'x y radius size');
  });

  test('layers at walls, curvature, and the metric that a mesh has', () => {
    const layered = measured('grid:10,100:0,1,0,1', '--boundary-layer', 'ymin:0.01:1', '--hmax', '0.1');
    expect(layered.edge_length.mean).toBeCloseTo(1, 1); // 100 rows of height 0.01
    expect(measured('ring:36,2:1,2', '--curvature', '36').edge_length.min).toBeGreaterThan(0.75);
    const own = measured('grid:7,3:0,1,0,2', '--metric-of', 'grid:7,3:0,1,0,2');
    expect(own.edge_length.cv).toBeLessThan(1e-6);
    expect(own.edge_length.mean).toBeCloseTo(1, 6);
  });
});

describe('operations on metrics', () => {
  test.each([
    ['full', ['--case', 'iso2d', '--effort', 'fast']],
    ['paper', ['--case', 'iso2d', '--method', 'paper']],
    ['full with bounds', ['--case', 'iso2d', '--effort', 'fast', '--hmin', '0.1', '--gradation', '1.3']],
  ])('--target-cells is met within 5 %% by method %s', (_name, args) => {
    const report = JSON.parse(ok('adapt', ...args, '--target-cells', '500', '--report', '-')) as Report;
    expect(report.mesh.cells).toBeGreaterThanOrEqual(475);
    expect(report.mesh.cells).toBeLessThanOrEqual(525);
    expect(report.valid).toBe(true);
  });

  test('a metric of a billion cells stops at --max-cells with a valid mesh and status 1', () => {
    const done = pillowmesh('adapt', 'grid:4,4:0,1,0,1', '--metric', 'h = 0.5', '--target-cells', '1e9', '--max-cells', '20000',
      '-o', file('most.mesh'));
    expect(done.status).toBe(1);
    expect(done.err).toContain('20000 cells');
    const report = JSON.parse(ok('measure', file('most.mesh'), '--metric', 'h = 1', '--report', '-')) as Report;
    expect(report.valid).toBe(true);
    expect(report.mesh.cells).toBeLessThanOrEqual(20000);
  });
});

describe('metric files', () => {
  const grid = 'grid:30,30:0,1,0,1';
  const formula = ['--metric', 'h1 = 0.1 + 0.2*x; h2 = 0.2; theta = y'];

  test('a metric written at the vertices of a mesh measures as the formula that it samples', () => {
    ok('metric', grid, ...formula, '-o', file('a.sol'));
    ok('convert', grid, file('a.mesh'));
    const of = (...args: string[]) => JSON.parse(ok('measure', ...args, '--report', '-')) as Report;
    const exact = of('grid:4,4:0,1,0,1', ...formula);
    for (const background of [grid, file('a.mesh')]) {
      const sampled = of('grid:4,4:0,1,0,1', '--metric-file', file('a.sol'), '--background', background);
      expect(sampled.complexity).toBeCloseTo(exact.complexity, 1);
      expect(sampled.edge_length.mean).toBeCloseTo(exact.edge_length.mean, 3);
    }
    const own = of(file('a.mesh'), '--metric-file', file('a.sol')); // the background is the input
    expect(own.complexity).toBeCloseTo(exact.complexity, 1);
  });

  test('triangles and tetrahedra are backgrounds though they cannot be adapted', () => {
    const head = 'MeshVersionFormatted 2\nDimension 2\n';
    writeFileSync(file('t.mesh'), `${head}Vertices\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nTriangles\n2\n1 2 3 0\n1 3 4 0\nEnd\n`);
    writeFileSync(file('t.sol'), `${head}SolAtVertices\n4\n1 1\n0.5\n0.5\n0.5\n0.5\nEnd\n`);
    const report = JSON.parse(
      ok('measure', 'grid:2,2:0,1,0,1', '--metric-file', file('t.sol'), '--background', file('t.mesh'), '--report', '-'),
    ) as Report;
    expect(report.complexity).toBeCloseTo(4, 6);
    expect(report.edge_length.max).toBeCloseTo(1, 6);
    refused(3, ['measure', file('t.mesh'), '--metric-file', file('t.sol')], 'triangles');
  });

  test('a .sol of another mesh, or with a bad tensor, is refused with a sentence', () => {
    const head = 'MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n';
    const use = (text: string) => {
      writeFileSync(file('bad.sol'), head + text);
      return ['adapt', 'grid:1,1:0,1,0,1', '--metric-file', file('bad.sol')];
    };
    refused(3, use('3\n1 1\n1 1 1\nEnd\n'), 'bad.sol', '3 vertices', 'has 4', '--background');
    refused(3, use('4\n1 3\n1 0 1  1 0 1  1 2 1  1 0 1\nEnd\n'), 'bad.sol, line 6', 'vertex 3', 'positive definite');
    refused(3, use('4\n1 1\n1 0 1 1\nEnd\n'), 'vertex 2', 'size 0');
    refused(3, ['adapt', 'grid:1,1:0,1,0,1', '--metric-file', file('none.sol')], 'none.sol: cannot be read');
  });
});

describe('adapt', () => {
  test('refines a Gmsh file to a metric: valid, groups kept, table and report', () => {
    const metric = 'h = 0.03 + 0.1*abs(x)';
    const out = ok('adapt', data('lshape_v2.msh'), '--metric', metric, '-o', file('out.vtu'), '--report', file('r.json'));
    expect(out).toContain('valid: conforming');
    expect(out).toMatch(/edge length l +initial +238 /);
    expect(out).toMatch(/time \d+\.\d\d s/);
    const done = JSON.parse(readFileSync(file('r.json'), 'utf8')) as Report;
    expect(done.valid).toBe(true);
    expect(done.operations.layers).toBeGreaterThan(0);
    expect(done.seconds.total).toBeGreaterThan(0);
    const { quads, lines } = vtu(file('out.vtu'));
    expect(quads).toBe(done.mesh.cells);
    expect(quads).toBeGreaterThan(108);
    expect(Object.keys(lines)).toEqual(['2', '3']);
    expect(lines[2]).toBeGreaterThanOrEqual(10);
    expect(report('measure', file('out.vtu'), '--metric', metric).edge_length).toEqual(done.edge_length);
  });

  test('prints nothing but JSON with --report -, and nothing at all with --quiet', () => {
    expect(report('adapt', '--case', 'aniso2d').valid).toBe(true);
    expect(ok('adapt', '--case', 'aniso2d', '--quiet')).toBe('');
  });

  test('--steps writes the mesh after each iteration, the first as given and the last as the result', () => {
    ok('adapt', '--case', 'iso2d', '--steps', file('all-steps'), '-o', file('last.vtu'));
    const names = readdirSync(file('all-steps')).sort();
    expect(names[0]).toBe('step-000.vtu');
    expect(names.length).toBeGreaterThan(2);
    const counts = names.map((name) => vtu(join(file('all-steps'), name)).quads);
    expect(counts[0]).toBe(63);
    const refined = counts.slice(0, -1); // full adaptation coarsens at the end
    expect([...refined].sort((a, b) => a - b)).toEqual(refined);
    const last = readFileSync(join(file('all-steps'), names.at(-1) ?? ''));
    expect(last.equals(readFileSync(file('last.vtu')))).toBe(true);
    for (const name of names) expect(ok('measure', join(file('all-steps'), name), '--case', 'iso2d')).toContain('valid:');
  });

  test('a limit that stops the run gives exit status 1 and a valid mesh', () => {
    const done = pillowmesh('adapt', '--case', 'iso2d', '--max-cells', '300', '-o', file('limited.vtu'));
    expect(done.status).toBe(1);
    expect(done.err).toMatch(/^pillowmesh: .*300 cells.*\n$/);
    const limited = report('measure', file('limited.vtu'), '--case', 'iso2d');
    expect(limited.valid).toBe(true);
    expect(limited.mesh.cells).toBeLessThanOrEqual(300);
  });

  test('full adaptation with the same seed writes the same file', () => {
    const adapt = (seed: string, name: string): Buffer => {
      ok('adapt', '--case', 'aniso2d', '--effort', 'fast', '--seed', seed, '-o', file(name));
      return readFileSync(file(name));
    };
    const first = adapt('1', 'seed1.mesh');
    expect(adapt('1', 'again.mesh').equals(first)).toBe(true);
  });

  test('the options of the method are heard', () => {
    const cells = (...options: string[]) => report('adapt', '--case', 'iso2d', '--smooth', 'none', ...options).mesh.cells;
    const plain = cells();
    expect(cells('--threshold', '4')).toBeLessThan(plain);
    expect(cells('--augment', '3')).not.toBe(plain);
    expect(cells('--dice', '2') % 4).toBe(0);
    expect(cells('--method', 'paper')).toBe(plain);
  });

  test('a failed run leaves an existing output as it was', () => {
    writeFileSync(file('kept.vtu'), 'precious');
    pillowmesh('adapt', data('mixed_tri_quad_v2.msh'), '--metric', 'h = 1', '-o', file('kept.vtu'));
    expect(readFileSync(file('kept.vtu'), 'utf8')).toBe('precious');
  });

  test('Ctrl-C stops with exit status 1, one sentence and a valid mesh', async () => {
    const args = ['adapt', '--case', 'iso2d', '--size-scale', '0.02', '-o', file('stopped.vtu')];
    const child = spawn(command, args, { cwd: folder });
    let err = '';
    child.stderr.on('data', (text: Buffer) => (err += text.toString()));
    const ended = new Promise<number | null>((resolve) => child.on('exit', (status) => resolve(status)));
    await sleep(700);
    expect(child.exitCode, 'the run should still be going').toBeNull();
    child.kill('SIGINT');
    expect(await ended).toBe(1);
    expect(err).toMatch(/^pillowmesh: .*valid.*\n$/);
    expect(report('measure', file('stopped.vtu'), '--metric', 'h = 1').valid).toBe(true);
    expect(readdirSync(folder).filter((name) => name.includes('.part'))).toEqual([]);
  });

  const terminals = spawnSync('script', ['--version']).status === 0;
  test.skipIf(!terminals)('a progress line is drawn on a terminal, and cleared', () => {
    const line = `${command} adapt --case iso2d`;
    const onTerminal = (options: string) => spawnSync('script', ['-qec', line + options, '/dev/null'], { encoding: 'utf8' });
    const shown = onTerminal('');
    expect(shown.stdout).toMatch(/\r +\d+ % .* cells\x1b\[K/);
    expect(shown.stdout).toContain('\r\x1b[K');
    expect(onTerminal(' --quiet').stdout).toBe('');
  });
});

describe('boundaries and fields', () => {
  const radii = (mesh: string) => {
    const lines = readFileSync(mesh, 'utf8').split('\n');
    const first = lines.indexOf('Vertices') + 2;
    const count = Number(lines[first - 1]);
    const points = lines.slice(first, first + count).map((line) => line.split(' ').map(Number));
    return points.map(([x = 0, y = 0]) => Math.hypot(x - 1.2, y - 1));
  };

  test('smooth geometry puts a hole on its circle, linear geometry on the polygon of the input', () => {
    const adapt = (geometry: string) => {
      const out = file(`hole-${geometry}.mesh`);
      ok('adapt', data('plate_hole_v4.msh'), '--metric', 'h = 0.1', '--effort', 'fast', '--geometry', geometry, '-o', out, '-q');
      return Math.min(...radii(out));
    };
    expect(adapt('smooth')).toBeCloseTo(0.4, 12);
    expect(adapt('linear')).toBeLessThan(0.39);
    refused(2, ['adapt', 'grid:2,2:0,1,0,1', '--metric', 'h = 1', '--geometry', 'round'], '--geometry', "'round'");
  });

  test('a frozen group keeps its edges; a group that is not there is named with those that are', () => {
    const out = file('frozen.mesh');
    refused(
      1,
      ['adapt', data('lshape_v4.msh'), '--metric', 'h = 0.09', '--freeze', 'inflow', '-o', out, '-q'],
      'edges are longer than the threshold, but frozen',
    );
    expect(readFileSync(out, 'utf8')).toContain('RequiredEdges');
    refused(2, ['adapt', data('lshape_v4.msh'), '--metric', 'h = 1', '--freeze', 'outlet'], 'outlet', 'inflow');
  });

  test('fields of a VTK file go to the adapted one, unless they are not wanted', () => {
    const square = file('field.vtk');
    writeFileSync(
      square,
      '# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 0 1 1 0 0 1 0\n' +
        'CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n9\nPOINT_DATA 4\nSCALARS heat double 1\nLOOKUP_TABLE default\n0 1 3 2\n',
    );
    const [out, report] = [file('field-out.vtu'), file('field.json')];
    const told = ok('adapt', square, '--metric', 'h = 0.3', '-o', out, '--report', report);
    expect(told).toContain('carried 1 field of points');
    expect(JSON.parse(readFileSync(report, 'utf8')).fields.points.heat).toMatch(/multilinear.*h\^2\/8/);
    expect(readFileSync(file('field-out.vtu'), 'utf8')).toContain('Name="heat"');
    ok('adapt', square, '--metric', 'h = 0.3', '-o', file('field-none.vtu'), '--no-fields');
    expect(readFileSync(file('field-none.vtu'), 'utf8')).not.toContain('heat');
  });
});
