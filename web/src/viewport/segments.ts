// Pairs of vertices as segments to draw.
import type { ReplayMesh } from '../replay/replay_mesh.ts';

/** Six coordinates per edge. Edges whose vertices the mesh does not have are left out. */
export function segmentsOf(mesh: ReplayMesh, edges: Int32Array): Float32Array {
  const { dim, points, vertexCount } = mesh;
  const out = new Float32Array(3 * edges.length);
  let at = 0;
  for (let i = 0; i < edges.length; i += 2) {
    if (edges[i] >= vertexCount || edges[i + 1] >= vertexCount) continue;
    for (const v of [edges[i], edges[i + 1]]) {
      for (let d = 0; d < dim; ++d) out[at + d] = points[v * dim + d];
      at += 3;
    }
  }
  return out.subarray(0, at);
}

/** The edges of facets, each once: in 2D a facet is an edge, in 3D a quadrilateral in corner-bit order. */
export function facetEdges(dim: number, facets: Int32Array): Int32Array {
  if (dim === 2) return facets;
  const around = [0, 1, 1, 3, 3, 2, 2, 0];
  const edges = new Map<number, [number, number]>();
  for (let f = 0; f < facets.length; f += 4)
    for (let k = 0; k < 8; k += 2) {
      const [a, b] = [facets[f + around[k]], facets[f + around[k + 1]]];
      edges.set(Math.min(a, b) * 2 ** 26 + Math.max(a, b), [a, b]);
    }
  return Int32Array.from([...edges.values()].flat());
}

/** Segments of no length at points of three coordinates each: drawn with round ends they are dots. */
export function dotsAt(points: Float32Array): Float32Array {
  return Float32Array.from({ length: 2 * points.length }, (_, i) => points[3 * Math.floor(i / 6) + (i % 3)]);
}

/** The edges of one cell. */
export function cellEdges({ cells, cornerCount, dim }: ReplayMesh, cell: number): Int32Array {
  const edges: number[] = [];
  for (let axis = 0; axis < dim; ++axis)
    for (let k = 0; k < cornerCount; ++k)
      if (!(k & (1 << axis))) edges.push(cells[cornerCount * cell + k], cells[cornerCount * cell + (k | (1 << axis))]);
  return Int32Array.from(edges);
}

/** Edges of a quadrilateral mesh that one cell alone has. */
export function boundaryEdges(mesh: ReplayMesh): Int32Array {
  const once = new Map<number, [number, number]>();
  const sides = [0, 1, 1, 3, 3, 2, 2, 0];
  for (let c = 0; c < mesh.cellCount; ++c) {
    if (!mesh.alive(c)) continue;
    for (let k = 0; k < 8; k += 2) {
      const a = mesh.cells[4 * c + sides[k]];
      const b = mesh.cells[4 * c + sides[k + 1]];
      const key = Math.min(a, b) * 2 ** 26 + Math.max(a, b);
      if (!once.delete(key)) once.set(key, [a, b]);
    }
  }
  return Int32Array.from([...once.values()].flat());
}
