// Which facets of a hexahedral mesh are drawn, once it is known how each cell is.
import type { ReplayMesh } from '../replay/replay_mesh.ts';
import { hexFacets, outside } from './neighbours.ts';

/** How a cell is drawn. */
export const drawing = { hidden: 0, solid: 1, glass: 2, tinted: 3 } as const;

/** Quadrilaterals as vertices in corner-bit order, four each, and the cell that each belongs to. */
export interface Facets {
  vertices: Int32Array;
  cells: Int32Array;
  /** 1 where the mesh goes on behind the facet. */
  inner: Uint8Array;
  /** 1 or -1: the side of the cross product of the diagonals (0 to 3, 1 to 2) that is outside of the cell. */
  outward: Int8Array;
}

/** By facet = 2 axis + side: the corners of facets across y turn the other way around. */
const outwards = [-1, 1, 1, -1, -1, 1];

/** The facets of the cells for which `wanted` of the cell's drawing and its neighbour's holds. Cost: linear. */
function collect(
  mesh: ReplayMesh,
  neighbours: Int32Array,
  draw: Uint8Array,
  wanted: (own: number, beyond: number) => boolean,
): Facets {
  const { cells, cellCount } = mesh;
  const states = 4;
  const table = new Uint8Array(states * states);
  for (let i = 0; i < table.length; ++i) table[i] = wanted((i / states) | 0, i % states) ? 1 : 0;
  const chosen = new Int32Array(6 * cellCount);
  let count = 0;
  for (let half = 0; half < 6 * cellCount; ++half) {
    const own = draw[(half / 6) | 0];
    if (own === drawing.hidden) continue;
    const neighbour = neighbours[half];
    const beyond = neighbour === outside ? drawing.hidden : draw[neighbour];
    if (table[states * own + beyond]) chosen[count++] = half;
  }
  const facets = { vertices: new Int32Array(4 * count), cells: new Int32Array(count), inner: new Uint8Array(count), outward: new Int8Array(count) };
  for (let i = 0; i < count; ++i) {
    const cell = (chosen[i] / 6) | 0;
    const corners = hexFacets[chosen[i] - 6 * cell];
    for (let k = 0; k < 4; ++k) facets.vertices[4 * i + k] = cells[8 * cell + corners[k]];
    facets.cells[i] = cell;
    facets.outward[i] = outwards[chosen[i] - 6 * cell];
    facets.inner[i] = neighbours[chosen[i]] === outside ? 0 : 1;
  }
  return facets;
}

/** Everything of the solid cells that can be seen. */
export function solidFacets(mesh: ReplayMesh, neighbours: Int32Array, draw: Uint8Array): Facets {
  return collect(mesh, neighbours, draw, (own, beyond) => own === drawing.solid && beyond !== drawing.solid);
}

/** The outside of the cells drawn as glass, and the tinted cells among them. */
export function glassFacets(mesh: ReplayMesh, neighbours: Int32Array, draw: Uint8Array): Facets {
  return collect(mesh, neighbours, draw, (own, beyond) =>
    own === drawing.glass
      ? beyond === drawing.hidden
      : own === drawing.tinted && (beyond === drawing.glass || beyond === drawing.hidden),
  );
}
