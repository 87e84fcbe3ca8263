// The sketch board: there when the visitor asks for it, on meshes of quadrilaterals.
import type { Board } from '../sketch/board.ts';
import type { Stroke } from '../sketch/sketch.ts';
import type { Stage } from '../stage/stage.ts';
import { goLive, type Question } from './following.ts';

export class Sketching {
  private board: Board | null = null;

  constructor(
    private readonly stage: Stage,
    /** Where the panel goes. */
    private readonly place: HTMLElement,
    private readonly follow: (question: Question) => void,
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
    const draw = (strokes: readonly Stroke[], painting: boolean): void => {
      if (stage.settings().options.method !== 'full') goLive(stage);
      this.follow({ sketch: encodeSketch(strokes), painting });
    };
    const board = (this.board = makeBoard({
      picture: stage.picture,
      extent: () => stage.extent,
      strokes: () => decodeSketch(stage.settings().sketch),
      change: (strokes) => (strokes.length > 0 ? draw(strokes, false) : void this.clear()),
      paint: (strokes) => draw(strokes, true),
      close: () => this.close(),
    }));
    const narrow = matchMedia('(max-width: 759px)').matches; // one column: the panel belongs beside the picture
    if (narrow) stage.picture.host.closest('.frame')?.after(board.panel);
    else this.place.append(board.panel);
    stage.picture.host.after(board.surface);
    stage.picture.clearEllipses();
    (narrow ? stage.picture.host : board.panel).scrollIntoView({ block: 'center' });
    board.update();
  }

  /** Strokes or camera may have changed. */
  update(): void {
    if (this.stage.player.mesh.dim === 3) this.close();
    this.board?.update();
  }

  private async clear(): Promise<void> {
    const { stage } = this;
    try {
      await stage.run.forget();
      await stage.drawSketch('');
      this.board?.update();
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
