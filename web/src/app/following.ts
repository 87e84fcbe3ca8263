// Live: the mesh follows the metric. The quickest answer is shown as soon as it is there; then better ones are searched
// behind it, take the picture over when they have become better, and are watched while they go on improving.
import '../../style/following.css';
import { operatorKinds, type MeshEvent } from '../../../wasm/events.ts';
import type { RunResult } from '../../../wasm/protocol.ts';
import type { Stage } from '../stage/stage.ts';
import { lastEvent } from '../state/settings.ts';
import { h } from '../ui/dom.ts';

export const efforts = ['fast', 'normal', 'best'] as const;
export type Effort = (typeof efforts)[number];

/** What the mesh is to follow. */
export interface Question {
  /** The metric: strokes as sketch/sketch.ts writes them, or a formula; neither: the one in force. */
  sketch?: string;
  formula?: string;
  /** The hand is still on it: only the quickest answer is wanted, and no more than the mesh is brought up to date. */
  painting?: boolean;
}

/** What is under way, and whether its mesh is the one in the picture. */
interface Answer {
  effort: Effort;
  since: number;
  shown: boolean;
}

export interface FollowingHost {
  refresh(): void;
  /** A question is settled: what a link says of it is known, and what can be undone. */
  asked(): void;
  setStatus(sentence: string): void;
  /** The metric was refused, or the core lost. */
  refused(error: unknown): void;
}

/** The quickest answer is shown while it comes when that takes so many milliseconds; its layers alone would be too crowded. */
const patience = 600;

export class Following {
  /** For the picture: which answers are there. */
  readonly element = h('p', { class: 'following', 'aria-hidden': 'true', hidden: true });
  private wanted: Question | null = null;
  private busy = false;
  private present: Answer | null = null;
  /**
   * Of the last answer in the picture: its effort, how often its cells were diced, the energy that a better one must be
   * below, as fine as this, and what is told of it. Every effort searches coarse meshes first and dices them as often.
   */
  private best: { effort: Effort; dices: number; energy: number; told: string } | null = null;

  constructor(
    private readonly stage: Stage,
    private readonly host: FollowingHost,
  ) {}

  /** What is asked has changed. An answer that is nearly there is waited for, so that the mesh keeps up with a hand. */
  request(question: Question): void {
    this.wanted = question;
    const { present, stage } = this;
    if (present && (present.effort !== 'fast' || performance.now() - present.since > patience)) void stage.workshop.abandon();
    void this.work();
  }

  /** What is shown stays; a link says how it came about. */
  stop(): void {
    this.wanted = null;
    if (this.busy) void this.stage.run.stop();
  }

  get working(): boolean {
    return this.busy;
  }

  private async work(): Promise<void> {
    if (this.busy) return;
    this.busy = true;
    const { player } = this.stage;
    try {
      while (this.wanted) await this.answer(this.take()).catch((error: unknown) => this.host.refused(error));
    } finally {
      this.busy = false;
      player.following = false;
      this.stage.run.listen();
      this.tell();
      this.host.refresh();
    }
  }

  private take(): Question {
    const question = this.wanted!;
    this.wanted = null;
    return question;
  }

  private async answer(question: Question): Promise<void> {
    const { stage } = this;
    await stage.workshop.abandon();
    await this.ask(question);
    stage.player.following = true;
    this.best = null;
    if (!question.painting) this.host.asked();
    const aim = question.painting ? 0 : efforts.indexOf(stage.settings().options.effort as Effort);
    for (const effort of efforts.slice(0, aim + 1)) {
      const result = await this.run(effort);
      if (!result || this.wanted) return;
      if (result.outcome.status === 'cancelled' || !stage.player.following) return this.settleFor(effort);
    }
  }

  private async ask({ sketch, formula, painting = false }: Question): Promise<void> {
    const { stage } = this;
    if (sketch) {
      const { decodeSketch, formulaOfSketch } = await import('../sketch/sketch.ts');
      await stage.setFormulaBehind(formulaOfSketch(decodeSketch(sketch), stage.extent / 6), painting ? null : sketch);
    } else if (formula !== undefined) {
      await stage.setFormulaBehind(formula, '');
    }
  }

  /** One answer, shown at its end or as soon as it is better than what is shown. */
  private async run(effort: Effort): Promise<RunResult | null> {
    const { stage, host } = this;
    const { player, workshop } = stage;
    const present: Answer = (this.present = { effort, since: performance.now(), shown: false });
    const waiting: MeshEvent[] = [];
    let energy = Infinity;
    let dices = 0;
    let reconnecting = false;
    let frame = 0;
    const show = (): void => {
      frame = 0;
      if (this.present !== present || !(present.shown || player.following)) return;
      if (present.shown) player.append(waiting.splice(0));
      else stage.takeOver(waiting.splice(0));
      present.shown = true;
    };
    stage.run.receive = (events) => {
      if (!present.shown && !player.following) return void stage.run.stop(); // another moment is being looked at
      for (const event of events) {
        waiting.push(event);
        reconnecting ||= operatorKinds.has(event.kind);
        if (event.kind === 'relocation') energy = event.value;
        if (event.kind === 'dice') ++dices;
      }
      const { best } = this;
      const better = best ? dices >= best.dices && energy < best.energy : performance.now() - present.since > patience;
      if (present.shown || (reconnecting && better)) frame ||= requestAnimationFrame(show);
    };
    this.tell();
    host.refresh();
    try {
      const result = await workshop.adapt({ ...stage.settings().options, effort });
      const cancelled = result?.outcome.status === 'cancelled';
      cancelAnimationFrame(frame);
      if (!result || (!present.shown && (cancelled || !player.following))) return result;
      show();
      const told = stage.run.finish(result);
      this.best = { effort, dices, energy, told };
      if (!cancelled && effort !== stage.settings().options.effort) host.setStatus(`${told} Improving.`);
      return result;
    } finally {
      this.present = null;
    }
  }

  /** Stopped: the state is what is shown. When that is an earlier answer, the core makes it its own again. */
  private async settleFor(effort: Effort): Promise<void> {
    const { stage, best } = this;
    const shown = (stage.settings().options.effort = best?.effort ?? effort);
    if (!best) return void (await stage.run.forget());
    this.host.setStatus(best.told);
    stage.run.receive = () => undefined; // the picture has these events
    if (best.effort !== effort) await stage.workshop.adapt({ ...stage.settings().options, effort: shown });
  }

  private tell(): void {
    const { element, present, best, stage } = this;
    element.hidden = !this.busy;
    const aim = efforts.indexOf(stage.settings().options.effort as Effort);
    element.replaceChildren(
      ...efforts.slice(0, aim + 1).map((effort) => {
        const state = effort === present?.effort ? 'now' : best && efforts.indexOf(effort) <= efforts.indexOf(best.effort) ? 'done' : 'later';
        return h('span', { 'data-state': state }, effort);
      }),
    );
  }
}

/** The settings that ask for a mesh which follows. */
export function goLive(stage: Stage): void {
  const settings = stage.settings();
  Object.assign(settings.options, { method: 'full', effort: 'best' });
  settings.event = lastEvent;
}
