// What cells are peeled, filtered and coloured by: how far inside they lie, their scaled Jacobian, their metric length.
import type { ReplayMesh } from '../replay/replay_mesh.ts';
import { hexFacets, outside } from './neighbours.ts';

/**
 * How many layers of cells lie between each cell and the boundary: 0 for cells that touch it, if only with a vertex; -1
 * for dead cells. `deepest` is the largest.
 */
export function cellDepths(mesh: ReplayMesh, neighbours: Int32Array): { depths: Int32Array; deepest: number } {
  const { cells, cellCount } = mesh;
  const reached = new Uint8Array(mesh.vertexCount);
  const depths = new Int32Array(cellCount).fill(-1);
  let waiting = new Int32Array(cellCount);
  let count = 0;
  for (let c = 0; c < cellCount; ++c) {
    if (cells[8 * c] < 0) continue;
    waiting[count++] = c;
    for (let f = 0; f < 6; ++f)
      if (neighbours[6 * c + f] === outside) for (const corner of hexFacets[f]) reached[cells[8 * c + corner]] = 1;
  }
  waiting = waiting.subarray(0, count);
  let deepest = 0;
  for (let depth = 0; waiting.length > 0; ++depth) {
    const touching = waiting.filter((c) => {
      for (let k = 0; k < 8; ++k) if (reached[cells[8 * c + k]]) return true;
      return false;
    });
    if (touching.length === 0) break; // a mesh without boundary
    for (const c of touching) {
      depths[c] = depth;
      for (let k = 0; k < 8; ++k) reached[cells[8 * c + k]] = 1;
    }
    deepest = depth;
    waiting = waiting.filter((c) => depths[c] < 0);
  }
  return { depths, deepest };
}

/** The least, over the corners, of the Jacobian of the three edge vectors divided by their lengths, as the core's. */
export function scaledJacobians(mesh: ReplayMesh): Float64Array {
  const { cells, cellCount, points } = mesh;
  if (mesh.dim === 2) return scaledJacobians2(mesh);
  const result = new Float64Array(cellCount).fill(NaN);
  const edge = new Float64Array(9);
  for (let c = 0; c < cellCount; ++c) {
    if (cells[8 * c] < 0) continue;
    let least = Infinity;
    for (let k = 0; k < 8; ++k) {
      const from = 3 * cells[8 * c + k];
      let lengths = 1;
      for (let axis = 0; axis < 3; ++axis) {
        const to = 3 * cells[8 * c + (k ^ (1 << axis))];
        const sign = (k >> axis) & 1 ? -1 : 1;
        const x = (edge[3 * axis] = sign * (points[to] - points[from]));
        const y = (edge[3 * axis + 1] = sign * (points[to + 1] - points[from + 1]));
        const z = (edge[3 * axis + 2] = sign * (points[to + 2] - points[from + 2]));
        lengths *= Math.sqrt(x * x + y * y + z * z);
      }
      const [a, b, d, e, f, g, h, i, j] = edge;
      const determinant = a * (f * j - g * i) - b * (e * j - g * h) + d * (e * i - f * h);
      least = Math.min(least, lengths > 0 ? determinant / lengths : 0);
    }
    result[c] = least;
  }
  return result;
}

/** The same for quadrilaterals: the least sine of an angle. */
function scaledJacobians2({ cells, cellCount, points }: ReplayMesh): Float64Array {
  const result = new Float64Array(cellCount).fill(NaN);
  for (let c = 0; c < cellCount; ++c) {
    if (cells[4 * c] < 0) continue;
    let least = Infinity;
    for (let k = 0; k < 4; ++k) {
      const at = 2 * cells[4 * c + k];
      const p = 2 * cells[4 * c + (k ^ 1)];
      const q = 2 * cells[4 * c + (k ^ 2)];
      const [a, b, d, e] = [points[p] - points[at], points[p + 1] - points[at + 1], points[q] - points[at], points[q + 1] - points[at + 1]];
      const sign = k === 0 || k === 3 ? 1 : -1;
      const lengths = Math.sqrt((a * a + b * b) * (d * d + e * e));
      least = Math.min(least, lengths > 0 ? (sign * (a * e - b * d)) / lengths : 0);
    }
    result[c] = least;
  }
  return result;
}

/** Geometric mean of the metric lengths of each cell's edges, given each edge once. NaN where edges are missing. */
export function cellLengths(
  { cells, cellCount, cornerCount, dim }: ReplayMesh,
  edges: Int32Array,
  lengths: Float64Array,
): Float64Array {
  const logs = new Map<number, number>();
  const key = (a: number, b: number): number => (a < b ? a * 2 ** 26 + b : b * 2 ** 26 + a);
  for (let e = 0; e < lengths.length; ++e) logs.set(key(edges[2 * e], edges[2 * e + 1]), Math.log(lengths[e]));
  const result = new Float64Array(cellCount).fill(NaN);
  const edgeCount = dim * (cornerCount / 2);
  for (let c = 0; c < cellCount; ++c) {
    const first = c * cornerCount;
    if (cells[first] < 0) continue;
    let sum = 0;
    for (let axis = 0; axis < dim; ++axis)
      for (let k = 0; k < cornerCount; ++k)
        if (!(k & (1 << axis))) sum += logs.get(key(cells[first + k], cells[first + (k | (1 << axis))])) ?? NaN;
    result[c] = Math.exp(sum / edgeCount);
  }
  return result;
}
