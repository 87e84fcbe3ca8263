// What makes a mesh follow: strokes, pictures, and any change while full adaptation is chosen. Loads the rest when wanted.
import type { Messages } from '../panels/messages.ts';
import type { Stage } from '../stage/stage.ts';
import type { Following, FollowingHost, Question } from './following.ts';
import { takeAsMetric } from './given_metric.ts';
import type { Sketching } from './sketching.ts';

export interface LiveHost extends FollowingHost {
  messages: Messages;
  /** Where the panel for sketching goes. */
  sketchPlace(): HTMLElement;
  tell(error: unknown): void;
}

export class Live {
  private following: Following | null = null;
  private sketching: Sketching | null = null;

  constructor(
    private readonly stage: Stage,
    private readonly host: LiveHost,
  ) {}

  /** Whether the mesh follows its metric: full adaptation, of quadrilaterals. */
  get on(): boolean {
    return this.stage.settings().options.method === 'full' && this.stage.player.mesh.dim === 2;
  }

  get working(): boolean {
    return this.following?.working === true;
  }

  stop(): void {
    this.following?.stop();
  }

  /** Strokes or camera may have changed. */
  update(): void {
    this.sketching?.update();
  }

  async follow(question: Question = {}): Promise<void> {
    const { Following } = await import('./following.ts');
    if (!this.following) {
      this.following = new Following(this.stage, this.host);
      this.stage.picture.host.after(this.following.element);
    }
    this.following.request(question);
  }

  async sketch(): Promise<void> {
    const { Sketching } = await import('./sketching.ts');
    const { tell, sketchPlace } = this.host;
    this.sketching ??= new Sketching(this.stage, sketchPlace(), (question) => void this.follow(question), tell);
    await this.sketching.toggle();
  }

  /** A picture, or a Medit .sol, becomes the metric. */
  async takeMetric(file: File): Promise<void> {
    try {
      await takeAsMetric(this.stage, file, this.host.messages);
      if (this.stage.player.mesh.dim === 3) return;
      (await import('./following.ts')).goLive(this.stage);
      await this.follow();
    } catch (error) {
      this.host.tell(error);
    }
  }

  async takePicture(): Promise<void> {
    this.host.messages.clear();
    const { takePicture } = await import('./camera_picture.ts');
    const picture = await takePicture().catch((error: unknown) => this.host.tell(error));
    if (picture) await this.takeMetric(picture);
  }
}
