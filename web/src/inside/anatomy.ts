// What is known of the inside of a hexahedral mesh: computed when asked for, kept until the mesh changes.
import type { ReplayMesh } from '../replay/replay_mesh.ts';
import { irregularEdges, type IrregularEdges } from './irregular_edges.ts';
import { cellDepths } from './measures.ts';
import { facetNeighbours } from './neighbours.ts';

export class Anatomy {
  readonly mesh: ReplayMesh;
  private connectivity = -1;
  private shape = -1;
  private neighbours_: Int32Array | null = null;
  private depths_: { depths: Int32Array; deepest: number } | null = null;
  private irregular_: IrregularEdges | null = null;

  constructor(mesh: ReplayMesh) {
    this.mesh = mesh;
  }

  get neighbours(): Int32Array {
    this.forgetOld();
    return (this.neighbours_ ??= facetNeighbours(this.mesh));
  }

  get depths(): { depths: Int32Array; deepest: number } {
    const { neighbours } = this;
    return (this.depths_ ??= cellDepths(this.mesh, neighbours));
  }

  get irregular(): IrregularEdges {
    const { neighbours } = this;
    return (this.irregular_ ??= irregularEdges(this.mesh, neighbours));
  }

  private forgetOld(): void {
    const { mesh } = this;
    if (this.shape === mesh.changes) return;
    this.shape = mesh.changes;
    this.irregular_ = null;
    if (this.connectivity === mesh.reconnections) return;
    this.connectivity = mesh.reconnections;
    this.neighbours_ = this.depths_ = null;
  }
}
