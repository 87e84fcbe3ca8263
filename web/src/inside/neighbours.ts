// Which cell lies beyond each facet of a hexahedral mesh.
import type { ReplayMesh } from '../replay/replay_mesh.ts';

/** k-th corner of facet f of a hexahedron, as Cell<3>::facet_corner. */
function facetCorner(f: number, k: number): number {
  const axis = f >> 1;
  const low = k & ((1 << axis) - 1);
  return low | ((k >> axis) << (axis + 1)) | ((f & 1) << axis);
}

/** Corners of the six facets, each in corner-bit order. */
export const hexFacets: readonly (readonly number[])[] = Array.from({ length: 6 }, (_, f) =>
  Array.from({ length: 4 }, (_, k) => facetCorner(f, k)),
);

/** No cell: the facet is on the boundary, or its own cell is dead. */
export const outside = -1;

/**
 * The cell beyond facet f of cell c, at 6 c + f. Cost: linear; half-facets are matched within short lists, one for each
 * least vertex.
 */
export function facetNeighbours(mesh: ReplayMesh): Int32Array {
  const { cells, cellCount, vertexCount } = mesh;
  const neighbours = new Int32Array(6 * cellCount).fill(outside);
  const first = new Int32Array(vertexCount).fill(-1);
  const next = new Int32Array(6 * cellCount);
  // The other three vertices of a facet in increasing order: with the least one they tell it from any other.
  const rest = new Int32Array(18 * cellCount);
  for (let half = 0; half < 6 * cellCount; ++half) {
    const cell = (half / 6) | 0;
    const at = 8 * cell;
    if (cells[at] < 0) continue;
    const corners = hexFacets[half - 6 * cell];
    let a = cells[at + corners[0]];
    let b = cells[at + corners[1]];
    let c = cells[at + corners[2]];
    let d = cells[at + corners[3]];
    let swap;
    if (a > b) (swap = a), (a = b), (b = swap);
    if (c > d) (swap = c), (c = d), (d = swap);
    if (a > c) (swap = a), (a = c), (c = swap);
    if (b > d) (swap = b), (b = d), (d = swap);
    if (b > c) (swap = b), (b = c), (c = swap);
    let other = first[a];
    while (other >= 0 && (rest[3 * other] !== b || rest[3 * other + 1] !== c || rest[3 * other + 2] !== d))
      other = next[other];
    if (other >= 0) {
      neighbours[half] = (other / 6) | 0;
      neighbours[other] = cell;
      continue;
    }
    rest[3 * half] = b;
    rest[3 * half + 1] = c;
    rest[3 * half + 2] = d;
    next[half] = first[a];
    first[a] = half;
  }
  return neighbours;
}
