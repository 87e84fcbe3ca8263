// The picture and what belongs to it: loaded when needed, survives a browser without WebGL.
import type { MeshArrays } from '../../../wasm/session.ts';
import { defaultInside, type Inside } from '../inside/look_inside.ts';
import { cellWord } from '../replay/caption.ts';
import type { Player, Shown } from '../replay/player.ts';
import { ReplayMesh } from '../replay/replay_mesh.ts';
import { sceneAfter } from '../replay/scene.ts';
import type { CameraPose, Colouring, Mark } from '../state/settings.ts';
import { h } from '../ui/dom.ts';
import { sampleEllipses } from '../viewport/ellipse_samples.ts';
import { colourMaps, isDark, readPalette } from '../viewport/palette.ts';
import type { InsideReport } from '../viewport/hex_body.ts';
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
  /** Called with a sentence when drawing is impossible or comes back (null). */
  onProblem: (sentence: string | null) => void = () => undefined;
  /** Called with what there is to see of a hexahedral mesh; null in 2D. */
  onInside: (report: InsideReport | null) => void = () => undefined;

  private viewport: Viewport | null = null;
  private look: Look = {
    colouring: 'plain',
    marks: { tags: true, layer: true, hull: true, buffer: true, ellipses: true },
    inside: defaultInside(),
  };
  private shapes = new Float64Array(0);
  private dark = false;
  private lastPose: CameraPose | null = null;
  private readonly player: Player;

  constructor(player: Player) {
    this.player = player;
  }

  /** Loads the drawing code; afterwards the mesh is shown, if the browser can. */
  async load(): Promise<void> {
    if (this.viewport) return;
    try {
      const { Viewport } = await import('../viewport/viewport.ts');
      if (this.viewport) return;
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
    this.viewport.onPose = () => this.onPose();
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
  }

  get available(): boolean {
    return this.viewport !== null;
  }

  /** The whole mesh anew, e.g. after another one was opened. */
  showAll(fit: boolean): void {
    const { mesh } = this.player;
    mesh.takeDirtyCells();
    this.shapes = new Float64Array(0);
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
    this.look = { colouring: look.colouring, marks: { ...look.marks }, inside: look.inside };
    this.applyLook();
  }

  /** Shapes of the cells, measured a moment ago; colours of cells made since are left out. */
  setShapes(shapes: Float64Array<ArrayBuffer>): void {
    this.shapes = shapes;
    const { quality } = this.look.inside;
    const filtered = quality.measure === 'eta' && (quality.low > 0 || quality.high < 1);
    if (this.look.colouring === 'shape' || (filtered && this.player.mesh.dim === 3)) this.paint();
  }

  /** Samples and draws the metric ellipses over an initial mesh. */
  async refreshEllipses(initial: MeshArrays, tensors: (points: Float64Array) => Promise<Float64Array>): Promise<void> {
    const { mesh } = this.player;
    if (!this.viewport || initial.dim !== 2) return;
    const samples = await sampleEllipses(new ReplayMesh(initial), tensors);
    if (mesh === this.player.mesh) this.viewport.setEllipses(samples.centres, samples.tensors);
  }

  clearEllipses(): void {
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
    return this.viewport?.currentPose() ?? null;
  }

  set pose(pose: CameraPose | null) {
    if (pose) this.viewport?.setPose(pose);
    else this.viewport?.fit();
  }

  /** From the mesh to the eye; null when nothing is drawn. */
  get direction(): number[] | null {
    return this.viewport?.direction ?? null;
  }

  fit(): void {
    this.viewport?.fit();
  }

  capture(): Promise<Blob> {
    if (!this.viewport) return Promise.reject(new Error('There is no picture to save: this browser gives no WebGL 2.'));
    return this.viewport.capture(2);
  }

  private applyLook(): void {
    this.viewport?.setMarks(this.look.marks);
    this.viewport?.setInside(this.look.inside);
    this.viewport?.setColours(this.colours);
    this.paint();
  }

  private paint(): void {
    const { mesh, events, index } = this.player;
    this.viewport?.setEllipseStrength(index > 0 ? 0.42 : 1);
    const report = this.viewport?.setScene(mesh, sceneAfter(events, index), this.valueOf(mesh), this.shapes);
    this.onInside(report ?? null);
  }

  private valueOf(mesh: ReplayMesh): (cell: number) => number {
    if (this.look.colouring === 'shape') return (cell) => this.shapes[cell] ?? -1;
    if (this.look.colouring === 'plain') return () => -1;
    const last = this.player.iterations;
    return (cell) => mesh.birth[cell] / last;
  }
}
