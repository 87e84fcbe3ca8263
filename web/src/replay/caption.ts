// Each event in one sentence.
import type { MeshEvent } from '../../../wasm/events.ts';
import { grouped } from '../ui/dom.ts';
import type { ReplayMesh } from './replay_mesh.ts';

export const cellWord = (dim: number, count: number): string => {
  const [one, many] = dim === 2 ? ['quad', 'quads'] : ['hex', 'hexes'];
  return count === 1 ? one : many;
};

const counted = (count: number, one: string, many: string): string =>
  `${grouped(count)} ${count === 1 ? one : many}`;

const longest = (length: number): string =>
  length > 0 ? `; the longest edge measures ${Number(length.toPrecision(3))}` : '';

/** `total`: events known so far; `threshold`: as set, for the sentence about tags; `glyphs`: the metric is drawn. */
export function captionOf(
  event: MeshEvent | undefined,
  mesh: ReplayMesh,
  threshold: string,
  total: number,
  glyphs: boolean,
): string {
  const cells = (count: number): string => counted(count, cellWord(mesh.dim, 1), cellWord(mesh.dim, 2));
  const now = (): string => cells(mesh.liveCellCount());
  if (!event) {
    if (total > 0) return `The initial mesh: ${now()}, before anything is done to it.`;
    const glyph = mesh.dim === 2 ? 'ellipse' : 'ellipsoid';
    return (
      `The initial mesh: ${now()}. ${glyphs ? `Each ${glyph} is the cell wanted there. ` : ''}` +
      'Press play: layers come in until every edge measures about 1 in the metric.'
    );
  }
  const { kind, iteration, edges, delta, value } = event;
  switch (kind) {
    case 'tags': {
      const tagged = counted(edges.length / 2, 'edge is', 'edges are');
      return (
        `Iteration ${iteration + 1}: ${tagged} tagged, longer than ${threshold} in the metric ` +
        `or tagged for balance${longest(value)}.`
      );
    }
    case 'layer':
      return (
        `${cells(event.cells.length)} joined through parallel tagged edges form a layer, the shrink set; ` +
        'its outline is the hull.'
      );
    case 'shrink': {
      const copies = counted(delta.verticesAfter - delta.verticesBefore, 'vertex is', 'vertices are');
      return `The hull’s ${copies} duplicated and the layer shrinks; a void opens around it.`;
    }
    case 'connect':
      return `${cells(event.cells.length)} of a buffer layer fill the void; the mesh is conforming again.`;
    case 'dice':
      return `Every cell is split, which gives ${now()}.`;
    case 'relocation': {
      const moved = counted(delta.vertices.length, 'vertex moves', 'vertices move');
      return `${moved} to even out size and shape in the metric.`;
    }
    case 'rotate':
      return 'An edge is turned inside the hexagon of its two quads, and the vertices around are moved.';
    case 'collapse':
      return `A quad is removed by merging two opposite vertices; ${now()} are left.`;
    case 'open':
      return `A vertex is split along two of its edges, and a quad fills the gap; that gives ${now()}.`;
    case 'chord_collapse':
      return `A whole row is removed, from boundary to boundary or all around; ${now()} are left.`;
    case 'chord_split':
      return `A whole row is doubled, from boundary to boundary or all around; that gives ${now()}.`;
    case 'boundary_collapse':
      return `Two boundary edges are laid on each other, and the rows that ended there become one; ${now()} are left.`;
    case 'boundary_open':
      return `A boundary vertex is split in three, and a row that turned inside ends there twice; that gives ${now()}.`;
    case 'partial_chord_collapse':
      return `Part of a row is removed by merging opposite vertices of its quads; ${now()} are left.`;
    case 'partial_chord_split':
      return `A path of edges opens into part of a row, which ends inside the mesh; that gives ${now()}.`;
    case 'iteration':
      return `Iteration ${iteration} ends with ${now()}${longest(value)}.`;
  }
}
