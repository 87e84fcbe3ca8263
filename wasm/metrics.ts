// Metrics from what users give: pictures, sketches, solutions, functions, walls. Made for a mesh by a module of its own;
// what comes out is for Session.setMetric.
import { CoreError, statusNames } from './errors.ts';
import type { MetricsModule } from './loader.ts';
import { guard, pass, readBytes, readText, type Argument } from './memory.ts';

/** A picture: one byte of brightness per pixel, row by row from the top. */
export interface GrayImage {
  width: number;
  height: number;
  gray: Uint8Array;
}

/** One dab of a brush: `size` within `radius`, growing to that of the paper at twice the radius. */
export interface Dab {
  x: number;
  y: number;
  radius: number;
  size: number;
  /** Radians, of the long side; 0 by default. */
  angle?: number;
  /** Long side / short side (= size); 1 by default. */
  stretch?: number;
}

/** A file as its name, whose ending tells the format, and bytes. */
export interface NamedBytes {
  name: string;
  bytes: Uint8Array;
}

/** Values at the vertices of the mesh, or of another `background` mesh. */
export interface Solution extends NamedBytes {
  background?: NamedBytes;
}

/** What the metric is made from: all that is given intersects. See docs/metrics.md. */
export interface MetricRequest {
  formula?: string;
  /** A Medit .sol with a size or tensor per vertex. */
  sol?: Solution;
  /** A function, e.g. 'tanh(20*(x-.5*sin(3*y)))', whose Hessian is taken. */
  hessianOf?: string;
  /** A Medit .sol with a scalar per vertex, whose Hessian is recovered. */
  hessianSol?: Solution;
  /** A picture, or the portrait of case riemann. */
  image?: GrayImage | 'portrait';
  dabs?: readonly Dab[];
  /** Size where no dab is; a tenth of the diagonal by default. */
  paper?: number;
  /** 'GROUP:FIRST:GROWTH' each. */
  layers?: readonly string[];
  /** Cells on a full circle at curved boundaries. */
  curvature?: number;
  /** A mesh, as Session.input gives it, whose own metric is taken. */
  implied?: Uint8Array;
  /** target-cells, hmin, hmax, max-anisotropy, gradation, norm, error: as on the command line, without dashes. */
  operations?: Record<string, string>;
}

/**
 * The metric for a mesh, given as Session.input gives it. Deterministic: the same request gives the same bytes.
 * Throws a CoreError with a sentence when something in the request cannot be used.
 */
export function makeMetric({ exports }: MetricsModule, mesh: Uint8Array, request: MetricRequest): Uint8Array<ArrayBuffer> {
  const handle = guard(() => exports.pm_metrics_create());
  const check = (status: number): void => {
    if (status === 0) return;
    const message = readText(exports, exports.pm_metrics_message(handle));
    throw new CoreError(statusNames[status] ?? 'illegal', message);
  };
  const call = (args: Argument[], f: (p: number, n: number, q: number, m: number) => number): void =>
    check(pass(exports, args, f));
  try {
    call([mesh], (p, n) => exports.pm_metrics_mesh(handle, p, n));
    // First, for what follows depends on --hmax, --norm and --error.
    for (const [name, value] of Object.entries(request.operations ?? {}))
      call([name, value], (p, n, q, m) => exports.pm_metrics_option(handle, p, n, q, m));
    const { formula, sol, hessianOf, hessianSol, image, dabs, paper, layers, curvature, implied } = request;
    const background = (s: Solution): void => {
      if (!s.background) return;
      const { name, bytes } = s.background;
      call([name, bytes], (p, n, q, m) => exports.pm_metrics_background(handle, p, n, q, m));
    };
    if (formula !== undefined) call([formula], (p, n) => exports.pm_metrics_formula(handle, p, n));
    if (sol) {
      background(sol);
      call([sol.name, sol.bytes], (p, n, q, m) => exports.pm_metrics_sol(handle, p, n, q, m));
    }
    if (hessianOf !== undefined) call([hessianOf], (p, n) => exports.pm_metrics_hessian_of(handle, p, n));
    if (hessianSol) {
      background(hessianSol);
      call([hessianSol.name, hessianSol.bytes], (p, n, q, m) => exports.pm_metrics_hessian_sol(handle, p, n, q, m));
    }
    if (image === 'portrait') check(guard(() => exports.pm_metrics_portrait(handle)));
    else if (image) call([image.gray], (p, n) => exports.pm_metrics_image(handle, p, n, image.width));
    if (dabs) {
      const numbers = dabs.flatMap(({ x, y, radius, size, angle = 0, stretch = 1 }) => [x, y, radius, size, angle, stretch]);
      call([Float64Array.from(numbers)], (p, n) => exports.pm_metrics_sketch(handle, p, n, paper ?? 0));
    }
    for (const layer of layers ?? []) call([layer], (p, n) => exports.pm_metrics_layer(handle, p, n));
    if (curvature !== undefined) check(guard(() => exports.pm_metrics_curvature(handle, curvature)));
    if (implied) call([implied], (p, n) => exports.pm_metrics_implied(handle, p, n));
    check(guard(() => exports.pm_metrics_build(handle)));
    return readBytes(exports, exports.pm_metrics_bytes(handle), exports.pm_metrics_byte_count(handle));
  } finally {
    guard(() => exports.pm_metrics_destroy(handle));
  }
}
