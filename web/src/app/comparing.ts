// Keeps the comparison that the settings ask for, if any, over the picture.
import type { Measures } from '../../../wasm/protocol.ts';
import type { Stage } from '../stage/stage.ts';
import type { Settings } from '../state/settings.ts';
import type { Comparison } from './compare.ts';

export class Comparing {
  private shown: { question: string; comparison: Promise<Comparison> } | null = null;

  constructor(
    private readonly stage: Stage,
    private readonly host: () => HTMLElement | null,
    private readonly tell: (error: unknown) => void,
  ) {}

  /** To be called when anything may have changed. */
  update(settings: Settings): void {
    const { mesh, formula, sketch, options, targetCells, compare } = settings;
    const question = compare && !this.stage.subject.empty ? JSON.stringify([mesh, formula, sketch, options, targetCells, compare]) : '';
    if (question !== (this.shown?.question ?? '')) {
      this.shown?.comparison.then((old) => old.close()).catch(() => undefined);
      this.shown = question ? { question, comparison: this.begin(compare) } : null;
    }
    this.shown?.comparison.then((comparison) => comparison.update(settings)).catch(() => undefined);
  }

  setFirst({ lengths, shapes }: Measures): void {
    const { dim } = this.stage.player.mesh;
    void this.shown?.comparison.then(async (comparison) => {
      const { summaryOfMeasures } = await import('./compare.ts');
      comparison.setFirst(summaryOfMeasures(lengths, shapes, dim));
    });
  }

  private async begin(rival: string): Promise<Comparison> {
    const { compare } = await import('./compare.ts');
    const comparison = await compare(this.stage, rival, this.tell);
    this.host()?.append(comparison.element);
    if (this.stage.measures) queueMicrotask(() => this.setFirst(this.stage.measures!));
    return comparison;
  }
}
