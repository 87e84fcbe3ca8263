// What stands out by a visitor's pointing: the chords or sheets through a cell, its numbers, a frame around it; and the
// irregular vertices. Loaded with the drawing code.
import { chordThrough, irregularVertices, neighboursOf, type Chord } from '../inside/chords.ts';
import { cellWord } from '../replay/caption.ts';
import type { QualityMeasure } from '../inside/look_inside.ts';
import type { Player } from '../replay/player.ts';
import type { ReplayMesh } from '../replay/replay_mesh.ts';
import type { CameraPose } from '../state/settings.ts';
import { cellEdges, segmentsOf } from '../viewport/segments.ts';
import type { Viewport } from '../viewport/viewport.ts';

/** The picture that this belongs to. */
export interface PictureBeside {
  measure(name: QualityMeasure): Float64Array;
  repaint(): void;
  onPoint(sentence: string | null): void;
  onPose(): void;
}

export class Pointing {
  private pointed = -1;
  private pinned = -1;
  private neighbours: { mesh: ReplayMesh; changes: number; of: Int32Array } | null = null;
  private drawn = false;

  constructor(
    private readonly picture: PictureBeside,
    private readonly viewport: Viewport,
    private readonly player: Player,
  ) {
    const { canvas } = viewport;
    let frame = 0;
    const point = (event: PointerEvent): void => {
      cancelAnimationFrame(frame);
      if (event.pointerType === 'mouse' && event.buttons !== 0) return;
      frame = requestAnimationFrame(() => {
        if (!this.player.playing) this.pointAt(viewport.cellAt(event.clientX, event.clientY));
      });
    };
    canvas.addEventListener('pointermove', (event) => event.pointerType === 'mouse' && point(event));
    let pressed = { x: 0, y: 0 };
    canvas.addEventListener('pointerdown', ({ clientX: x, clientY: y }) => (pressed = { x, y }));
    canvas.addEventListener('click', (event) => {
      const { clientX, clientY } = event;
      if (Math.hypot(clientX - pressed.x, clientY - pressed.y) >= 5) return; // a drag
      if (this.player.mesh.dim === 3) this.pick(viewport.cellAt(clientX, clientY));
      point(event as PointerEvent);
    });
    canvas.addEventListener('pointerleave', (event) => {
      cancelAnimationFrame(frame);
      if (event.pointerType === 'mouse') this.pointAt(-1);
    });
  }

  /** Another mesh has come. */
  forget(): void {
    this.pointed = this.pinned = -1;
    this.picture.onPoint(null);
  }

  /** The cell that stands out by a click or a flight; -1: none. */
  get picked(): number {
    const { mesh } = this.player;
    return this.pinned >= 0 && this.pinned < mesh.cellCount && mesh.alive(this.pinned) ? this.pinned : -1;
  }

  /** Draws around a cell; -1: around none. */
  pick(cell: number): void {
    this.pinned = cell;
    this.picture.repaint();
  }

  /** Flies to a cell, draws around it, and tells its numbers. */
  pin(cell: number): void {
    const { mesh } = this.player;
    const { dim, cornerCount, points } = mesh;
    const corners = Array.from(mesh.cells.subarray(cornerCount * cell, cornerCount * (cell + 1)));
    const middle = Array.from({ length: dim }, (_, d) =>
      corners.reduce((sum, v) => sum + points[dim * v + d] / cornerCount, 0),
    );
    const reach = Math.max(...corners.map((v) => Math.hypot(...middle.map((x, d) => points[dim * v + d] - x))));
    const { low, high } = mesh.bounds();
    const size = Math.max(...low.map((x, d) => high[d] - x));
    this.pinned = cell;
    const pose: CameraPose = { target: middle, zoom: Math.max(1, size / (14 * reach)) };
    if (dim === 3) pose.direction = this.viewport.view.direction;
    this.viewport.view.setPose(pose);
    this.pointAt(cell);
    this.picture.onPose();
  }

  /** Chords, in 3D sheets, that cross in the cell pointed at. */
  chords(): Chord[] {
    const { mesh } = this.player;
    const cell = this.pointed;
    if (cell < 0 || cell >= mesh.cellCount || !mesh.alive(cell)) return [];
    return Array.from({ length: mesh.dim }, (_, axis) => chordThrough(mesh, this.neighboursNow(), cell, axis));
  }

  /** Draws the frame around the pinned cell and, if wished, the irregular vertices. */
  draw(irregular: boolean): void {
    const { mesh } = this.player;
    const pinned = this.picked >= 0;
    if (!irregular && !pinned && !this.drawn) return;
    this.drawn = irregular || pinned;
    const none = new Int32Array(0);
    const [fewer, more] = irregular ? irregularVertices(mesh, this.neighboursNow()) : [none, none];
    const places = (vertices: Int32Array): Float32Array =>
      Float32Array.from([...vertices].flatMap((v) => [mesh.points[2 * v], mesh.points[2 * v + 1], 0]));
    this.viewport.setIrregular(places(fewer), places(more));
    this.viewport.setPin(pinned ? segmentsOf(mesh, cellEdges(mesh, this.pinned)) : new Float32Array(0));
  }

  private pointAt(cell: number): void {
    if (cell === this.pointed) return;
    this.pointed = cell;
    this.picture.repaint();
    this.picture.onPoint(cell < 0 ? null : this.describe(cell));
  }

  /** "eta 0.43, l 0.85, scaled Jacobian 0.36. Chords of 12 (closed) and 30 quads." */
  private describe(cell: number): string {
    const { dim } = this.player.mesh;
    const count = ({ cells, closed }: Chord): string => `${cells.length}${closed ? ' (closed)' : ''}`;
    const t = this.picture.measure('length')[cell];
    const numbers = (
      [
        ['η', this.picture.measure('eta')[cell]],
        ['l', t / (1 - t)],
        ['scaled Jacobian', this.picture.measure('jacobian')[cell]],
      ] as const
    )
      .filter(([, value]) => Number.isFinite(value))
      .map(([name, value]) => `${name} ${value.toFixed(2)}`);
    const all = this.chords().map(count).join(' and ');
    return `${numbers.join(', ')}. ${dim === 2 ? 'Chords' : 'Sheets'} of ${all} ${cellWord(dim, 2)}.`;
  }

  private neighboursNow(): Int32Array {
    const { mesh } = this.player;
    if (this.neighbours?.mesh !== mesh || this.neighbours.changes !== mesh.reconnections)
      this.neighbours = { mesh, changes: mesh.reconnections, of: neighboursOf(mesh) };
    return this.neighbours.of;
  }
}
