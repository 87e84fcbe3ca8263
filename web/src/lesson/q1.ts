// A small finite element solver for the lesson on the solver loop: -Lap u = f on a mesh of quadrilaterals, u given on the
// boundary. Bilinear elements, conjugate gradients. The same as examples/solver/q1.cpp, for one equation.
import type { MeshArrays } from '../../../wasm/session.ts';

export type Function2 = (x: number, y: number) => number;

/** The points and cells in use alone, and which points lie on the boundary. */
export interface Plane {
  points: Float64Array;
  /** Four vertices each, in corner-bit order. */
  cells: Int32Array;
  boundary: Uint8Array;
}

export function compacted({ points, cells }: Pick<MeshArrays, 'points' | 'cells'>): Plane {
  const number = new Int32Array(points.length / 2).fill(-1);
  const kept: number[] = [];
  const corners: number[] = [];
  for (let c = 0; c < cells.length; c += 4) {
    if (cells[c] < 0) continue;
    for (let k = 0; k < 4; ++k) {
      const v = cells[c + k];
      if (number[v] < 0) {
        number[v] = kept.length / 2;
        kept.push(points[2 * v], points[2 * v + 1]);
      }
      corners.push(number[v]);
    }
  }
  const once = new Map<string, [number, number]>();
  const sides = [0, 1, 1, 3, 3, 2, 2, 0];
  for (let c = 0; c < corners.length; c += 4)
    for (let k = 0; k < 8; k += 2) {
      const [a, b] = [corners[c + sides[k]], corners[c + sides[k + 1]]];
      const key = a < b ? `${a} ${b}` : `${b} ${a}`;
      if (!once.delete(key)) once.set(key, [a, b]);
    }
  const boundary = new Uint8Array(kept.length / 2);
  for (const edge of once.values()) for (const v of edge) boundary[v] = 1;
  return { points: Float64Array.from(kept), cells: Int32Array.from(corners), boundary };
}

/** Gauss's points and weights on [0, 1]. */
const [a, b] = [Math.sqrt(0.6) / 2, Math.sqrt(10 / 7) * 2];
const gauss = {
  3: { at: [0.5 - a, 0.5, 0.5 + a], weight: [5 / 18, 8 / 18, 5 / 18] },
  5: {
    at: [-1, -1, 0, 1, 1].map((side, i) => 0.5 + (side * Math.sqrt(5 + (i % 4 === 0 ? b : -b))) / 6),
    weight: [0, 1, 2, 3, 4].map((i) => (i === 2 ? 64 / 225 : (322 + (i % 4 === 0 ? -13 : 13) * Math.sqrt(70)) / 1800)),
  },
} as const;

interface Shapes {
  value: number[];
  /** Gradients: x and y of each corner's function. */
  dx: number[];
  dy: number[];
  x: number;
  y: number;
  /** Of the integration, times the Jacobian. */
  weight: number;
}

/** Calls `visit` at the points of integration of the cell whose corners begin at `first`. */
function integrate({ points, cells }: Plane, first: number, rule: (typeof gauss)[3 | 5], visit: (s: Shapes) => void): void {
  const px = [0, 1, 2, 3].map((k) => points[2 * cells[first + k]]);
  const py = [0, 1, 2, 3].map((k) => points[2 * cells[first + k] + 1]);
  rule.at.forEach((t, j) =>
    rule.at.forEach((s, i) => {
      const value = [(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t];
      const ds = [t - 1, 1 - t, -t, t];
      const dt = [s - 1, -s, 1 - s, s];
      const dot = (f: number[], p: number[]): number => f[0] * p[0] + f[1] * p[1] + f[2] * p[2] + f[3] * p[3];
      const [xs, xt, ys, yt] = [dot(ds, px), dot(dt, px), dot(ds, py), dot(dt, py)];
      const jacobian = xs * yt - xt * ys;
      visit({
        value,
        dx: ds.map((d, k) => (d * yt - dt[k] * ys) / jacobian),
        dy: ds.map((d, k) => (dt[k] * xs - d * xt) / jacobian),
        x: dot(value, px),
        y: dot(value, py),
        weight: rule.weight[i] * rule.weight[j] * jacobian,
      });
    }),
  );
}

/** Values at the vertices. */
export function solve(mesh: Plane, source: Function2, given: Function2): Float64Array {
  const { points, cells, boundary } = mesh;
  const n = boundary.length;
  const matrices = new Float64Array(4 * cells.length);
  const right = new Float64Array(n);
  const diagonal = new Float64Array(n);
  for (let c = 0; c < cells.length; c += 4) {
    integrate(mesh, c, gauss[3], ({ value, dx, dy, x, y, weight }) => {
      const f = weight * source(x, y);
      for (let i = 0; i < 4; ++i) {
        right[cells[c + i]] += f * value[i];
        for (let j = 0; j < 4; ++j) matrices[4 * (c + i) + j] += weight * (dx[i] * dx[j] + dy[i] * dy[j]);
      }
    });
    for (let i = 0; i < 4; ++i) diagonal[cells[c + i]] += matrices[4 * (c + i) + i];
  }
  const apply = (u: Float64Array): Float64Array => {
    const out = new Float64Array(n);
    for (let r = 0; r < cells.length; ++r) {
      const first = r & ~3;
      for (let j = 0; j < 4; ++j) out[cells[r]] += matrices[4 * r + j] * u[cells[first + j]];
    }
    return out;
  };
  const inner = (u: Float64Array, v: Float64Array): number => u.reduce((sum, x, i) => sum + x * v[i], 0);

  const u = new Float64Array(n);
  for (let v = 0; v < n; ++v) if (boundary[v]) u[v] = given(points[2 * v], points[2 * v + 1]);
  const rest = apply(u).map((x, v) => (boundary[v] ? 0 : right[v] - x));
  const scaled = (): Float64Array => rest.map((x, v) => x / diagonal[v]);
  let z = scaled();
  let along = z.slice();
  let square = inner(rest, z);
  const enough = 1e-20 * square;
  for (let k = 0; k < 5 * n && square > enough; ++k) {
    const image = apply(along).map((x, v) => (boundary[v] ? 0 : x));
    const step = square / inner(along, image);
    for (let v = 0; v < n; ++v) {
      u[v] += step * along[v];
      rest[v] -= step * image[v];
    }
    z = scaled();
    const next = inner(rest, z);
    along = along.map((x, v) => z[v] + (next / square) * x);
    square = next;
  }
  return u;
}

/** The L2 norm of what a solution is off. */
export function errorOf(mesh: Plane, values: Float64Array, exact: Function2): number {
  let sum = 0;
  for (let c = 0; c < mesh.cells.length; c += 4)
    integrate(mesh, c, gauss[5], ({ value, x, y, weight }) => {
      const u = value.reduce((all, share, k) => all + share * values[mesh.cells[c + k]], 0);
      sum += weight * (u - exact(x, y)) ** 2;
    });
  return Math.sqrt(sum);
}

/** A mesh and a field on its vertices as Medit files. */
export function asMedit({ points, cells }: Plane, values: Float64Array): { mesh: Uint8Array; sol: Uint8Array } {
  const n = points.length / 2;
  const vertices = Array.from({ length: n }, (_, v) => `${points[2 * v]} ${points[2 * v + 1]} 0`);
  const quads = Array.from({ length: cells.length / 4 }, (_, c) =>
    `${[0, 1, 3, 2].map((k) => cells[4 * c + k] + 1).join(' ')} 0`);
  const text = (lines: string[]): Uint8Array => new TextEncoder().encode(`${lines.join('\n')}\n`);
  return {
    mesh: text(['MeshVersionFormatted 2', 'Dimension 2', 'Vertices', `${n}`, ...vertices, 'Quadrilaterals', `${quads.length}`, ...quads, 'End']),
    sol: text(['MeshVersionFormatted 2', 'Dimension 2', 'SolAtVertices', `${n}`, '1 1', ...Array.from(values, String), 'End']),
  };
}

/** A grid of n by n squares on the unit square. */
export function squares(n: number): Plane {
  const points = new Float64Array(2 * (n + 1) ** 2).map((_, i) => (i % 2 ? Math.floor(i / 2 / (n + 1)) : (i / 2) % (n + 1)) / n);
  const cells = new Int32Array(4 * n * n).map((_, i) => {
    const [c, k] = [i >> 2, i & 3];
    return Math.floor(c / n) * (n + 1) + (c % n) + (k & 1) + (k >> 1) * (n + 1);
  });
  return compacted({ points, cells });
}
