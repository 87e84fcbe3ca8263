// Sentences and legends made of the page's state.
import type { RunResult } from '../../../wasm/protocol.ts';
import type { MeshArrays } from '../../../wasm/session.ts';
import type { LegendContent } from '../panels/legend.ts';
import { cellWord } from '../replay/caption.ts';
import type { Colouring, MeshChoice } from '../state/settings.ts';
import { grouped } from '../ui/dom.ts';

/** "plate.msh: 63 quads, 80 vertices at the start" */
export function summaryOf(choice: MeshChoice, { dim, cells, points }: MeshArrays): string {
  const count = cells.length >> dim;
  const name = choice.kind === 'file' ? `${choice.name}: ` : '';
  const vertices = grouped(points.length / dim);
  return `${name}${grouped(count)} ${cellWord(dim, count)}, ${vertices} vertices at the start`;
}

/** "2,326 quads in 0.8 s." and, if something is left to say, that. */
export function outcomeOf({ outcome, seconds }: RunResult, cells: number | undefined, dim: number): string {
  const made = cells === undefined ? 'Done' : `${grouped(cells)} ${cellWord(dim, cells)}`;
  const sentence = `${made} in ${seconds.toFixed(seconds < 10 ? 1 : 0)} s.`;
  return outcome.status === 'ok' ? sentence : `${sentence} ${outcome.message}`;
}

export function legendOf(colouring: Colouring, colours: Uint8Array | null, iterations: number): LegendContent | null {
  if (!colours) return null;
  switch (colouring) {
    case 'length':
      return { colours, title: 'Metric length l', low: '¼ too short', high: '4 too long' };
    case 'jacobian':
      return { colours, title: 'Scaled Jacobian', low: '0 flat', high: '1 right angles' };
    case 'age':
      return { colours, title: 'Made in iteration', low: 'initial', high: String(iterations) };
    default:
      return { colours, title: 'Shape η', low: '0 flat', high: '1 unit' };
  }
}
