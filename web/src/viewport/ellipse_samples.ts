// Where metric ellipses are drawn: about as many in each cell as the metric asks for cells there.
import type { ReplayMesh } from '../replay/replay_mesh.ts';

const most = 2600;
/** Ellipses per unit of metric length: a little less than 1 leaves air between them. */
const density = 0.8;

type Tensors = (points: Float64Array) => Promise<Float64Array>;

export interface EllipseSamples {
  centres: Float64Array;
  tensors: Float64Array;
}

interface Quad {
  corners: number[][];
  /** Metric length along each local axis at the centre. */
  lengths: [number, number];
}

function at(corners: number[][], u: number, v: number): [number, number] {
  const weights = [(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v];
  return [0, 1].map((d) => weights.reduce((sum, w, k) => sum + w * corners[k][d], 0)) as [number, number];
}

/** Samples of a 2D mesh; `tensors` evaluates the metric. */
export async function sampleEllipses(mesh: ReplayMesh, tensors: Tensors): Promise<EllipseSamples> {
  const quads: Quad[] = [];
  const stride = Math.max(1, Math.ceil(mesh.liveCellCount() / most));
  for (let c = 0; c < mesh.cellCount; c += stride) {
    if (!mesh.alive(c)) continue;
    const corners = Array.from(mesh.cells.subarray(4 * c, 4 * c + 4), (v) => [mesh.points[2 * v], mesh.points[2 * v + 1]]);
    quads.push({ corners, lengths: [1, 1] });
  }
  const middles = Float64Array.from(quads.flatMap(({ corners }) => at(corners, 0.5, 0.5)));
  const m = await tensors(middles);
  quads.forEach((quad, i) => {
    quad.lengths = [0, 1].map((axis) => {
      const [a, b] = axis === 0 ? [at(quad.corners, 0, 0.5), at(quad.corners, 1, 0.5)] : [at(quad.corners, 0.5, 0), at(quad.corners, 0.5, 1)];
      const [x, y] = [b[0] - a[0], b[1] - a[1]];
      return Math.sqrt(m[3 * i] * x * x + 2 * m[3 * i + 1] * x * y + m[3 * i + 2] * y * y);
    }) as [number, number];
  });

  let scale = density;
  const split = (length: number): number => Math.max(1, Math.floor(length * scale));
  const total = (): number => quads.reduce((sum, { lengths }) => sum + split(lengths[0]) * split(lengths[1]), 0);
  while (total() > most && scale > 0.02) scale *= 0.8;

  const centres: number[] = [];
  for (const { corners, lengths } of quads) {
    const [nu, nv] = lengths.map(split);
    for (let j = 0; j < nv; ++j) for (let i = 0; i < nu; ++i) centres.push(...at(corners, (i + 0.5) / nu, (j + 0.5) / nv));
  }
  const points = Float64Array.from(centres);
  return { centres: points, tensors: await tensors(points.slice()) };
}
