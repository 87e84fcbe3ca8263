// What is adapted: an initial mesh and a metric on it, and where they come from.
import type { Case, MeshArrays, MeshSource } from '../../../wasm/session.ts';
import type { MeshChoice } from '../state/settings.ts';
import { formulaFor } from './starting_formula.ts';
import type { Workshop } from './workshop.ts';

export const nothing: MeshArrays = { dim: 2, points: new Float64Array(0), cells: new Int32Array(0) };

export class Subject {
  cases: readonly Case[] = [];
  initial: MeshArrays = nothing;
  /** Contents of the meshes that came as files, by name. */
  readonly files = new Map<string, Uint8Array>();
  private readonly workshop: Workshop;

  constructor(workshop: Workshop) {
    this.workshop = workshop;
  }

  /** Asks the core for its cases, once. */
  async begin(): Promise<{ version: string }> {
    const { version, cases } = await this.workshop.call('about', {});
    this.cases = cases;
    return { version };
  }

  get empty(): boolean {
    return this.initial === nothing;
  }

  /** The case's own formula; undefined for other meshes. */
  ownFormula(choice: MeshChoice): string | undefined {
    return choice.kind === 'case' ? this.cases.find((c) => c.name === choice.name)?.formula : undefined;
  }

  /**
   * Opens a mesh with a metric (empty: the case's own, or one that suits the mesh) and gives the formula in force.
   * Rejects when either is refused; then what was open stays.
   */
  async open(choice: MeshChoice, formula: string): Promise<string> {
    if (this.cases.length === 0) await this.begin();
    const source: MeshSource =
      choice.kind === 'file'
        ? { ...choice, bytes: this.files.get(choice.name) ?? new Uint8Array(0) }
        : choice;
    let text = formula || this.ownFormula(choice) || '';
    const mesh = await this.workshop.open(source, text ? { formula: text } : undefined);
    if (!text && this.ownFormula(choice) === undefined) {
      text = formulaFor(mesh);
      await this.workshop.setMetric({ formula: text });
    }
    this.initial = mesh;
    return text;
  }

  /** Opens a file that the visitor hands over. */
  async openFile(file: File, open: (choice: MeshChoice) => Promise<boolean>): Promise<void> {
    const before = this.files.get(file.name);
    this.files.set(file.name, new Uint8Array(await file.arrayBuffer()));
    if (await open({ kind: 'file', name: file.name })) return;
    if (before) this.files.set(file.name, before);
    else this.files.delete(file.name);
  }

  /** The ideal number of cells, where the core can tell. */
  async idealCells(): Promise<number | null> {
    try {
      const report = JSON.parse(await this.workshop.call('report', {})) as { complexity?: number };
      return report.complexity ?? null;
    } catch {
      return null;
    }
  }
}
