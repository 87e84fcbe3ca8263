// Where metric ellipses are drawn: cells of the initial mesh are divided until each piece is about as large as its
// ellipse; where cells are smaller than that, ellipses that would overlap are left out.
import type { ReplayMesh } from '../replay/replay_mesh.ts';

const most = 3200;
const rounds = 7;
/** Least distance of two centres in the metric of either; 1 would let ellipses of one size just touch. */
const apart = 0.92;

type Tensors = (points: Float64Array) => Promise<Float64Array>;

export interface EllipseSamples {
  centres: Float64Array;
  tensors: Float64Array;
}

/** A part of a cell: a rectangle in the cell's own coordinates, each from 0 to 1. */
interface Piece {
  corners: number[][];
  low: [number, number];
  high: [number, number];
}

function at({ corners, low, high }: Piece, s: number, t: number): [number, number] {
  const u = low[0] + s * (high[0] - low[0]);
  const v = low[1] + t * (high[1] - low[1]);
  const weights = [(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v];
  return [0, 1].map((d) => weights.reduce((sum, w, k) => sum + w * corners[k][d], 0)) as [number, number];
}

/** Metric length across a piece along its two axes, with the tensor of its middle. */
function lengths(piece: Piece, m: ArrayLike<number>, i: number): [number, number] {
  return [0, 1].map((axis) => {
    const [a, b] = axis === 0 ? [at(piece, 0, 0.5), at(piece, 1, 0.5)] : [at(piece, 0.5, 0), at(piece, 0.5, 1)];
    const [x, y] = [b[0] - a[0], b[1] - a[1]];
    return Math.sqrt(m[3 * i] * x * x + 2 * m[3 * i + 1] * x * y + m[3 * i + 2] * y * y);
  }) as [number, number];
}

function divide(piece: Piece, parts: [number, number]): Piece[] {
  const between = (axis: number, k: number): number =>
    piece.low[axis] + (k / parts[axis]) * (piece.high[axis] - piece.low[axis]);
  const pieces: Piece[] = [];
  for (let j = 0; j < parts[1]; ++j)
    for (let i = 0; i < parts[0]; ++i)
      pieces.push({
        corners: piece.corners,
        low: [between(0, i), between(1, j)],
        high: [between(0, i + 1), between(1, j + 1)],
      });
  return pieces;
}

/** Samples of a 2D mesh; `tensors` evaluates the metric at points. */
export async function sampleEllipses(mesh: ReplayMesh, tensors: Tensors): Promise<EllipseSamples> {
  const stride = Math.max(1, Math.ceil(mesh.liveCellCount() / most));
  let open: Piece[] = [];
  for (let c = 0; c < mesh.cellCount; c += stride) {
    if (!mesh.alive(c)) continue;
    const corners = Array.from(mesh.cells.subarray(4 * c, 4 * c + 4), (v) => [
      mesh.points[2 * v],
      mesh.points[2 * v + 1],
    ]);
    open.push({ corners, low: [0, 0], high: [1, 1] });
  }
  const centres: number[] = [];
  const metric: number[] = [];
  for (let round = 1; open.length > 0; ++round) {
    const middles = open.flatMap((piece) => at(piece, 0.5, 0.5));
    const m = await tensors(Float64Array.from(middles));
    const next: Piece[] = [];
    open.forEach((piece, i) => {
      const parts = lengths(piece, m, i).map((l) => Math.max(1, Math.min(3, Math.floor(l)))) as [number, number];
      const room = centres.length / 2 + next.length + open.length - i < most;
      if (round < rounds && room && parts[0] * parts[1] > 1) {
        next.push(...divide(piece, parts));
      } else {
        centres.push(middles[2 * i], middles[2 * i + 1]);
        metric.push(m[3 * i], m[3 * i + 1], m[3 * i + 2]);
      }
    });
    open = next;
  }
  return withoutOverlaps(centres, metric);
}

/** Keeps, in order, what is far enough from all that was kept before. */
function withoutOverlaps(centres: number[], metric: number[]): EllipseSamples {
  const kept: number[] = [];
  const near = (i: number, j: number): boolean => {
    const [x, y] = [centres[2 * i] - centres[2 * j], centres[2 * i + 1] - centres[2 * j + 1]];
    const within = (k: number): boolean =>
      metric[3 * k] * x * x + 2 * metric[3 * k + 1] * x * y + metric[3 * k + 2] * y * y < apart * apart;
    return within(i) && within(j);
  };
  for (let i = 0; i < centres.length / 2; ++i) if (!kept.some((j) => near(i, j))) kept.push(i);
  return {
    centres: Float64Array.from(kept.flatMap((i) => [centres[2 * i], centres[2 * i + 1]])),
    tensors: Float64Array.from(kept.flatMap((i) => [metric[3 * i], metric[3 * i + 1], metric[3 * i + 2]])),
  };
}
