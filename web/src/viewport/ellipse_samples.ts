// Where metric ellipses and ellipsoids are drawn: cells of the initial mesh are divided until each piece is about as large
// as its ellipse; where cells are smaller than that, ellipses that would overlap are left out.
import type { ReplayMesh } from '../replay/replay_mesh.ts';

/** In the plane and in space, where each hides others: how many at the most, and how often pieces are divided. */
const limits = { 2: { most: 3200, rounds: 7 }, 3: { most: 700, rounds: 2 } };
/** Least distance of two centres in the metric of either; 1 would let ellipses of one size just touch. */
const apart = 0.92;

type Tensors = (points: Float64Array) => Promise<Float64Array>;

export interface EllipseSamples {
  centres: Float64Array;
  tensors: Float64Array;
}

/** A part of a cell: a box in the cell's own coordinates, each from 0 to 1. */
interface Piece {
  corners: number[][];
  low: number[];
  high: number[];
}

function at({ corners, low, high }: Piece, place: number[]): number[] {
  const dim = place.length;
  const found = new Array<number>(dim).fill(0);
  for (let k = 0; k < corners.length; ++k) {
    let weight = 1;
    for (let d = 0; d < dim; ++d) {
      const s = low[d] + place[d] * (high[d] - low[d]);
      weight *= (k >> d) & 1 ? s : 1 - s;
    }
    for (let d = 0; d < dim; ++d) found[d] += weight * corners[k][d];
  }
  return found;
}

/** v'Mv of the i-th tensor: m11 m12 m22 [m13 m23 m33]. */
function square(m: ArrayLike<number>, i: number, v: number[]): number {
  const [x, y, z] = v;
  if (v.length === 2) return m[3 * i] * x * x + 2 * m[3 * i + 1] * x * y + m[3 * i + 2] * y * y;
  const flat = m[6 * i] * x * x + 2 * m[6 * i + 1] * x * y + m[6 * i + 2] * y * y;
  return flat + 2 * m[6 * i + 3] * x * z + 2 * m[6 * i + 4] * y * z + m[6 * i + 5] * z * z;
}

/** Metric length across a piece along its axes, with the tensor of its middle. */
function lengths(piece: Piece, m: ArrayLike<number>, i: number): number[] {
  return piece.low.map((_, axis) => {
    const [a, b] = [0, 1].map((s) => at(piece, piece.low.map((_, d) => (d === axis ? s : 0.5))));
    return Math.sqrt(square(m, i, b.map((x, d) => x - a[d])));
  });
}

function divide({ corners, low, high }: Piece, parts: number[]): Piece[] {
  const total = parts.reduce((all, n) => all * n, 1);
  return Array.from({ length: total }, (_, k) => {
    const place = parts.map((n) => {
      const mine = k % n;
      k = Math.floor(k / n);
      return mine;
    });
    const between = (by: number) => place.map((p, d) => low[d] + ((p + by) / parts[d]) * (high[d] - low[d]));
    return { corners, low: between(0), high: between(1) };
  });
}

/** Samples of a mesh; `tensors` evaluates the metric at points. */
export async function sampleEllipses(mesh: ReplayMesh, tensors: Tensors): Promise<EllipseSamples> {
  const { dim, cornerCount, points, cells } = mesh;
  const { most, rounds } = limits[dim as 2 | 3];
  const size = dim === 2 ? 3 : 6;
  const stride = Math.max(1, Math.ceil(mesh.liveCellCount() / most));
  let open: Piece[] = [];
  for (let c = 0; c < mesh.cellCount; c += stride) {
    if (!mesh.alive(c)) continue;
    const corners = Array.from(cells.subarray(cornerCount * c, cornerCount * (c + 1)), (v) => Array.from(points.subarray(dim * v, dim * (v + 1))));
    open.push({ corners, low: new Array<number>(dim).fill(0), high: new Array<number>(dim).fill(1) });
  }
  const centres: number[][] = [];
  const metric: number[] = [];
  for (let round = 1; open.length > 0; ++round) {
    const middles = open.map((piece) => at(piece, piece.low.map(() => 0.5)));
    const m = await tensors(Float64Array.from(middles.flat()));
    const next: Piece[] = [];
    open.forEach((piece, i) => {
      const across = lengths(piece, m, i);
      if (dim === 3 && Math.min(...across) < 0.7) return; // larger than what it stands in: it would hide the others
      const parts = across.map((l) => Math.max(1, Math.min(3, Math.floor(l))));
      const room = centres.length + next.length + open.length - i < most;
      if (round < rounds && room && parts.some((n) => n > 1)) {
        next.push(...divide(piece, parts));
      } else {
        centres.push(middles[i]);
        metric.push(...m.subarray(size * i, size * (i + 1)));
      }
    });
    open = next;
  }
  return withoutOverlaps(centres, metric, size);
}

/** How far the i-th ellipse or ellipsoid goes along x: the square root of the first entry of its tensor's inverse. */
function reach(m: ArrayLike<number>, i: number, size: number): number {
  const [a, b, c, d = 0, e = 0, f = 0] = Array.from({ length: size }, (_, k) => m[size * i + k]);
  if (size === 3) return Math.sqrt(c / (a * c - b * b));
  const minor = c * f - e * e;
  return Math.sqrt(minor / (a * minor - b * (b * f - d * e) + d * (b * e - c * d)));
}

/** Keeps, in order, what is far enough from all that was kept before; looked for in slabs across x. */
function withoutOverlaps(centres: number[][], metric: number[], size: number): EllipseSamples {
  const kept: number[] = [];
  let [low, high] = [Infinity, -Infinity];
  for (const [x] of centres) [low, high] = [Math.min(low, x), Math.max(high, x)];
  const slabs = Array.from({ length: 256 }, (): number[] => []);
  const slabOf = (x: number): number =>
    Math.min(slabs.length - 1, Math.max(0, Math.floor(((x - low) / (high - low || 1)) * slabs.length)));
  const near = (i: number, j: number): boolean => {
    const away = centres[i].map((x, d) => x - centres[j][d]);
    return square(metric, i, away) < apart * apart && square(metric, j, away) < apart * apart;
  };
  centres.forEach(([x], i) => {
    const far = apart * reach(metric, i, size);
    for (let slab = slabOf(x - far), last = slabOf(x + far); slab <= last; ++slab)
      if (slabs[slab].some((j) => near(i, j))) return;
    slabs[slabOf(x)].push(i);
    kept.push(i);
  });
  return {
    centres: Float64Array.from(kept.flatMap((i) => centres[i])),
    tensors: Float64Array.from(kept.flatMap((i) => metric.slice(size * i, size * (i + 1)))),
  };
}
