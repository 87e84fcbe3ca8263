// Which quadrilaterals are drawn: in 2D every cell, in 3D the facets that only one cell has.
import type { ReplayMesh } from '../replay/replay_mesh.ts';

/** Quadrilaterals as vertices in corner-bit order, four each, and the cell that each belongs to. */
export interface Facets {
  vertices: Int32Array;
  cells: Int32Array;
}

/** k-th corner of facet f of a hexahedron, as Cell<3>::facet_corner. */
function facetCorner(f: number, k: number): number {
  const axis = f >> 1;
  const low = k & ((1 << axis) - 1);
  return low | ((k >> axis) << (axis + 1)) | ((f & 1) << axis);
}

const hexFacets = Array.from({ length: 6 }, (_, f) => Array.from({ length: 4 }, (_, k) => facetCorner(f, k)));

/** The outer surface of a hexahedral mesh. Cost: linear, one hash table of the facets. */
export function surfaceFacets(mesh: ReplayMesh): Facets {
  const capacity = 1 << Math.ceil(Math.log2(Math.max(16, mesh.cellCount * 12)));
  const slots = new Int32Array(capacity).fill(-1); // half-facet number, or -1
  const twice = new Uint8Array(mesh.cellCount * 6);
  const sorted = new Int32Array(4);
  const key = (halfFacet: number): Int32Array => {
    const first = Math.floor(halfFacet / 6) * 8;
    hexFacets[halfFacet % 6].forEach((corner, k) => (sorted[k] = mesh.cells[first + corner]));
    return sorted.sort();
  };
  let surface = 0;
  for (let half = 0; half < mesh.cellCount * 6; ++half) {
    if (!mesh.alive(Math.floor(half / 6))) continue;
    const [a, b, c, d] = key(half);
    let slot = (Math.imul(a, 73856093) ^ Math.imul(b, 19349663) ^ Math.imul(c, 83492791)) & (capacity - 1);
    for (; slots[slot] >= 0; slot = (slot + 1) & (capacity - 1)) {
      const [p, q, r, s] = key(slots[slot]);
      if (p === a && q === b && r === c && s === d) break;
    }
    if (slots[slot] >= 0) {
      twice[half] = twice[slots[slot]] = 1;
      --surface;
    } else {
      slots[slot] = half;
      ++surface;
    }
  }
  const facets = { vertices: new Int32Array(4 * surface), cells: new Int32Array(surface) };
  let count = 0;
  for (let half = 0; half < twice.length; ++half) {
    const cell = Math.floor(half / 6);
    if (twice[half] || !mesh.alive(cell)) continue;
    hexFacets[half % 6].forEach((corner, k) => (facets.vertices[4 * count + k] = mesh.cells[8 * cell + corner]));
    facets.cells[count++] = cell;
  }
  return facets;
}
