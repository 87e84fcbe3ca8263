// The viewer's own copy of the mesh: points and cells alone, changed by applying and reverting deltas.
import type { MeshDelta } from '../../../wasm/events.ts';
import type { MeshArrays } from '../../../wasm/session.ts';

function grown<T extends Float64Array | Int32Array | Uint8Array>(array: T, size: number): T {
  if (array.length >= size) return array;
  const next = new (array.constructor as new (n: number) => T)(Math.ceil(size * 1.6));
  next.set(array as never);
  return next;
}

export class ReplayMesh {
  readonly dim: number;
  readonly cornerCount: number;
  vertexCount: number;
  cellCount: number;
  /** At least vertexCount * dim coordinates. */
  points: Float64Array;
  /** At least cellCount * cornerCount vertices, in corner-bit order; -1 throughout for a dead cell. */
  cells: Int32Array;
  /** The iteration in which each cell was made, from 1; 0 for the initial ones. */
  birth: Int32Array;
  /** How often the mesh has changed, and its connectivity: for what is derived and kept. */
  changes = 0;
  reconnections = 0;
  private movedVertices: Uint8Array;
  private changedCells: Uint8Array;

  constructor(mesh: MeshArrays) {
    this.dim = mesh.dim;
    this.cornerCount = 1 << mesh.dim;
    this.points = mesh.points.slice();
    this.cells = mesh.cells.slice();
    this.vertexCount = mesh.points.length / mesh.dim;
    this.cellCount = mesh.cells.length / this.cornerCount;
    this.birth = new Int32Array(this.cellCount);
    this.movedVertices = new Uint8Array(this.vertexCount);
    this.changedCells = new Uint8Array(this.cellCount).fill(1);
  }

  alive(cell: number): boolean {
    return this.cells[cell * this.cornerCount] >= 0;
  }

  liveCellCount(): number {
    let count = 0;
    for (let c = 0; c < this.cellCount; ++c) if (this.alive(c)) ++count;
    return count;
  }

  /** `iteration`: how many iterations are over. */
  apply(delta: MeshDelta, iteration: number): void {
    this.resize(delta.verticesAfter, delta.cellsAfter);
    this.write(delta, delta.newPoints, delta.newCorners);
    for (let i = 0; i < delta.cells.length; ++i)
      if (delta.oldCorners[i * this.cornerCount] < 0) this.birth[delta.cells[i]] = iteration + 1;
  }

  revert(delta: MeshDelta): void {
    this.write(delta, delta.oldPoints, delta.oldCorners);
    this.resize(delta.verticesBefore, delta.cellsBefore);
  }

  /** Cells that look different since the last call: their corners changed or moved. Cost: linear in the mesh. */
  takeDirtyCells(): Int32Array {
    const dirty = new Int32Array(this.cellCount);
    let count = 0;
    const { cells, cornerCount, movedVertices, changedCells } = this;
    for (let c = 0; c < this.cellCount; ++c) {
      let changed = changedCells[c] === 1;
      const first = c * cornerCount;
      if (!changed && cells[first] >= 0)
        for (let k = 0; k < cornerCount && !changed; ++k) changed = movedVertices[cells[first + k]] === 1;
      if (changed) dirty[count++] = c;
    }
    movedVertices.fill(0);
    changedCells.fill(0);
    return dirty.subarray(0, count);
  }

  /** Copies of exactly what is there, for the worker. */
  snapshot(): { points: Float64Array; cells: Int32Array } {
    return {
      points: this.points.slice(0, this.vertexCount * this.dim),
      cells: this.cells.slice(0, this.cellCount * this.cornerCount),
    };
  }

  /** Low and high corner of the bounding box. */
  bounds(): { low: number[]; high: number[] } {
    const low = new Array<number>(this.dim).fill(Infinity);
    const high = new Array<number>(this.dim).fill(-Infinity);
    for (let i = 0; i < this.vertexCount * this.dim; ++i) {
      const axis = i % this.dim;
      low[axis] = Math.min(low[axis], this.points[i]);
      high[axis] = Math.max(high[axis], this.points[i]);
    }
    return { low, high };
  }

  private resize(vertices: number, cells: number): void {
    this.points = grown(this.points, vertices * this.dim);
    this.movedVertices = grown(this.movedVertices, vertices);
    this.cells = grown(this.cells, cells * this.cornerCount);
    this.birth = grown(this.birth, cells);
    this.changedCells = grown(this.changedCells, cells);
    this.vertexCount = vertices;
    this.cellCount = cells;
  }

  private write(delta: MeshDelta, points: Float64Array, corners: Int32Array): void {
    const { dim, cornerCount } = this;
    ++this.changes;
    if (delta.cells.length > 0) ++this.reconnections;
    for (let i = 0; i < delta.vertices.length; ++i) {
      const v = delta.vertices[i];
      for (let d = 0; d < dim; ++d) this.points[v * dim + d] = points[i * dim + d];
      this.movedVertices[v] = 1;
    }
    for (let i = 0; i < delta.cells.length; ++i) {
      const c = delta.cells[i];
      for (let k = 0; k < cornerCount; ++k) this.cells[c * cornerCount + k] = corners[i * cornerCount + k];
      this.changedCells[c] = 1;
    }
  }
}
