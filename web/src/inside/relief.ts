// What makes the surface of hexahedra look solid: how hollow it is at each vertex, and the edges of its outline.
import type { ReplayMesh } from '../replay/replay_mesh.ts';
import type { Facets } from './facets.ts';

export interface Relief {
  /** Outward unit normal of each facet. */
  normals: Float32Array;
  /** At each corner of each facet, -1 (an edge that stands out) to 1 (the bottom of a hole); 0: flat. */
  hollow: Float32Array;
}

/** How far the dark of a hollow spreads, in rounds from facet to facet, and how much of it each round keeps. */
const [rounds, kept] = [2, 0.6];

/**
 * A vertex is as hollow as the middles of its facets stand above the plane across its mean normal: what lies above
 * that plane hides the sky from it. Cost: linear in the facets, but for clearing a few numbers per vertex.
 */
export function reliefOf({ points, vertexCount }: ReplayMesh, { vertices, outward }: Facets): Relief {
  const count = outward.length;
  const normals = new Float32Array(3 * count);
  const middles = new Float32Array(3 * count);
  const mean = new Float32Array(3 * vertexCount);
  for (let f = 0; f < count; ++f) {
    const at = 3 * f;
    const [a, b, c, d] = [0, 1, 2, 3].map((k) => 3 * vertices[4 * f + k]);
    for (let i = 0; i < 3; ++i) {
      const [j, k] = [(i + 1) % 3, (i + 2) % 3];
      normals[at + i] =
        outward[f] *
        ((points[d + j] - points[a + j]) * (points[c + k] - points[b + k]) - (points[d + k] - points[a + k]) * (points[c + j] - points[b + j]));
      middles[at + i] = (points[a + i] + points[b + i] + points[c + i] + points[d + i]) / 4;
    }
    const length = Math.hypot(normals[at], normals[at + 1], normals[at + 2]) || 1;
    for (let i = 0; i < 3; ++i) {
      normals[at + i] /= length;
      for (const v of [a, b, c, d]) mean[v + i] += normals[at + i];
    }
  }
  const sum = new Float32Array(vertexCount);
  const facets = new Uint16Array(vertexCount);
  for (let f = 0; f < count; ++f)
    for (let k = 0; k < 4; ++k) {
      const v = vertices[4 * f + k];
      const [x, y, z] = [0, 1, 2].map((i) => middles[3 * f + i] - points[3 * v + i]);
      const away = Math.hypot(x, y, z) * Math.hypot(mean[3 * v], mean[3 * v + 1], mean[3 * v + 2]);
      if (away > 0) sum[v] += (x * mean[3 * v] + y * mean[3 * v + 1] + z * mean[3 * v + 2]) / away;
      ++facets[v];
    }
  let at = sum.map((x, v) => (facets[v] ? Math.max(-1, Math.min(1, (1.5 * x) / facets[v])) : 0));
  for (let round = 0; round < rounds; ++round) {
    const around = new Float32Array(vertexCount);
    for (let f = 0; f < count; ++f) {
      const [a, b, c, d] = vertices.subarray(4 * f, 4 * f + 4);
      const all = Math.max(at[a], 0) + Math.max(at[b], 0) + Math.max(at[c], 0) + Math.max(at[d], 0);
      for (const v of [a, b, c, d]) around[v] += (all - Math.max(at[v], 0)) / 3;
    }
    at = at.map((x, v) => (around[v] > 0 ? Math.max(x, (kept * around[v]) / facets[v]) : x));
  }
  return { normals, hollow: Float32Array.from(vertices, (v) => at[v]) };
}

/** Edges between two facets, as pairs of vertices, with the normals of both: an outline where one faces away. */
export interface Outline {
  edges: Int32Array;
  normals: Float32Array;
}

export function outlineOf(vertexCount: number, { vertices }: Facets, { normals }: Relief): Outline {
  const around = [0, 1, 1, 3, 3, 2, 2, 0];
  const first = new Int32Array(vertexCount).fill(-1);
  const next = new Int32Array(vertices.length);
  const other = new Int32Array(vertices.length);
  const edges: number[] = [];
  const both: number[] = [];
  for (let side = 0; side < vertices.length; ++side) {
    const f = side >> 2;
    const [a, b] = [vertices[4 * f + around[2 * (side & 3)]], vertices[4 * f + around[2 * (side & 3) + 1]]];
    const [low, high] = a < b ? [a, b] : [b, a];
    let before = -1;
    let found = first[low];
    while (found >= 0 && other[found] !== high) [before, found] = [found, next[found]];
    if (found < 0) {
      other[side] = high;
      next[side] = first[low];
      first[low] = side;
      continue;
    }
    if (before < 0) first[low] = next[found];
    else next[before] = next[found];
    const [m, n] = [3 * f, 3 * (found >> 2)];
    const flat = normals[m] * normals[n] + normals[m + 1] * normals[n + 1] + normals[m + 2] * normals[n + 2];
    if (flat > 0.999) continue; // both face the same way from everywhere, almost
    edges.push(low, high);
    both.push(normals[m], normals[m + 1], normals[m + 2], normals[n], normals[n + 1], normals[n + 2]);
  }
  return { edges: Int32Array.from(edges), normals: Float32Array.from(both) };
}
