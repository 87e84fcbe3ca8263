// Starting, stopping and replaying a run: what the play button, the arrow keys and a link's event come down to.
import type { MeshEvent } from '../../../wasm/events.ts';
import type { RunResult } from '../../../wasm/protocol.ts';
import type { Player } from '../replay/player.ts';
import type { Options } from '../state/settings.ts';
import { outcomeOf } from './words.ts';
import type { Workshop } from './workshop.ts';

export interface RunHost {
  options(): Options;
  /** A mesh with a metric is open. */
  ready(): boolean;
  /** Brings the initial mesh back before another run. */
  showInitial(): void;
  setStatus(sentence: string): void;
  refresh(): void;
  /** A run has come to its end. */
  done(result: RunResult): void;
  tell(error: unknown): void;
}

export class RunControl {
  /** Event to show as soon as it has been computed. */
  awaited: number | null = null;
  private waiting: (() => void)[] = [];
  /** Irregular vertices of the adapted mesh; null before. */
  irregular: number | null = null;

  constructor(
    private readonly player: Player,
    private readonly workshop: Workshop,
    private readonly host: RunHost,
  ) {
    workshop.onEvents = (events) => this.receive(events);
    this.listen();
  }

  /** Takes events as they come: `listen` has them appended; app/following.ts looks at them first. */
  receive!: (events: MeshEvent[]) => void;

  listen(): void {
    this.receive = (events) => {
      this.player.append(events);
      this.showAwaited(false);
    };
  }

  get hasRun(): boolean {
    return this.player.events.length > 0 || this.workshop.running;
  }

  /** Shows an event of the run that is under way as soon as it is there; settled then, or when it never will be. */
  await(event: number): Promise<void> {
    this.awaited = event;
    return new Promise((resolve) => this.waiting.push(resolve));
  }

  /** Nothing is awaited and nothing known of a run. */
  reset(): void {
    this.settle();
    this.irregular = null;
  }

  /** Computes the run; plays it while it comes, or shows one of its events. Null when it failed or another took its place. */
  async start(how: 'play' | { show: number }): Promise<RunResult | null> {
    const { player, workshop, host } = this;
    await workshop.abandon();
    this.listen();
    if (player.events.length > 0) host.showInitial();
    this.awaited = how === 'play' ? null : how.show;
    const run = workshop.adapt({ ...host.options() });
    host.setStatus('Computing');
    if (how === 'play') player.play();
    host.refresh();
    try {
      const result = await run;
      if (result) this.finish(result);
      return result;
    } catch (error) {
      player.pause();
      player.finish();
      this.settle();
      host.setStatus('');
      host.tell(error);
      return null;
    } finally {
      host.refresh();
    }
  }

  stop(): Promise<void> {
    return this.workshop.stop();
  }

  /** Ends the run and forgets what it has shown, because it answers an older question. */
  async forget(): Promise<void> {
    const { events } = this.player;
    await this.workshop.abandon();
    if (events.length > 0) this.host.showInitial();
    this.host.refresh();
  }

  togglePlay(): void {
    if (!this.host.ready()) return;
    if (this.player.playing) this.player.pause();
    else if (this.hasRun) this.player.play();
    else void this.start('play');
  }

  step(direction: 1 | -1): void {
    if (!this.host.ready()) return;
    if (this.hasRun || direction === -1) this.player.step(direction);
    else void this.start({ show: 1 });
  }

  /** The events that were received are all of them. Gives the sentence that tells how it ended. */
  finish(result: RunResult): string {
    this.player.finish();
    const report = JSON.parse(result.report) as { irregular_vertices?: number; mesh?: { cells: number } };
    this.irregular = report.irregular_vertices ?? null;
    const told = outcomeOf(result, report.mesh?.cells, this.player.mesh.dim);
    this.host.setStatus(told);
    this.showAwaited(true);
    this.host.done(result);
    return told;
  }

  private settle(): void {
    this.awaited = null;
    for (const resolve of this.waiting.splice(0)) resolve();
  }

  private showAwaited(complete: boolean): void {
    if (this.awaited === null) return;
    const { player } = this;
    if (player.events.length < this.awaited && !complete) return;
    const index = Math.min(this.awaited, player.events.length);
    player.seek(index);
    this.settle();
  }
}
