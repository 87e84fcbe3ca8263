// Replayable events as they come out of the core: views into two flat arrays, nothing copied.

/** Changes of topology by full adaptation; the vertices around are relocated with them. */
const operators = [
  'rotate',
  'collapse',
  'open',
  'chord_collapse',
  'chord_split',
  'boundary_collapse',
  'boundary_open',
  'partial_chord_collapse',
  'partial_chord_split',
] as const;
/** In the order of EventKind in core/pillowmesh/adapt/trace.h. */
export const eventKinds = [
  'tags',
  'layer',
  'shrink',
  'connect',
  'dice',
  'relocation',
  'iteration',
  ...operators,
] as const;
export type EventKind = (typeof eventKinds)[number];
export const operatorKinds: ReadonlySet<EventKind> = new Set(operators);

/** What changed. The arrays only grow; a dead cell has corners -1, and a new one may take its number. */
export interface MeshDelta {
  readonly verticesBefore: number;
  readonly verticesAfter: number;
  readonly cellsBefore: number;
  readonly cellsAfter: number;
  /** Moved or new vertices; a new vertex's old point is where its original was. */
  readonly vertices: Int32Array;
  readonly oldPoints: Float64Array;
  readonly newPoints: Float64Array;
  readonly cells: Int32Array;
  readonly oldCorners: Int32Array;
  readonly newCorners: Int32Array;
}

export interface MeshEvent {
  readonly kind: EventKind;
  readonly iteration: number;
  /** tags, iteration: the longest edge; relocation: the energy after the sweep. */
  readonly value: number;
  /** Pairs of vertices. tags: all tagged edges; layer: those it was formed from. */
  readonly edges: Int32Array;
  /** layer: its shrink set; connect: the buffer layer; operators: the cells that change, as they are before. */
  readonly cells: Int32Array;
  /** layer: hull facets, 2^(dim-1) vertices each. */
  readonly hull: Int32Array;
  readonly delta: MeshDelta;
}

const headerSize = 11;

/** How many events the integers of pm_take_events hold. */
export function countEvents(dim: number, ints: Int32Array): number {
  const corners = 1 << dim;
  let count = 0;
  for (let i = 0; i < ints.length; ++count) {
    const [edges, cells, hull, moved, changed] = [2, 3, 4, 9, 10].map((k) => ints[i + k]);
    i += headerSize + 2 * edges + cells + (corners / 2) * hull + moved + (1 + 2 * corners) * changed;
  }
  return count;
}

/** Decodes the result of pm_take_events. */
export function decodeEvents(dim: number, ints: Int32Array, doubles: Float64Array): MeshEvent[] {
  const corners = 1 << dim;
  const events: MeshEvent[] = [];
  let i = 0;
  let d = 0;
  const takeInts = (count: number): Int32Array => ints.subarray(i, (i += count));
  const takeDoubles = (count: number): Float64Array => doubles.subarray(d, (d += count));
  while (i < ints.length) {
    const [
      kind,
      iteration,
      edges,
      cells,
      hull,
      verticesBefore,
      verticesAfter,
      cellsBefore,
      cellsAfter,
      moved,
      changed,
    ] = takeInts(headerSize) as unknown as number[];
    const value = takeDoubles(1)[0];
    events.push({
      kind: eventKinds[kind],
      iteration: iteration,
      value,
      edges: takeInts(2 * edges),
      cells: takeInts(cells),
      hull: takeInts((corners / 2) * hull),
      delta: {
        verticesBefore: verticesBefore,
        verticesAfter: verticesAfter,
        cellsBefore: cellsBefore,
        cellsAfter: cellsAfter,
        vertices: takeInts(moved),
        cells: takeInts(changed),
        oldCorners: takeInts(corners * changed),
        newCorners: takeInts(corners * changed),
        oldPoints: takeDoubles(dim * moved),
        newPoints: takeDoubles(dim * moved),
      },
    });
  }
  return events;
}
