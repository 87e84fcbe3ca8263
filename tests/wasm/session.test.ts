import { beforeAll, describe, expect, test } from 'vitest';
import type { Core } from '../../wasm/loader.ts';
import { CoreError, Session, cases, version } from '../../wasm/session.ts';
import { load, open, reportOf, runToEnd } from './core.ts';

let core: Core;
beforeAll(async () => {
  core = await load();
});

const unitSquare = { kind: 'grid', spec: 'grid:1,1:0,1,0,1' } as const;

/** The sentence of the refusal that the call must end in. */
function refusal(call: () => void): { status: string; message: string } {
  try {
    call();
  } catch (error) {
    if (error instanceof CoreError) return { status: error.status, message: error.message };
    throw error;
  }
  throw new Error('the call was not refused');
}

describe('the gallery', () => {
  test('lists the cases of the paper with mesh, metric and dimension', () => {
    const byName = new Map(cases(core).map((c) => [c.name, c]));
    for (const name of ['iso2d', 'aniso2d', 'circle2d']) expect(byName.get(name)?.dim).toBe(2);
    for (const name of ['linear3d', 'sphere3d-paper', 'sphere3d']) expect(byName.get(name)?.dim).toBe(3);
    expect(byName.get('riemann')).toMatchObject({ dim: 2, mesh: 'grid:16,20:0,0.8,0,1', formula: '' });
    expect(byName.get('iso2d')?.mesh).toBe('grid:7,9:0,7,0,9');
    expect(version(core)).toMatch(/^\d+\.\d+\.\d+$/);
  });

  test('every case opens and brings a metric that is usable on its mesh', () => {
    for (const { name, dim } of cases(core)) {
      const session = open(core, { kind: 'case', name });
      const report = reportOf(session);
      expect(report.valid, name).toBe(true);
      expect(report.mesh.dim, name).toBe(dim);
      expect(report.complexity, name).toBeGreaterThan(1);
      session.destroy();
    }
  }, 300_000); // the portrait's metric takes seconds, on a busy machine many

  test('the initial meshes measure as the paper printed them', () => {
    const printed = (name: string) => {
      const session = open(core, { kind: 'case', name });
      const { count, min, mean, max, cv } = reportOf(session).edge_length;
      session.destroy();
      return [count, min.toFixed(3), mean.toFixed(3), max.toFixed(2), cv.toFixed(3)];
    };
    expect(printed('iso2d')).toEqual([142, '1.000', '4.205', '20.00', '1.042']);
    expect(printed('aniso2d')).toEqual([142, '1.275', '3.875', '11.65', '0.703']);
    expect(printed('linear3d')).toEqual([300, '1.250', '2.456', '5.00', '0.497']);
  });
});

describe('what is refused is told in a sentence', () => {
  test('calls without mesh, metric or run', () => {
    const session = new Session(core);
    expect(refusal(() => session.setMetric({ formula: 'h = 1' })).message).toMatch(/mesh/i);
    session.load(unitSquare);
    expect(refusal(() => session.report()).message).toMatch(/metric/i);
    session.setMetric({ formula: 'h = 1' });
    expect(session.step()).toMatchObject({ status: 'usage', message: expect.stringMatching(/run/i) });
    session.destroy();
  });

  test('a formula with its column', () => {
    const session = open(core, unitSquare);
    const { status, message } = refusal(() => session.setMetric({ formula: 'h = 0.1 + foo' }));
    expect(status).toBe('usage');
    expect(message).toContain('column 11');
    expect(message).toContain('foo');
    expect(refusal(() => session.setMetric({ formula: 'h = 1', scale: 0 })).message).toContain('positive');
    session.destroy();
  });

  test('a metric that is not positive somewhere', () => {
    const session = open(core, unitSquare);
    expect(refusal(() => session.setMetric({ formula: 'm11 = x - 0.5; m12 = 0; m22 = 1' })).status).toBe('bad_input');
    session.destroy();
  });

  test('unknown cases, options and values', () => {
    const session = open(core, unitSquare, { formula: 'h = 1' });
    expect(refusal(() => session.load({ kind: 'case', name: 'nowhere' })).message).toContain('nowhere');
    expect(refusal(() => session.setOption('threshold', 'big')).message).toContain('big');
    expect(refusal(() => session.setOption('smooth', 'often')).message).toMatch(/none.*end.*between/);
    expect(refusal(() => session.load({ kind: 'grid', spec: 'grid:0,1:0,1,0,1' })).status).toBe('usage');
    expect(session.mesh().cells.length).toBe(4); // what was loaded is still there
    session.destroy();
  });

  test('bytes that are not of a mesh, or not all of them', () => {
    const session = open(core, unitSquare);
    const bytes = session.input();
    const load = (part: Uint8Array<ArrayBuffer>) => session.load({ kind: 'input', name: 'a.msh', bytes: part });
    expect(refusal(() => load(new Uint8Array(9))).status).toBe('usage');
    for (let n = 7; n < bytes.length; ++n) expect(refusal(() => load(bytes.slice(0, n))).status).toBe('bad_input');
    load(bytes);
    expect(session.input()).toEqual(bytes);
    session.destroy();
  });

  test('a file with its name, line and reason', () => {
    const file = (name: string, text: string) =>
      refusal(() => open(core, { kind: 'file', name, bytes: new TextEncoder().encode(text) }));
    expect(file('empty.mesh', '')).toMatchObject({
      status: 'bad_input',
      message: expect.stringContaining('empty.mesh'),
    });
    expect(file('odd.xyz', 'x')).toMatchObject({ message: expect.stringContaining('odd.xyz') });
    const triangle =
      'MeshVersionFormatted 2\nDimension 2\nVertices\n3\n0 0 0\n1 0 0\n0 1 0\nTriangles\n1\n1 2 3 0\nEnd\n';
    expect(file('tri.mesh', triangle).message).toMatch(/tri\.mesh.*riangle/s);
    const broken = 'MeshVersionFormatted 2\nDimension 2\nVertices\n2\n0 0 0\n1 zero 0\nEnd\n';
    expect(file('broken.mesh', broken).message).toMatch(/broken\.mesh, line 6/);
  });

  test('a mesh for the module of the other dimension, which is no mistake', () => {
    const hexes = open(core, { kind: 'grid', spec: 'grid:1,1,1:0,1,0,1,0,1' });
    const bytes = hexes.input();
    hexes.destroy();
    const session = new Session(core);
    for (const source of [
      { kind: 'grid', spec: 'grid:1,1,1:0,1,0,1,0,1' },
      { kind: 'grid', spec: 'ring:8,2,2:1,2,0,1' },
      { kind: 'case', name: 'linear3d' },
      { kind: 'input', name: 'cube.msh', bytes },
    ] as const)
      expect(refusal(() => session.load(source)).status).toBe('other_build');
    session.destroy();
  });

  test('cells that name points that are not there', () => {
    const session = open(core, unitSquare, { formula: 'h = 1' });
    const { message } = refusal(() => session.cellShapes(new Float64Array(4), Int32Array.of(0, 1, 2, 3)));
    expect(message).toContain('cell 0');
    session.destroy();
  });
});

describe('measures', () => {
  test('a unit square in the metric has shape 1 and edges of length 1', () => {
    const session = open(core, unitSquare, { formula: 'h1 = 0.5; h2 = 2; theta = 0' });
    const points = Float64Array.of(0, 0, 0.5, 0, 0, 2, 0.5, 2);
    const cells = Int32Array.of(0, 1, 2, 3);
    expect(session.cellShapes(points, cells)[0]).toBeCloseTo(1, 12);
    const { edges, lengths } = session.edgeLengths(points, cells);
    expect([...edges]).toEqual([0, 1, 0, 2, 1, 3, 2, 3]);
    for (const length of lengths) expect(length).toBeCloseTo(1, 12);
    session.destroy();
  });

  test('dead cells have no shape and no edges', () => {
    const session = open(core, unitSquare, { formula: 'h = 1' });
    const points = Float64Array.of(0, 0, 1, 0, 0, 1, 1, 1);
    const cells = Int32Array.of(-1, -1, -1, -1, 0, 1, 2, 3);
    expect([...session.cellShapes(points, cells)]).toEqual([NaN, expect.closeTo(1, 12)]);
    expect(session.edgeLengths(points, cells).lengths.length).toBe(4);
    session.destroy();
  });

  test('tensors are those of the formula, sizes scaled', () => {
    const session = open(core, unitSquare, { formula: 'h1 = 0.1; h2 = 1 + x; theta = 0', scale: 2 });
    const [m11, m12, m22] = session.tensors(Float64Array.of(1, 0));
    expect(m11).toBeCloseTo(25, 10);
    expect(m12).toBeCloseTo(0, 10);
    expect(m22).toBeCloseTo(1 / 16, 12);
    session.destroy();
  });

  test('hexahedra are measured like quadrilaterals', () => {
    const session = open(core, { kind: 'grid', spec: 'grid:2,1,1:0,2,0,1,0,1' }, { formula: 'h = 1' });
    const { points, cells, dim } = session.mesh();
    expect([dim, points.length, cells.length]).toEqual([3, 36, 16]);
    expect(session.edgeLengths(points, cells).lengths.length).toBe(20);
    for (const shape of session.cellShapes(points, cells)) expect(shape).toBeCloseTo(1, 12);
    session.destroy();
  });
});

describe('memory', () => {
  test('sessions give back what they took', () => {
    const once = (): void => {
      const session = open(core, { kind: 'case', name: 'aniso2d' }, undefined, { smooth: 'none' });
      runToEnd(session);
      session.takeEvents();
      session.destroy();
    };
    for (let i = 0; i < 3; ++i) once();
    const before = core.exports.memory.buffer.byteLength;
    for (let i = 0; i < 20; ++i) once();
    expect(core.exports.memory.buffer.byteLength).toBe(before);
  });
});
