// Lines along which the metric asks for cells of one size, (det M)^(-1/4); each line is twice the next.
import type { ReplayMesh } from '../replay/replay_mesh.ts';

const most = 14_000;

/**
 * Segments, six coordinates each, by marching through small squares of the initial cells; `tensors` evaluates the metric
 * at points.
 */
export async function sampleIsolines(
  mesh: ReplayMesh,
  tensors: (points: Float64Array) => Promise<Float64Array>,
): Promise<Float32Array> {
  const { cells, cellCount, points } = mesh;
  const parts = Math.max(1, Math.min(16, Math.floor(Math.sqrt(most / Math.max(1, mesh.liveCellCount())))));
  const n = parts + 1;
  const samples: number[] = [];
  for (let c = 0; c < cellCount; ++c) {
    if (!mesh.alive(c)) continue;
    for (let j = 0; j < n; ++j)
      for (let i = 0; i < n; ++i) {
        const [u, v] = [i / parts, j / parts];
        const weights = [(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v];
        for (let d = 0; d < 2; ++d)
          samples.push(weights.reduce((sum, w, k) => sum + w * points[2 * cells[4 * c + k] + d], 0));
      }
  }
  const m = await tensors(Float64Array.from(samples));
  const size = Float64Array.from({ length: samples.length / 2 }, (_, i) => {
    const determinant = m[3 * i] * m[3 * i + 2] - m[3 * i + 1] * m[3 * i + 1];
    return -0.25 * Math.log2(determinant);
  });
  const segments: number[] = [];
  for (let block = 0; block < size.length; block += n * n)
    for (let j = 0; j < parts; ++j)
      for (let i = 0; i < parts; ++i) {
        const at = block + j * n + i;
        // Two triangles: no ambiguous squares.
        for (const corners of [[at, at + 1, at + n + 1], [at, at + n + 1, at + n]]) march(corners, samples, size, segments);
      }
  return Float32Array.from(segments);
}

/** The parts of lines within a triangle. */
function march(corners: readonly number[], points: readonly number[], size: Float64Array, out: number[]): void {
  const values = corners.map((i) => size[i]);
  const high = Math.floor(Math.max(...values));
  for (let level = Math.ceil(Math.min(...values)); level <= high; ++level) {
    const ends: number[] = [];
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [k, (k + 1) % 3];
      if (values[a] < level === values[b] < level) continue;
      const t = (level - values[a]) / (values[b] - values[a]);
      for (let d = 0; d < 2; ++d)
        ends.push(points[2 * corners[a] + d] + t * (points[2 * corners[b] + d] - points[2 * corners[a] + d]));
    }
    if (ends.length === 4) out.push(ends[0], ends[1], 0, ends[2], ends[3], 0);
  }
}
