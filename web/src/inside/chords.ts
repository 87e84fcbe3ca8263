// Dual chords of quadrilaterals and dual sheets of hexahedra: what one reaches through parallel edges.
import type { ReplayMesh } from '../replay/replay_mesh.ts';
import { facetNeighbours, outside } from './neighbours.ts';

/** Cells of a chord or sheet; one that it crosses itself in counts once. */
export interface Chord {
  cells: Int32Array;
  /** It meets no boundary facet: in 2D it closes to a loop. */
  closed: boolean;
}

/** Across facet f of cell c, at facets * c + f; facet = 2 axis + side. */
export function neighboursOf(mesh: ReplayMesh): Int32Array {
  return mesh.dim === 3 ? facetNeighbours(mesh) : edgeNeighbours(mesh);
}

/** Corner of a facet of a quadrilateral: facet 2 axis + side holds the two corners with that bit. */
const quadFacets = [
  [0, 2],
  [1, 3],
  [0, 1],
  [2, 3],
] as const;

function edgeNeighbours({ cells, cellCount }: ReplayMesh): Int32Array {
  const neighbours = new Int32Array(4 * cellCount).fill(outside);
  const waiting = new Map<number, number>();
  for (let half = 0; half < 4 * cellCount; ++half) {
    const c = half >> 2;
    if (cells[4 * c] < 0) continue;
    const [a, b] = quadFacets[half & 3].map((corner) => cells[4 * c + corner]);
    const key = a < b ? a * 2 ** 26 + b : b * 2 ** 26 + a;
    const other = waiting.get(key);
    if (other === undefined) {
      waiting.set(key, half);
      continue;
    }
    neighbours[half] = other >> 2;
    neighbours[other] = c;
    waiting.delete(key);
  }
  return neighbours;
}

/** The chord or sheet through the edges of `cell` along `axis`. Cost: linear in its cells. */
export function chordThrough(mesh: ReplayMesh, neighbours: Int32Array, cell: number, axis: number): Chord {
  const { dim, cornerCount, cells } = mesh;
  const seen = new Set<number>([dim * cell + axis]);
  const waiting = [dim * cell + axis];
  let closed = true;
  for (let state = waiting.pop(); state !== undefined; state = waiting.pop()) {
    const c = Math.floor(state / dim);
    const along = state - dim * c;
    for (let facet = 0; facet < 2 * dim; ++facet) {
      const across = facet >> 1;
      if (across === along) continue;
      const next = neighbours[2 * dim * c + facet];
      if (next === outside) {
        closed = false;
        continue;
      }
      // An edge of the facet along the axis, found again in the next cell.
      const corner = (facet & 1) << across;
      const p = cells[cornerCount * c + corner];
      const q = cells[cornerCount * c + (corner | (1 << along))];
      let bits = 0;
      for (let k = 0; k < cornerCount; ++k) {
        const v = cells[cornerCount * next + k];
        if (v === p || v === q) bits ^= k;
      }
      const key = dim * next + Math.log2(bits);
      if (seen.has(key)) continue;
      seen.add(key);
      waiting.push(key);
    }
  }
  return { cells: Int32Array.from(new Set([...seen].map((state) => Math.floor(state / dim)))), closed };
}

/** Inner vertices of a quadrilateral mesh at which other than four cells meet: with fewer, with more. */
export function irregularVertices(mesh: ReplayMesh, neighbours: Int32Array): [fewer: Int32Array, more: Int32Array] {
  const { cells, cellCount, vertexCount } = mesh;
  const valence = new Uint8Array(vertexCount);
  const boundary = new Uint8Array(vertexCount);
  for (let c = 0; c < cellCount; ++c) {
    if (cells[4 * c] < 0) continue;
    for (let k = 0; k < 4; ++k) ++valence[cells[4 * c + k]];
    for (let facet = 0; facet < 4; ++facet)
      if (neighbours[4 * c + facet] === outside)
        for (const corner of quadFacets[facet]) boundary[cells[4 * c + corner]] = 1;
  }
  const chosen = (wanted: (count: number) => boolean): Int32Array => {
    const found: number[] = [];
    for (let v = 0; v < vertexCount; ++v) if (valence[v] > 0 && !boundary[v] && wanted(valence[v])) found.push(v);
    return Int32Array.from(found);
  };
  return [chosen((count) => count < 4), chosen((count) => count > 4)];
}
