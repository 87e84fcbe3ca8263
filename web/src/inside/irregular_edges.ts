// Edges around which a hexahedral mesh has other than the regular number of cells.
import type { ReplayMesh } from '../replay/replay_mesh.ts';
import { hexFacets, outside } from './neighbours.ts';

/** By the number of cells around an edge beyond the regular one: fewer, one more, two or more. */
export const irregularKinds = ['fewer', 'one more', 'many more'] as const;

/** Pairs of vertices, in the order of irregularKinds. */
export type IrregularEdges = readonly [fewer: Int32Array, oneMore: Int32Array, manyMore: Int32Array];

/** The two corners of each of the twelve edges; edge = 4 axis + number among those of the axis. */
const hexEdges: readonly (readonly [number, number])[] = [1, 2, 4].flatMap((bit) =>
  [0, 1, 2, 3, 4, 5, 6, 7].filter((corner) => !(corner & bit)).map((corner) => [corner, corner | bit] as const),
);
const facetSides = [0, 1, 1, 3, 3, 2, 2, 0];

/** Edges of a mesh, found by their vertices: a short list for each lesser vertex. */
class EdgeTable {
  readonly greater: Int32Array;
  readonly lesser: Int32Array;
  count = 0;
  private readonly first: Int32Array;
  private readonly next: Int32Array;

  constructor(vertexCount: number, capacity: number) {
    this.first = new Int32Array(vertexCount).fill(-1);
    this.next = new Int32Array(capacity);
    this.lesser = new Int32Array(capacity);
    this.greater = new Int32Array(capacity);
  }

  /** The number of the edge, new or not. */
  at(p: number, q: number): number {
    const a = p < q ? p : q;
    const b = p < q ? q : p;
    let e = this.first[a];
    while (e >= 0 && this.greater[e] !== b) e = this.next[e];
    if (e >= 0) return e;
    e = this.count++;
    this.lesser[e] = a;
    this.greater[e] = b;
    this.next[e] = this.first[a];
    this.first[a] = e;
    return e;
  }
}

/** Angle in radians that a cell fills at its edge between corners a and b, along axis. */
function dihedral(mesh: ReplayMesh, cell: number, edge: number): number {
  const { cells, points } = mesh;
  const [a, b] = hexEdges[edge];
  const axis = edge >> 2;
  const bits = [1, 2, 4].filter((_, d) => d !== axis);
  const point = (corner: number, d: number): number => points[3 * cells[8 * cell + corner] + d];
  const along = [0, 1, 2].map((d) => point(b, d) - point(a, d));
  const square = along.reduce((sum, x) => sum + x * x, 0) || 1;
  const [u, v] = bits.map((bit) => {
    const side = [0, 1, 2].map((d) => point(a ^ bit, d) - point(a, d) + point(b ^ bit, d) - point(b, d));
    const share = side.reduce((sum, x, d) => sum + x * along[d], 0) / square;
    return side.map((x, d) => x - share * along[d]);
  });
  const dot = u.reduce((sum, x, d) => sum + x * v[d], 0);
  return Math.acos(Math.max(-1, Math.min(1, dot / (Math.hypot(...u) * Math.hypot(...v) || 1))));
}

/**
 * Inside, 4 cells around an edge are regular. On the boundary it is as many as the right angles that the cells fill
 * there: 2 on a smooth surface, 1 along a convex edge of the domain, 3 along a re-entrant one. Cost: linear.
 */
export function irregularEdges(mesh: ReplayMesh, neighbours: Int32Array): IrregularEdges {
  const { cells, cellCount } = mesh;
  const table = new EdgeTable(mesh.vertexCount, 12 * cellCount);
  const ofCell = new Int32Array(12 * cellCount);
  const valence = new Uint16Array(12 * cellCount);
  for (let c = 0; c < cellCount; ++c) {
    if (cells[8 * c] < 0) continue;
    for (let e = 0; e < 12; ++e) {
      const [p, q] = hexEdges[e];
      const edge = table.at(cells[8 * c + p], cells[8 * c + q]);
      ofCell[12 * c + e] = edge;
      ++valence[edge];
    }
  }
  const boundary = new Uint8Array(table.count);
  for (let half = 0; half < 6 * cellCount; ++half) {
    const c = (half / 6) | 0;
    if (neighbours[half] !== outside || cells[8 * c] < 0) continue;
    const corners = hexFacets[half - 6 * c];
    for (let k = 0; k < 8; k += 2)
      boundary[table.at(cells[8 * c + corners[facetSides[k]]], cells[8 * c + corners[facetSides[k + 1]]])] = 1;
  }
  const angle = new Float64Array(table.count);
  for (let i = 0; i < 12 * cellCount; ++i) {
    const c = (i / 12) | 0;
    if (cells[8 * c] >= 0 && boundary[ofCell[i]]) angle[ofCell[i]] += dihedral(mesh, c, i - 12 * c);
  }
  const found: [number[], number[], number[]] = [[], [], []];
  for (let e = 0; e < table.count; ++e) {
    const regular = boundary[e] ? Math.max(1, Math.round(angle[e] / (Math.PI / 2))) : 4;
    const excess = valence[e] - regular;
    if (excess !== 0) found[excess < 0 ? 0 : excess === 1 ? 1 : 2].push(table.lesser[e], table.greater[e]);
  }
  return [Int32Array.from(found[0]), Int32Array.from(found[1]), Int32Array.from(found[2])];
}
