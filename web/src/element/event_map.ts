// What <pillow-mesh> tells the page around it.
import type { MeshEvent } from '../../../wasm/events.ts';

/** Events of the element; none bubbles. */
export interface PillowMeshEventMap {
  /** The initial mesh is there. */
  load: CustomEvent<{ cells: number; dim: number }>;
  /** Another mesh is shown: that after `position` of `length` operations. */
  step: CustomEvent<{ position: number; length: number; kind: MeshEvent['kind'] | null; caption: string }>;
  play: CustomEvent<null>;
  pause: CustomEvent<null>;
  /** A run has come to its end. `report` is that of docs/report.md. */
  done: CustomEvent<{ report: unknown; seconds: number; status: string; message: string }>;
  /** Something was refused or failed; the element says so too. */
  error: CustomEvent<{ message: string; error: unknown }>;
}
