// The module that makes metrics, and a session that takes them.
import { expect, test } from 'vitest';
import { loadMetrics } from '../../wasm/loader.ts';
import { makeMetric, type MetricRequest } from '../../wasm/metrics.ts';
import { CoreError, Session } from '../../wasm/session.ts';
import { load, moduleBytes } from './core.ts';

const metrics = await loadMetrics(moduleBytes('metrics'));
const flat = await load(2);
const solid = await load(3);

function grid(spec: string): Session {
  const session = new Session(spec.split(',').length > 4 && spec.split(':')[1].split(',').length === 3 ? solid : flat);
  session.load({ kind: 'grid', spec });
  return session;
}
/** The metric at points of the unit square or cube. */
function tensors(request: MetricRequest, points: number[], spec = 'grid:4,4:0,1,0,1'): Float64Array {
  const session = grid(spec);
  session.setMetric({ nodal: makeMetric(metrics, session.input(), request) });
  const found = session.tensors(Float64Array.from(points));
  session.destroy();
  return found;
}
function refusal(request: MetricRequest, spec = 'grid:4,4:0,1,0,1'): string {
  const session = grid(spec);
  try {
    makeMetric(metrics, session.input(), request);
  } catch (error) {
    if (error instanceof CoreError) return error.message;
    throw error;
  } finally {
    session.destroy();
  }
  return '';
}
const text = (...lines: string[]): Uint8Array => new TextEncoder().encode(lines.join('\n'));
const size = (m: number): number => 1 / Math.sqrt(m);

test('formulas, dabs and walls intersect', () => {
  const request = { formula: 'h = 0.1', dabs: [{ x: 0.5, y: 0.5, radius: 0.1, size: 0.01 }], layers: ['ymin:0.002:1.2'] };
  const m = tensors(request, [0.5, 0.5, 0.05, 0.9, 0.1, 0]);
  expect(size(m[0])).toBeCloseTo(0.01, 4);
  expect(size(m[3])).toBeCloseTo(0.1, 4);
  expect(size(m[8])).toBeCloseTo(0.002, 5);
});

test('a .sol on the mesh itself and on a background of triangles', () => {
  const head = ['MeshVersionFormatted 2', 'Dimension 2'];
  const own = { name: 'a.sol', bytes: text(...head, 'SolAtVertices', '4', '1 1', '0.1', '0.1', '0.4', '0.4', 'End') };
  expect(size(tensors({ sol: own }, [0.5, 0.5], 'grid:1,1:0,1,0,1')[0])).toBeCloseTo(0.2, 6);
  const vertices = ['Vertices', '3', '0 0 0', '2 0 0', '0 2 0', 'Triangles', '1', '1 2 3 0', 'End'];
  const background = { name: 'b.mesh', bytes: text(...head, ...vertices) };
  const sol = { name: 'b.sol', bytes: text(...head, 'SolAtVertices', '3', '1 3', '4 0 9', '4 0 9', '4 0 9', 'End'), background };
  expect([...tensors({ sol }, [0.3, 0.4])]).toEqual([4, 0, 9].map((v) => expect.closeTo(v, 9)));
  expect(refusal({ sol: { ...own, background } })).toContain('4 vertices');
});

test('Hessians of a function and of a solution, in space too', () => {
  const operations = { 'target-cells': '500' };
  const [a, , b] = tensors({ hessianOf: '8*x^2 + y^2/2', operations }, [0.5, 0.5]);
  expect(a / b).toBeCloseTo(16, 1);
  expect(Math.sqrt(a * b)).toBeCloseTo(500, -1);
  const m = tensors({ hessianOf: '9*x^2 + y^2 - 4*z^2', operations: { error: '0.01' } }, [0.5, 0.5, 0.5], 'grid:2,2,2:0,1,0,1,0,1');
  expect(m[0] / m[2]).toBeCloseTo(9, 1);
  expect(m[5] / m[2]).toBeCloseTo(4, 1);
});

test('a picture, upright, and the portrait', () => {
  const n = 64;
  const gray = Uint8Array.from({ length: n * n }, (_, k) => (Math.hypot((k % n) / n - 0.25, k / n / n - 0.25) < 0.1 ? 250 : 10));
  const request = { image: { width: n, height: n, gray }, operations: { 'target-cells': '1000' } };
  const m = tensors(request, [0.25, 0.85, 0.25, 0.25]); // at the rim of the disc, near the top; and mirrored
  expect(m[0] * m[2] - m[1] ** 2).toBeGreaterThan(5 * (m[3] * m[5] - m[4] ** 2));
  expect(refusal({ image: { width: 8, height: 8, gray: new Uint8Array(64).fill(9) } })).toContain('one colour');
  expect(refusal({ image: 'portrait' }, 'grid:1,1,1:0,1,0,1,0,1')).toContain('two-dimensional');
  const session = grid('grid:16,20:0,0.8,0,1');
  session.setMetric({ nodal: makeMetric(metrics, session.input(), { image: 'portrait' }) });
  expect(JSON.parse(session.report()).complexity).toBeCloseTo(6000, -2);
  session.destroy();
}, 300_000); // the portrait's metric takes seconds, on a busy machine many

test('what is wrong is said in a sentence', () => {
  expect(refusal({})).toContain('No metric');
  expect(refusal({ formula: 'h = q' })).toContain('column 5');
  expect(refusal({ layers: ['inlet:0.1:1.2'] })).toContain("'inlet'");
  expect(refusal({ formula: 'h = 1', operations: { hmin: '-1' } })).toContain('--hmin');
  const session = grid('grid:1,1:0,1,0,1');
  expect(() => session.setMetric({ nodal: new Uint8Array(20) })).toThrow('not the bytes of a metric');
  session.destroy();
});
