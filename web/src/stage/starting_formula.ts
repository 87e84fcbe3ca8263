// A metric to begin with, for a mesh that comes without one.
import type { MeshArrays } from '../../../wasm/session.ts';

const short = (value: number): string => String(Number(value.toPrecision(2)));

/** Cells that are fine in the middle of the domain's longest side and grow away from it. */
export function formulaFor(mesh: MeshArrays): string {
  const { dim, points } = mesh;
  const low = new Array<number>(dim).fill(Infinity);
  const high = new Array<number>(dim).fill(-Infinity);
  points.forEach((x, i) => {
    low[i % dim] = Math.min(low[i % dim], x);
    high[i % dim] = Math.max(high[i % dim], x);
  });
  const sides = low.map((x, d) => high[d] - x);
  const axis = sides.indexOf(Math.max(...sides));
  const longest = sides[axis] || 1;
  const middle = (low[axis] + high[axis]) / 2;
  const fine = dim === 2 ? 60 : 20;
  return `h = ${short(longest / fine)} + 0.1*abs(${'xyz'[axis]} - ${middle < 0 ? `(${short(middle)})` : short(middle)})`;
}
