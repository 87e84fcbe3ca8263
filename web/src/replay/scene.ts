// What an event looks like: which edges, cells and facets stand out after it.
import { operatorKinds, type EventKind, type MeshEvent } from '../../../wasm/events.ts';

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

function removeEdges(set: Map<number, [number, number]>, edges: Int32Array): void {
  for (let i = 0; i < edges.length; i += 2) set.delete(edgeKey(edges[i], edges[i + 1]));
}

function addEdges(set: Map<number, [number, number]>, edges: Int32Array): void {
  for (let i = 0; i < edges.length; i += 2) set.set(edgeKey(edges[i], edges[i + 1]), [edges[i], edges[i + 1]]);
}

/**
 * The tags that wait after events[0 .. count): those found last that no layer has used since, and those that new edges
 * have inherited. The latter are known by the layers of this iteration that use them later: an edge between two
 * vertices that exist already exists itself, because later ones only ever join copies to their originals.
 */
function waitingTags(events: readonly MeshEvent[], count: number): Int32Array {
  let start = count - 1;
  while (start >= 0 && events[start].kind !== 'tags') {
    if (!steps.has(events[start].kind)) return none;
    --start;
  }
  if (start < 0) return none;
  const waiting = new Map<number, [number, number]>();
  addEdges(waiting, events[start].edges);
  let i = start + 1;
  for (; i < count; ++i)
    if (events[i].kind === 'shrink' && events[i - 1].kind === 'layer') removeEdges(waiting, events[i - 1].edges);
  const vertices = events[count - 1].delta.verticesAfter;
  for (; i < events.length && steps.has(events[i].kind); ++i) {
    const { kind, edges } = events[i];
    if (kind !== 'layer') continue;
    for (let k = 0; k < edges.length; k += 2)
      if (edges[k] < vertices && edges[k + 1] < vertices) addEdges(waiting, edges.subarray(k, k + 2));
  }
  return Int32Array.from([...waiting.values()].flat());
}

/** What happens between the tags of an iteration and its end. */
const steps: ReadonlySet<EventKind> = new Set(['layer', 'shrink', 'connect']);

/** The cells that an operator has made or changed. */
function changedCells({ delta }: MeshEvent): Int32Array {
  const corners = delta.newCorners.length / Math.max(1, delta.cells.length);
  return delta.cells.filter((_, i) => delta.newCorners[i * corners] >= 0);
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
      if (operatorKinds.has(event.kind)) return { ...emptyScene, buffer: changedCells(event) };
      return { ...emptyScene, tags };
  }
}
