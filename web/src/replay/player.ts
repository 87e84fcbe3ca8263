// The timeline: applies and reverts events, and plays them at a pace.
import type { EventKind, MeshEvent } from '../../../wasm/events.ts';
import type { MeshArrays } from '../../../wasm/session.ts';
import type { Pace } from '../state/settings.ts';
import { ReplayMesh } from './replay_mesh.ts';

/** How long an event stands at pace 1, in milliseconds, where it is not 500. */
const dwell: Partial<Record<EventKind, number>> = {
  tags: 1500,
  layer: 1100,
  shrink: 900,
  connect: 800,
  dice: 1200,
  relocation: 160,
  iteration: 900,
  chord_collapse: 1100,
  chord_split: 1100,
  partial_chord_collapse: 700,
  partial_chord_split: 700,
};
const longestAnimation = 520;
/** Events that `auto` shows at pace 1 before it speeds up, by what factor each, and to what pace. */
const automatic = { slow: 8, growth: 1.045, fastest: 40 };

export interface Shown {
  /** Events applied before and after. */
  from: number;
  to: number;
  /** Milliseconds that the change is to be animated over; 0: at once. */
  animate: number;
}

export class Player {
  mesh: ReplayMesh;
  events: MeshEvent[] = [];
  /** Number of events applied: 0 shows the initial mesh. */
  index = 0;
  playing = false;
  /** No more events will come. */
  complete = false;
  pace: Pace = 'auto';
  /** Changes are shown at once, for visitors who prefer reduced motion. */
  still = false;
  /** What comes is shown as it comes, until somebody looks at another moment. */
  following = false;

  /** Called when the shown mesh has changed. */
  onShow: (shown: Shown) => void = () => undefined;
  /** Called when playing starts or stops. */
  onState: () => void = () => undefined;
  /** Called when events have arrived, many times a second. */
  onGrow: () => void = () => undefined;

  private waited = 0;
  private playedSince = 0;

  constructor(mesh: MeshArrays) {
    this.mesh = new ReplayMesh(mesh);
  }

  /** Back to an initial mesh without events. */
  reset(mesh: MeshArrays): void {
    this.mesh = new ReplayMesh(mesh);
    this.events = [];
    this.index = 0;
    this.playing = false;
    this.complete = false;
    this.waited = 0;
    this.onState();
  }

  append(events: MeshEvent[]): void {
    for (const event of events) this.events.push(event);
    if (this.following) this.move(this.events.length, 0);
    else this.onGrow();
  }

  /** Another run in place of this one, at its end so far; the caller shows it. */
  replace(mesh: MeshArrays, events: MeshEvent[]): void {
    this.mesh = new ReplayMesh(mesh);
    this.events = events;
    this.complete = this.playing = false;
    for (const { delta, iteration } of events) this.mesh.apply(delta, iteration);
    this.index = events.length;
  }

  finish(): void {
    this.complete = true;
    if (this.atEnd) this.playing = false;
    this.onState();
  }

  /** The event whose result is shown; undefined for the initial mesh. */
  get current(): MeshEvent | undefined {
    return this.events[this.index - 1];
  }

  /** Iterations begun, at least 1. */
  get iterations(): number {
    const { current } = this;
    return Math.max(
      1,
      (current?.iteration ?? 0) + (current?.kind === 'iteration' || current?.kind === 'relocation' ? 0 : 1),
    );
  }

  get atEnd(): boolean {
    return this.index === this.events.length;
  }

  play(): void {
    this.following = false;
    if (this.atEnd && this.complete && this.index > 0) this.move(0, 0);
    this.playing = true;
    this.waited = Infinity; // the first event comes at once
    this.playedSince = this.index;
    this.onState();
  }

  pause(): void {
    this.playing = false;
    this.onState();
  }

  /** One event forwards (+1) or backwards (-1). */
  step(direction: 1 | -1): void {
    this.following = false;
    this.pause();
    const target = this.index + direction;
    if (target >= 0 && target <= this.events.length) this.move(target, this.still ? 0 : longestAnimation);
  }

  /** To the next (+1) or previous (-1) start or end of an iteration. */
  stepIteration(direction: 1 | -1): void {
    let target = this.index + direction;
    while (target > 0 && target < this.events.length && this.events[target - 1].kind !== 'iteration')
      target += direction;
    this.seek(target);
  }

  seek(index: number): void {
    this.following = false;
    this.waited = 0;
    this.playedSince = index;
    this.move(Math.max(0, Math.min(this.events.length, index)), 0);
  }

  /** To be called every frame while playing, with the milliseconds since the last. */
  tick(elapsed: number): void {
    if (!this.playing) return;
    this.waited += elapsed;
    let target = this.index;
    let hold = this.holdAt(target);
    while (this.waited >= hold && target < this.events.length) {
      this.waited = Number.isFinite(this.waited) ? this.waited - hold : 0;
      hold = this.holdAt(++target);
    }
    if (target > this.index) this.move(target, this.still || hold < 60 ? 0 : Math.min(0.75 * hold, longestAnimation));
    if (this.atEnd) {
      this.waited = Math.min(this.waited, hold);
      if (this.complete) this.pause();
    }
  }

  /** How long the mesh after `index` events stands, in milliseconds. */
  private holdAt(index: number): number {
    const event = this.events[index - 1];
    return ((event && dwell[event.kind]) ?? 500) / this.speed(index);
  }

  private speed(index: number): number {
    if (this.pace !== 'auto') return Number(this.pace);
    const played = Math.max(0, index - this.playedSince - automatic.slow);
    return Math.min(automatic.fastest, automatic.growth ** played);
  }

  private move(target: number, animate: number): void {
    const from = this.index;
    if (target === from) return;
    while (this.index < target) {
      const event = this.events[this.index++];
      this.mesh.apply(event.delta, event.iteration);
    }
    while (this.index > target) this.mesh.revert(this.events[--this.index].delta);
    this.onShow({ from, to: target, animate });
  }
}
