// What an event looks like: which edges, cells and facets stand out after it.
import type { MeshEvent } from '../../../wasm/events.ts';

/** What stands out beside the mesh. Vertices are those of the mesh after the event. */
export interface Scene {
  /** Tagged edges that still wait, pairs of vertices. */
  tags: Int32Array;
  /** Tagged edges that the present layer was formed from. */
  layerEdges: Int32Array;
  /** Cells of the present shrink set. */
  layer: Int32Array;
  /** Hull facets of the present shrink set. */
  hull: Int32Array;
  /** Cells of the buffer layer just inserted. */
  buffer: Int32Array;
}

const none = new Int32Array(0);
export const emptyScene: Scene = { tags: none, layerEdges: none, layer: none, hull: none, buffer: none };

/** Edges as one number each, for sets. */
function edgeKey(a: number, b: number): number {
  return Math.min(a, b) * 2 ** 26 + Math.max(a, b);
}

function addEdges(set: Map<number, [number, number]>, edges: Int32Array): void {
  for (let i = 0; i < edges.length; i += 2) set.set(edgeKey(edges[i], edges[i + 1]), [edges[i], edges[i + 1]]);
}

/** The tags that wait after events[0 .. count): those found last, less those that layers have used since. */
function waitingTags(events: readonly MeshEvent[], count: number): Int32Array {
  let start = count - 1;
  while (start >= 0 && events[start].kind !== 'tags') {
    if (events[start].kind === 'iteration') return none;
    --start;
  }
  if (start < 0) return none;
  const waiting = new Map<number, [number, number]>();
  addEdges(waiting, events[start].edges);
  for (let i = start + 1; i < count; ++i) {
    const { kind, edges } = events[i];
    // A layer uses its tags when it is shrunk; what the new edges inherit comes with `connect`.
    if (kind === 'shrink') for (const edge of usedBy(events, i)) waiting.delete(edge);
    if (kind === 'connect') addEdges(waiting, edges);
    if (kind === 'dice' || kind === 'relocation') waiting.clear();
  }
  return Int32Array.from([...waiting.values()].flat());
}

function usedBy(events: readonly MeshEvent[], shrink: number): number[] {
  const layer = events[shrink - 1];
  if (layer?.kind !== 'layer') return [];
  const keys: number[] = [];
  for (let i = 0; i < layer.edges.length; i += 2) keys.push(edgeKey(layer.edges[i], layer.edges[i + 1]));
  return keys;
}

/** What stands out after events[0 .. count). Cost: linear in the events of the present iteration. */
export function sceneAfter(events: readonly MeshEvent[], count: number): Scene {
  if (count === 0) return emptyScene;
  const event = events[count - 1];
  const tags = waitingTags(events, count);
  switch (event.kind) {
    case 'layer':
      return { tags, layerEdges: event.edges, layer: event.cells, hull: event.hull, buffer: none };
    case 'shrink':
    case 'connect': {
      const back = event.kind === 'shrink' ? 2 : 3;
      const layer = events[count - back];
      const known = layer?.kind === 'layer';
      return {
        tags,
        layerEdges: none,
        layer: known ? layer.cells : none,
        hull: known ? layer.hull : none,
        buffer: event.kind === 'connect' ? event.cells : none,
      };
    }
    default:
      return { ...emptyScene, tags };
  }
}
