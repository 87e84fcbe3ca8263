// The sketch board: there when the visitor asks for it, on meshes of quadrilaterals.
import type { Board } from '../sketch/board.ts';
import type { Stage } from '../stage/stage.ts';

export class Sketching {
  private board: Board | null = null;

  constructor(
    private readonly stage: Stage,
    /** Where the panel goes. */
    private readonly place: HTMLElement,
    private readonly tell: (error: unknown) => void,
  ) {}

  async toggle(): Promise<void> {
    if (this.board) return this.close();
    if (this.stage.player.mesh.dim === 3) return this.tell(new Error('Only meshes of quadrilaterals can be sketched on.'));
    const [{ makeBoard }, { decodeSketch, encodeSketch }] = await Promise.all([
      import('../sketch/board.ts'),
      import('../sketch/sketch.ts'),
    ]);
    const { stage } = this;
    const board = (this.board = makeBoard({
      picture: stage.picture,
      extent: () => stage.extent,
      strokes: () => decodeSketch(stage.settings().sketch),
      change: (strokes) => void this.draw(encodeSketch(strokes)),
      close: () => this.close(),
    }));
    this.place.append(board.panel);
    stage.picture.host.after(board.surface);
    stage.picture.clearEllipses();
    board.update();
  }

  /** Strokes or camera may have changed. */
  update(): void {
    if (this.stage.player.mesh.dim === 3) this.close();
    this.board?.update();
  }

  private async draw(sketch: string): Promise<void> {
    const { stage } = this;
    try {
      await stage.run.forget();
      await stage.drawSketch(sketch);
      this.board?.update();
      if (sketch) await stage.seek(Number.MAX_SAFE_INTEGER); // adapted at once
    } catch (error) {
      this.tell(error);
    }
  }

  private close(): void {
    this.board?.panel.remove();
    this.board?.surface.remove();
    this.board = null;
  }
}
