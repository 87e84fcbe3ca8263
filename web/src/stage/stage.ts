// A picture that computes: mesh, metric, run, playback and drawing together, without any panel around it. The page and
// the element <pillow-mesh> are both made of it.
import type { MeshEvent } from '../../../wasm/events.ts';
import type { MetricRequest } from '../../../wasm/metrics.ts';
import type { Measures, RunResult } from '../../../wasm/protocol.ts';
import { captionOf } from '../replay/caption.ts';
import { Player, type Shown } from '../replay/player.ts';
import { lastEvent, type MeshChoice, type Settings } from '../state/settings.ts';
import { Picture } from './picture.ts';
import { Refresher } from './refresher.ts';
import { RunControl } from './run_control.ts';
import { Subject, nothing } from './subject.ts';
import { makeTicker } from './ticker.ts';
import { Workshop } from './workshop.ts';

/** What a stage tells the page around it. */
export interface StageHost {
  /** Anything that is shown may have changed. */
  refresh(): void;
  /** Another mesh or metric is open; `formula` is in force. */
  opened(formula: string): void;
  measured(measures: Measures): void;
  /** "Computing", how a run ended, or nothing. */
  setStatus(sentence: string): void;
  done(result: RunResult): void;
  stepped(shown: Shown): void;
  tell(error: unknown): void;
  /** Takes the showing of the end of a run over: true where a mesh follows its metric. */
  follow?(): boolean;
}

export class Stage {
  readonly workshop = new Workshop();
  readonly subject = new Subject(this.workshop);
  readonly player = new Player(nothing);
  readonly picture = new Picture(this.player);
  readonly run: RunControl;
  /** Of the mesh as it was measured last. */
  measures: Measures | null = null;
  private readonly measuring = new Refresher(() => this.measure());
  private readonly sampling = new Refresher(async () => {
    if (this.run.awaited !== null) return this.sampling.request(200); // first what is waited for
    const { initial } = this.subject;
    const tensors = (points: Float64Array): Promise<Float64Array> => this.workshop.call('tensors', { points });
    return this.picture.refreshEllipses(initial, tensors, () => initial === this.subject.initial);
  });
  /** In force; empty for a metric that is made. */
  private formula = '';
  private pictureLoaded: Promise<void> = Promise.resolve();
  private readonly reducedMotion = matchMedia('(prefers-reduced-motion: reduce)');
  private readonly followMotion = (): void => void (this.player.still = this.reducedMotion.matches);

  constructor(
    readonly settings: () => Settings,
    private readonly host: StageHost,
  ) {
    const { player } = this;
    this.run = new RunControl(player, this.workshop, {
      options: () => this.settings().options,
      ready: () => !this.subject.empty,
      showInitial: () => this.showInitial(false),
      setStatus: (sentence) => host.setStatus(sentence),
      refresh: () => host.refresh(),
      done: (result) => host.done(result),
      tell: (error) => host.tell(error),
    });
    this.picture.onWish = () => this.sampling.request(0);
    const tick = makeTicker(player);
    player.onShow = (shown) => {
      this.picture.show(shown);
      this.measuring.request(player.playing || player.following ? 200 : 20);
      host.stepped(shown);
      host.refresh();
    };
    player.onState = () => {
      tick();
      host.refresh();
    };
    let growing = 0;
    player.onGrow = () => {
      growing ||= requestAnimationFrame(() => {
        growing = 0;
        host.refresh();
      });
    };
    this.workshop.targetCells = () => this.settings().targetCells;
    this.workshop.onCrash = (error) => host.tell(error);
    this.followMotion();
    this.reducedMotion.addEventListener('change', this.followMotion);
  }

  /** Loads the drawing code and draws; again after `rest`. */
  show(): Promise<void> {
    this.pictureLoaded = this.picture.load().then(() => {
      this.sampling.request(0);
      if (this.measures) this.measuring.request(0); // they came before there was a picture to colour
    });
    return this.pictureLoaded;
  }

  /** Gives the graphics context back while nobody looks. */
  rest(): void {
    this.player.pause();
    this.picture.unload();
  }

  /** Frees everything. With the next `apply` it can be used again. */
  close(): void {
    this.reducedMotion.removeEventListener('change', this.followMotion);
    this.rest();
    this.workshop.restart();
  }

  /** Shows what the settings say. False when the mesh or the metric was refused; the reason was told. */
  async apply(): Promise<boolean> {
    const { mesh, formula, sketch, event, pace, camera } = this.settings();
    this.player.pace = pace;
    this.picture.setLook(this.settings());
    if (!(await this.open(mesh, formula))) return false;
    if (sketch && this.player.mesh.dim === 2) await this.drawSketch(sketch);
    if (camera) void this.pictureLoaded.then(() => (this.picture.pose = camera));
    if (event === lastEvent && this.host.follow?.()) return true;
    if (event !== null && event > 0) await this.run.start({ show: event });
    return true;
  }

  /** Opens a mesh with a metric, see Subject.open. False when it was refused. */
  async open(choice: MeshChoice, formula: string): Promise<boolean> {
    let text: string;
    try {
      text = await this.subject.open(choice, formula);
    } catch (error) {
      this.host.tell(error);
      this.host.refresh();
      return false;
    }
    this.settings().mesh = choice;
    this.settings().sketch = '';
    this.takeFormula(text, true);
    return true;
  }

  /** Another metric on the same mesh, shown if it is still wanted then. Rejects when it is refused. */
  async setFormula(text: string, wanted: () => boolean = () => true): Promise<void> {
    await this.workshop.setMetric({ formula: text });
    if (!wanted()) return;
    this.settings().sketch = '';
    this.takeFormula(text, false);
  }

  /** The metric by strokes; without any, the mesh's own comes back. */
  async drawSketch(sketch: string): Promise<void> {
    const { decodeSketch, formulaOfSketch } = await import('../sketch/sketch.ts');
    const strokes = decodeSketch(sketch);
    const settings = this.settings();
    settings.sketch = strokes.length > 0 ? sketch : '';
    settings.formula = '';
    if (strokes.length === 0) return void (await this.open(settings.mesh, ''));
    const formula = formulaOfSketch(strokes, this.extent / 6);
    await this.workshop.setMetric({ formula });
    this.takeFormula(formula, false);
  }

  /** Another metric behind the mesh that is shown, which stays. `sketch` as in the settings; null: it is not settled yet. */
  async setFormulaBehind(formula: string, sketch: string | null): Promise<void> {
    await this.workshop.setMetric({ formula });
    if (sketch === null) return;
    this.settings().sketch = sketch;
    this.keepFormula(formula);
    this.sampling.request(400);
  }

  /** Another run's mesh in place of the one that is shown. */
  takeOver(events: MeshEvent[]): void {
    this.player.replace(this.subject.initial, events);
    this.picture.showAll(false);
    this.measuring.request(0);
    this.host.refresh();
  }

  /** The metric in force, after another number of cells was wished for. */
  async rescale(): Promise<void> {
    await this.workshop.setMetricAgain();
    this.host.opened(this.formula);
    if (this.host.follow?.()) this.sampling.request(400);
    else this.showInitial(false);
  }

  /** A metric made from a picture, a solution, ...: it belongs to the session and to no link. */
  async setMadeMetric(request: MetricRequest): Promise<void> {
    const nodal = await this.workshop.call('makeMetric', request);
    await this.workshop.setMetric({ nodal });
    this.settings().sketch = '';
    this.takeFormula('', false);
  }

  /** The mesh's larger side. */
  get extent(): number {
    const { low, high } = this.player.mesh.bounds();
    return Math.max(...low.map((x, d) => high[d] - x));
  }

  /** Shows the mesh after so many events; starts a run when there is none. */
  async seek(event: number): Promise<void> {
    this.player.pause();
    if (event <= 0 || this.player.complete || event <= this.player.events.length) this.player.seek(event);
    else if (this.run.hasRun) await this.run.await(event);
    else await this.run.start({ show: event });
  }

  get caption(): string {
    const { player, subject } = this;
    if (subject.empty) return 'Loading';
    const { options, marks } = this.settings();
    return captionOf(player.current, player.mesh, options.threshold, player.events.length, marks.ellipses);
  }

  /** The settings with what is shown now: what a link holds. */
  get state(): Settings {
    const { index, following, complete, atEnd } = this.player;
    const { method } = this.settings().options;
    const end = following || (complete && atEnd && method === 'full'); // told by what was asked, not by a number
    const event = this.run.awaited ?? (index === 0 && !following ? null : end ? lastEvent : index);
    return { ...this.settings(), event, camera: this.picture.pose };
  }

  /** Back to the initial mesh, without a run. */
  showInitial(fit: boolean): void {
    this.run.reset();
    this.host.setStatus('');
    this.player.reset(this.subject.initial);
    this.picture.clearEllipses();
    this.picture.showAll(fit);
    this.measuring.request(0);
    this.sampling.request(0);
    this.host.refresh();
  }

  private takeFormula(text: string, fit: boolean): void {
    this.keepFormula(text);
    this.showInitial(fit);
  }

  private keepFormula(text: string): void {
    this.formula = text;
    const settings = this.settings();
    settings.formula = settings.sketch || text === this.subject.ownFormula(settings.mesh) ? '' : text;
    this.host.opened(text);
  }

  private async measure(): Promise<void> {
    const { player } = this;
    const { mesh } = player;
    const { changes } = mesh;
    const { points, cells } = mesh.snapshot();
    const measures = await this.workshop.call('measure', { points, cells, lengths: true }, [
      points.buffer,
      cells.buffer,
    ] as ArrayBuffer[]);
    if (mesh !== player.mesh) return;
    // While it plays, numbers a moment old are better than none; of a mesh that stands they are its own.
    if (mesh.changes !== changes && !player.playing && !player.following) return;
    this.measures = measures;
    this.picture.setMeasures(measures);
    this.host.measured(measures);
  }
}
