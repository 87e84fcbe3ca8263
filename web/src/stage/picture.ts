// The picture and what belongs to it: loaded when needed, survives a browser without WebGL.
import type { Measures } from '../../../wasm/protocol.ts';
import type { MeshArrays } from '../../../wasm/session.ts';
import { defaultInside, isFiltered, passes, type Inside, type QualityMeasure } from '../inside/look_inside.ts';
import type { Drawing } from '../export/svg.ts';
import { cellWord } from '../replay/caption.ts';
import type { Player, Shown } from '../replay/player.ts';
import { ReplayMesh } from '../replay/replay_mesh.ts';
import { sceneAfter } from '../replay/scene.ts';
import { defaultMarks, type CameraPose, type Colouring, type Mark } from '../state/settings.ts';
import { h } from '../ui/dom.ts';
import { colourMaps, isDark, readPalette } from '../viewport/palette.ts';
import type { InsideReport } from '../viewport/hex_body.ts';
import type { Pointing } from './pointing.ts';
import type { Viewport } from '../viewport/viewport.ts';

export interface Look {
  colouring: Colouring;
  marks: Record<Mark, boolean>;
  inside: Inside;
}

export class Picture {
  readonly host = h('div', { class: 'picture', role: 'img', 'aria-label': 'The mesh', 'aria-describedby': 'caption' });
  /** Called when the visitor has moved the camera. */
  onPose: () => void = () => undefined;
  /** Called while the camera moves. */
  onMove: () => void = () => undefined;
  /** Called with a sentence when drawing is impossible or comes back (null). */
  onProblem: (sentence: string | null) => void = () => undefined;
  /** Called when something is to be drawn that was not sampled. */
  onWish: () => void = () => undefined;
  /** Called with what there is to see of a hexahedral mesh; null in 2D. */
  onInside: (report: InsideReport | null) => void = () => undefined;

  private viewport: Viewport | null = null;
  private look: Look = {
    colouring: 'plain',
    marks: { ...defaultMarks },
    inside: defaultInside(),
  };
  /** Of the mesh as it was measured last; cells made since are missing. */
  private shapes = new Float64Array(0);
  private lengths = new Float64Array(0);
  private jacobians = { changes: -1, values: new Float64Array(0) };
  private dark = false;
  private pointing: Pointing | null = null;
  /** Comes with the drawing code: nothing else has a use for these measures. */
  private maths: typeof import('../inside/measures.ts') | null = null;
  /** Called with what is told of the cell that is pointed at, null when there is none. */
  onPoint: (sentence: string | null) => void = () => undefined;
  private lastPose: CameraPose | null = null;
  private readonly player: Player;

  constructor(player: Player) {
    this.player = player;
  }

  /** Loads the drawing code; afterwards the mesh is shown, if the browser can. */
  async load(): Promise<void> {
    if (this.viewport) return;
    let make;
    try {
      const [{ Viewport }, pointing, maths] = await Promise.all([
        import('../viewport/viewport.ts'),
        import('./pointing.ts'),
        import('../inside/measures.ts'),
      ]);
      if (this.viewport) return;
      this.maths = maths;
      make = pointing.Pointing;
      this.viewport = new Viewport(this.host);
    } catch (error) {
      const missing = !document.createElement('canvas').getContext('webgl2');
      this.onProblem(
        missing
          ? 'This browser gives no WebGL 2, so the mesh cannot be drawn. Numbers, run and export work all the same.'
          : `The mesh cannot be drawn: ${(error as Error).message}`,
      );
      return;
    }
    this.pointing = new make(this, this.viewport, this.player);
    this.viewport.view.onPose = () => this.onPose();
    this.viewport.onMove = () => this.onMove();
    this.viewport.onContext = (lost) =>
      this.onProblem(lost ? 'The graphics driver has dropped the picture; it comes back when it can.' : null);
    this.retheme();
    this.showAll(true);
    if (this.lastPose) this.pose = this.lastPose;
  }

  /** Gives the graphics context back; `load` draws again, from where the camera was. */
  unload(): void {
    this.lastPose = this.pose;
    this.viewport?.dispose();
    this.viewport = null;
    this.pointing = null;
  }

  get available(): boolean {
    return this.viewport !== null;
  }

  /** The whole mesh anew, e.g. after another one was opened. */
  showAll(fit: boolean): void {
    const { mesh } = this.player;
    mesh.takeDirtyCells();
    this.shapes = this.lengths = new Float64Array(0);
    this.jacobians.changes = -1;
    this.host.setAttribute('aria-label', `A mesh of ${mesh.liveCellCount()} ${cellWord(mesh.dim, 2)}`);
    this.viewport?.setMesh(mesh, fit);
    this.applyLook();
  }

  /** The change that the player has just made. */
  show({ from, to, animate }: Shown): void {
    const { mesh, events } = this.player;
    const changed = mesh.takeDirtyCells();
    const single = Math.abs(to - from) === 1;
    const delta = single && to > from ? events[to - 1].delta : null;
    let origins: ((vertex: number) => ArrayLike<number> | undefined) | undefined;
    if (delta && animate > 0) {
      const known = new Map<number, ArrayLike<number>>();
      // In 2D faces know where they were; in 3D other faces may be drawn than before.
      const first = mesh.dim === 2 ? delta.verticesBefore : 0;
      delta.vertices.forEach((v, i) => {
        if (v >= first) known.set(v, delta.oldPoints.subarray(i * mesh.dim, (i + 1) * mesh.dim));
      });
      origins = (vertex) => known.get(vertex);
    }
    this.viewport?.showMesh(mesh, changed, single ? animate : 0, origins);
    this.paint();
  }

  setLook(look: Look): void {
    if (look.marks.isolines !== this.look.marks.isolines) this.onWish();
    this.look = { colouring: look.colouring, marks: { ...look.marks }, inside: look.inside };
    this.applyLook();
  }

  /** What was measured a moment ago; colours of cells made since are left out. */
  setMeasures({ shapes, edges, lengths }: Measures): void {
    this.shapes = shapes as Float64Array<ArrayBuffer>;
    this.lengths = this.maths?.cellLengths(this.player.mesh, edges, lengths).map((l) => l / (1 + l)) ?? new Float64Array(0);
    const { colouring, inside } = this.look;
    if (colouring === 'shape' || colouring === 'length' || isFiltered(inside.quality)) this.paint();
  }

  /** A measure of each cell, as far as it is known. */
  measure(name: QualityMeasure): Float64Array {
    if (name === 'eta') return this.shapes;
    if (name === 'length') return this.lengths;
    const { mesh } = this.player;
    if (this.maths && this.jacobians.changes !== mesh.changes)
      this.jacobians = { changes: mesh.changes, values: this.maths.scaledJacobians(mesh) as Float64Array<ArrayBuffer> };
    return this.jacobians.values;
  }

  /** Samples and draws the metric ellipses over an initial mesh, if it is still `wanted` then. */
  async refreshEllipses(
    initial: MeshArrays,
    tensors: (points: Float64Array) => Promise<Float64Array>,
    wanted: () => boolean,
  ): Promise<void> {
    if (!this.viewport) return;
    const { sampleEllipses } = await import('../viewport/ellipse_samples.ts');
    const samples = await sampleEllipses(new ReplayMesh(initial), tensors);
    if (wanted()) this.viewport?.setEllipses(samples.centres, samples.tensors);
    if (initial.dim === 3) return this.paint();
    await this.refreshIsolines(initial, tensors, wanted);
  }

  private async refreshIsolines(
    initial: MeshArrays,
    tensors: (points: Float64Array) => Promise<Float64Array>,
    wanted: () => boolean,
  ): Promise<void> {
    if (!this.look.marks.isolines) return this.viewport?.setIsolines(new Float32Array(0));
    const { sampleIsolines } = await import('../viewport/isolines.ts');
    const segments = await sampleIsolines(new ReplayMesh(initial), tensors);
    if (wanted()) this.viewport?.setIsolines(segments);
  }

  clearEllipses(): void {
    this.pointing?.forget();
    this.viewport?.setIsolines(new Float32Array(0));
    this.viewport?.setEllipses(new Float64Array(0), new Float64Array(0));
  }

  /** Light or dark, and the host's colours, may have changed. */
  retheme(): void {
    this.dark = isDark(this.host);
    this.viewport?.setPalette(readPalette(this.host));
    this.applyLook();
  }

  /** Colours of the legend, or null when cells are plain. */
  get colours(): Uint8Array<ArrayBuffer> | null {
    const { colouring } = this.look;
    return colouring === 'plain' ? null : colourMaps[colouring][this.dark ? 'dark' : 'light'];
  }

  get pose(): CameraPose | null {
    return this.viewport?.view.pose() ?? null;
  }

  set pose(pose: CameraPose | null) {
    if (pose) this.viewport?.view.setPose(pose);
    else this.viewport?.view.fit();
  }

  /** From the mesh to the eye; null when nothing is drawn. */
  get direction(): number[] | null {
    return this.viewport?.view.direction ?? null;
  }

  /** Moves or turns, and zooms; see View.nudge. */
  nudge(right: number, up: number, zoom = 1): void {
    this.viewport?.view.nudge(right, up, zoom);
  }

  lookFrom(direction: number[]): void {
    this.viewport?.view.lookFrom(direction);
  }

  fit(): void {
    this.viewport?.view.fit();
  }

  capture(): Promise<Blob> {
    if (!this.viewport) return Promise.reject(new Error('There is no picture to save: this browser gives no WebGL 2.'));
    return this.viewport.capture(2);
  }

  /** See View. */
  placeAt(clientX: number, clientY: number): [number, number] {
    return this.viewport?.view.placeAt(clientX, clientY) ?? [0, 0];
  }

  screenOf(x: number, y: number): [number, number] {
    return this.viewport?.view.screenOf(x, y) ?? [0, 0];
  }

  /** What is drawn of a mesh of quadrilaterals, for export/svg.ts. */
  drawing(): Drawing {
    const { mesh, events, index } = this.player;
    const palette = readPalette(this.host);
    return { mesh, scene: sceneAfter(events, index), palette, colours: this.colours, value: this.valueOf(mesh) };
  }

  get canvas(): HTMLCanvasElement | null {
    return this.viewport?.canvas ?? null;
  }

  private applyLook(): void {
    this.viewport?.setMarks(this.look.marks);
    this.viewport?.setInside(this.look.inside);
    this.viewport?.setColours(this.colours);
    this.paint();
  }

  /** Colours and marks of what is drawn anew; what is drawn stays. */
  repaint(): void {
    this.pointing?.draw(this.look.marks.irregular && this.player.mesh.dim === 2);
    this.viewport?.repaint(...this.scene());
  }

  /** Everything anew but the mesh's shape. */
  private paint(): void {
    this.viewport?.setEllipseStrength(this.player.index > 0 ? 0.42 : 1);
    this.pointing?.draw(this.look.marks.irregular && this.player.mesh.dim === 2);
    this.onInside(this.viewport?.setScene(...this.scene()) ?? null);
  }

  private scene(): Parameters<Viewport['setScene']> {
    const { mesh, events, index } = this.player;
    const { quality } = this.look.inside;
    const values = isFiltered(quality) ? this.measure(quality.measure) : null;
    const faded = (cell: number): boolean => values !== null && !passes(quality, values[cell]);
    const chords = this.pointing?.chords().map(({ cells }) => cells) ?? [];
    return [mesh, sceneAfter(events, index), this.valueOf(mesh), faded, chords];
  }

  /** The cell with the least measure, and that; null before anything was measured. */
  worst(name: QualityMeasure): { cell: number; value: number } | null {
    const values = this.measure(name);
    let [cell, value] = [-1, Infinity];
    for (let c = 0; c < values.length; ++c) if (values[c] < value) [cell, value] = [c, values[c]];
    return cell < 0 ? null : { cell, value };
  }

  /** Flies to a cell, draws around it, and tells its numbers. */
  pin(cell: number): void {
    this.pointing?.pin(cell);
  }

  /** The cell that a click has framed, or a flight; -1: none. */
  get picked(): number {
    return this.pointing?.picked ?? -1;
  }

  /** What was picked is let go. */
  unpick(): void {
    this.pointing?.pick(-1);
  }

  /** 0 to 1 for each cell, as its colour map has it; -1: no colour. */
  private valueOf(mesh: ReplayMesh): (cell: number) => number {
    const known = (value: number): number => (value >= 0 ? Math.min(1, value) : value < 0 ? 0 : -1);
    switch (this.look.colouring) {
      case 'plain':
        return () => -1;
      case 'shape':
        return (cell) => known(this.shapes[cell]);
      case 'jacobian': {
        const values = this.measure('jacobian');
        return (cell) => known(values[cell]);
      }
      case 'length':
        return (cell) => {
          const t = this.lengths[cell];
          return known(Math.max(0, (Math.log2(t / (1 - t)) + 2) / 4));
        };
      case 'age': {
        const last = this.player.iterations;
        return (cell) => mesh.birth[cell] / last;
      }
    }
  }
}
