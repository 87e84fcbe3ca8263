// Each event in one sentence.
import type { MeshEvent } from '../../../wasm/events.ts';
import type { ReplayMesh } from './replay_mesh.ts';

export const cellWord = (dim: number, count: number): string =>
  dim === 2 ? (count === 1 ? 'quad' : 'quads') : count === 1 ? 'hex' : 'hexes';

const longest = (value: number): string => (value > 0 ? `; the longest edge measures ${number(value)}` : '');
const number = (value: number): string => Number(value.toPrecision(3)).toString();
const counted = (count: number, one: string, many = `${one}s`): string => `${count.toLocaleString('en')} ${count === 1 ? one : many}`;

export function captionOf(event: MeshEvent | undefined, mesh: ReplayMesh, threshold: string, total: number): string {
  const cells = (count: number): string => counted(count, cellWord(mesh.dim, 1), cellWord(mesh.dim, 2));
  if (!event) {
    const initial = `The initial mesh: ${cells(mesh.liveCellCount())}`;
    if (total > 0) return `${initial}, before anything is done to it.`;
    const wish = mesh.dim === 2 ? ' Each ellipse is the cell that the metric wants there.' : '';
    return `${initial}.${wish} Press play: layers of ${cellWord(mesh.dim, 2)} are inserted until every edge has a metric length of about 1.`;
  }
  switch (event.kind) {
    case 'tags':
      return event.edges.length === 0
        ? `No edge is longer than ${threshold} any more: nothing is left to refine.`
        : `Iteration ${event.iteration + 1}: ${counted(event.edges.length / 2, 'edge is', 'edges are')} tagged, longer than ${threshold} in the metric ` +
            `or tagged for balance${longest(event.value)}.`;
    case 'layer':
      return `${cells(event.cells.length)} joined through parallel tagged edges form a layer, the shrink set; its outline is the hull.`;
    case 'shrink':
      return `The hull’s ${counted(event.delta.verticesAfter - event.delta.verticesBefore, 'vertex is', 'vertices are')} duplicated and the layer shrinks; a void opens around it.`;
    case 'connect':
      return `${cells(event.cells.length)} of a buffer layer fill the void; the mesh is conforming again.`;
    case 'dice':
      return `Every cell is split, which gives ${cells(mesh.liveCellCount())}.`;
    case 'relocation':
      return `${counted(event.delta.vertices.length, 'vertex moves', 'vertices move')} to even out size and shape in the metric.`;
    case 'iteration':
      return `Iteration ${event.iteration} ends with ${cells(mesh.liveCellCount())}${longest(event.value)}.`;
  }
}
