// The problem of the lesson on the solver loop, and what is read off its curve.
import type { Function2 } from './q1.ts';

const [steep, bend] = [60, 0.1];
const phase: Function2 = (x, y) => steep * (x - 0.5 - bend * Math.sin(2 * Math.PI * y));

/** The interior shock of docs/convergence.md, and the source that has it as its solution. */
export const exact: Function2 = (x, y) => Math.tanh(phase(x, y));
export const source: Function2 = (x, y) => {
  const [t, slope] = [exact(x, y), 2 * Math.PI * bend * Math.cos(2 * Math.PI * y)];
  const laplacian = steep * 4 * Math.PI ** 2 * bend * Math.sin(2 * Math.PI * y);
  return -(1 - t * t) * (laplacian - 2 * t * steep ** 2 * (1 + slope * slope));
};

/** On a curve of errors. */
export interface Point {
  cells: number;
  error: number;
}

/** How many equal squares have this error, by the straight line through the last two. */
export function needed(uniform: readonly Point[], error: number): number {
  if (uniform.length < 2) return NaN;
  const [a, b] = uniform.slice(-2);
  const slope = Math.log(b.error / a.error) / Math.log(b.cells / a.cells);
  return b.cells * (error / b.error) ** (1 / slope);
}
