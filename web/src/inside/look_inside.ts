// What a visitor has set to look inside a hexahedral mesh, and which cells that leaves.
import type { ReplayMesh } from '../replay/replay_mesh.ts';

export const cutKinds = ['off', 'plane', 'slab'] as const;
export type CutKind = (typeof cutKinds)[number];

/** Whole cells are cut away: those whose centre lies beyond a plane or, for a slab, outside two planes. */
export interface Cut {
  kind: CutKind;
  /** Direction towards which cells are cut away, in degrees: turn about z from the x axis, tilt out of the xy plane. */
  turn: number;
  tilt: number;
  /** Where the plane is, as a share of the mesh's extent in that direction. */
  position: number;
  /** Of the slab, as a share likewise. */
  thickness: number;
}

export const qualityMeasures = ['eta', 'jacobian', 'length'] as const;
/** Shape, scaled Jacobian, and the metric length l of a cell's edges as l / (1 + l), so that it fits between 0 and 1. */
export type QualityMeasure = (typeof qualityMeasures)[number];

export const bodies = ['auto', 'solid', 'glass'] as const;
/** How cells are drawn; auto: as glass while tags or a layer stand out inside. */
export type Body = (typeof bodies)[number];

export interface Inside {
  cut: Cut;
  /** Layers of cells taken off from the boundary. */
  peel: number;
  /** Only cells with low <= measure <= high are kept. */
  quality: { measure: QualityMeasure; low: number; high: number };
  body: Body;
  irregular: boolean;
  /** Cells taken away by hand. */
  without: readonly number[];
  /** Only these cells and those that share a vertex with them are left; empty: all. */
  around: readonly number[];
}

export function defaultInside(): Inside {
  return {
    cut: { kind: 'off', turn: 0, tilt: 0, position: 0.5, thickness: 0.2 },
    peel: 0,
    quality: { measure: 'eta', low: 0, high: 1 },
    body: 'auto',
    irregular: false,
    without: [],
    around: [],
  };
}

export const isFiltered = ({ low, high }: Inside['quality']): boolean => low > 0 || high < 1;

/** Whether cells are hidden or drawn in another way than at first. */
export function looksInside({ cut, peel, quality, body, irregular, without, around }: Inside): boolean {
  return (
    cut.kind !== 'off' || peel > 0 || isFiltered(quality) || body !== 'auto' || irregular || without.length + around.length > 0
  );
}

const degree = Math.PI / 180;

/** Unit vector of a turn and a tilt. */
export function directionOf({ turn, tilt }: { turn: number; tilt: number }): [number, number, number] {
  const flat = Math.cos(tilt * degree);
  return [flat * Math.cos(turn * degree), flat * Math.sin(turn * degree), Math.sin(tilt * degree)];
}

/** Turn and tilt of a direction in whole degrees. */
export function anglesOf([x, y, z]: readonly number[]): { turn: number; tilt: number } {
  const tilt = Math.round(Math.atan2(z, Math.hypot(x, y)) / degree);
  const turn = Math.abs(tilt) === 90 ? 0 : Math.round(Math.atan2(y, x) / degree);
  return { turn: turn === -180 ? 180 : turn, tilt };
}

/** Whether a value passes. At its end a bound holds nothing back: cells worse than 0 and better than 1 exist. */
export function passes({ low, high }: Inside['quality'], value: number): boolean {
  return !((low > 0 && value < low) || (high < 1 && value > high));
}

/** 1 for each cell that is left. `depths` as of cellDepths; `faded`: cells that are filtered out. */
export function keptCells(
  mesh: ReplayMesh,
  { cut, peel, without, around }: Inside,
  depths: () => Int32Array,
  faded: (cell: number) => boolean,
): Uint8Array {
  const { cells, cellCount, points } = mesh;
  const kept = new Uint8Array(cellCount);
  for (let c = 0; c < cellCount; ++c) kept[c] = cells[8 * c] >= 0 ? 1 : 0;
  if (cut.kind !== 'off') {
    const along = projections(mesh, directionOf(cut));
    const height = new Float64Array(cellCount);
    for (let c = 0; c < cellCount; ++c)
      if (kept[c]) for (let k = 0; k < 8; ++k) height[c] += along.heights[cells[8 * c + k]] / 8;
    const size = along.high - along.low;
    const slack = 1e-9 * size; // rows of cells whose centres lie in the plane stay or go together
    const top = along.low + cut.position * size + slack;
    const bottom = cut.kind === 'slab' ? top - cut.thickness * size - 2 * slack : -Infinity;
    for (let c = 0; c < cellCount; ++c) if (height[c] > top || height[c] < bottom) kept[c] = 0;
  }
  if (peel > 0) {
    const depth = depths();
    for (let c = 0; c < cellCount; ++c) if (depth[c] < peel) kept[c] = 0;
  }
  for (let c = 0; c < cellCount; ++c) if (kept[c] && faded(c)) kept[c] = 0;
  const middle = around.filter((c) => c < cellCount && cells[8 * c] >= 0); // in another moment it may not be there
  if (middle.length > 0) {
    const near = new Set(middle.flatMap((c) => Array.from(cells.subarray(8 * c, 8 * c + 8))));
    for (let c = 0; c < cellCount; ++c) if (kept[c] && !cells.subarray(8 * c, 8 * c + 8).some((v) => near.has(v))) kept[c] = 0;
  }
  for (const c of without) if (c < cellCount) kept[c] = 0;
  return kept;

  function projections({ vertexCount }: ReplayMesh, [x, y, z]: [number, number, number]) {
    const heights = new Float64Array(vertexCount);
    let low = Infinity;
    let high = -Infinity;
    for (let v = 0; v < vertexCount; ++v) {
      const h = (heights[v] = x * points[3 * v] + y * points[3 * v + 1] + z * points[3 * v + 2]);
      if (h < low) low = h;
      if (h > high) high = h;
    }
    return { heights, low, high };
  }
}

/** What is shown alone, in units of its measure. */
export function pickedRange({ measure, low, high }: Inside['quality']): [number, number] | null {
  if (low <= 0 && high >= 1) return null;
  return measure === 'length' ? [low / (1 - low), high < 1 ? high / (1 - high) : Infinity] : [low, high];
}

/** The same look with the cells in a range of values alone; null: all. */
export function withRange(inside: Inside, measure: QualityMeasure, range: [number, number] | null): Inside {
  const share = (value: number): number => (measure === 'length' ? value / (1 + value) : value);
  const [low, high] = range ? range.map((value) => Math.min(1, Math.max(0, share(value)))) : [0, 1];
  return { ...inside, quality: { measure, low, high } };
}
