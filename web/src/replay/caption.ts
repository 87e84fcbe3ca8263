// Each event in one sentence.
import type { MeshEvent } from '../../../wasm/events.ts';
import type { ReplayMesh } from './replay_mesh.ts';

export const cellWord = (dim: number, count: number): string =>
  dim === 2 ? (count === 1 ? 'quad' : 'quads') : count === 1 ? 'hex' : 'hexes';

const number = (value: number): string => Number(value.toPrecision(3)).toString();
const counted = (count: number, one: string, many = `${one}s`): string => `${count.toLocaleString('en')} ${count === 1 ? one : many}`;

export function captionOf(event: MeshEvent | undefined, mesh: ReplayMesh, threshold: string, total: number): string {
  const cells = (count: number): string => counted(count, cellWord(mesh.dim, 1), cellWord(mesh.dim, 2));
  if (!event)
    return total === 0
      ? `The initial mesh: ${cells(mesh.liveCellCount())}. Each ellipse is the size and shape of cell that the metric asks for there.`
      : `The initial mesh: ${cells(mesh.liveCellCount())}, before anything is done to it.`;
  switch (event.kind) {
    case 'tags':
      return event.edges.length === 0
        ? `No edge is longer than ${threshold} any more: nothing is left to refine.`
        : `Tags: ${counted(event.edges.length / 2, 'edge')} to refine, longer than ${threshold} in the metric ` +
            `or tagged for balance; the longest measures ${number(event.value)}.`;
    case 'layer':
      return `Layer: ${cells(event.cells.length)} joined through parallel tagged edges form the shrink set; its outline is the hull.`;
    case 'shrink':
      return `Shrink: the hull’s ${counted(event.delta.verticesAfter - event.delta.verticesBefore, 'vertex is', 'vertices are')} duplicated and the layer contracts; a void opens around it.`;
    case 'connect':
      return `Connect: ${cells(event.cells.length)} of a buffer layer fill the void; the mesh is conforming again.`;
    case 'dice':
      return `Dice: every cell is split, which gives ${cells(mesh.liveCellCount())}.`;
    case 'relocation':
      return `Smooth: ${counted(event.delta.vertices.length, 'vertex moves', 'vertices move')} to even out size and shape in the metric.`;
    case 'iteration':
      return `Iteration ${event.iteration} ends with ${cells(mesh.liveCellCount())}; the longest edge measures ${number(event.value)}.`;
  }
}
