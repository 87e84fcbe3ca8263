// The page: settings, player, picture and panels, and what happens between them.
import { LoadError } from '../../../wasm/loader.ts';
import { CoreError, type Case, type MeshArrays, type MeshSource } from '../../../wasm/session.ts';
import { makeHeader, saveFormats, type SaveFormat } from '../panels/header.ts';
import { makeHelp } from '../panels/help.ts';
import { makeIndicators } from '../panels/indicators.ts';
import { makeMessages } from '../panels/messages.ts';
import { makePictureTools } from '../panels/picture_tools.ts';
import { makeSetup } from '../panels/setup.ts';
import { makeTransport } from '../panels/transport.ts';
import { captionOf, cellWord } from '../replay/caption.ts';
import { Player } from '../replay/player.ts';
import { decodeSettings, encodeSettings } from '../state/permalink.ts';
import { colourings, paces, type Mark, type MeshChoice, type Pace, type Settings } from '../state/settings.ts';
import { debounce, h } from '../ui/dom.ts';
import { icon } from '../ui/icons.ts';
import { acceptDrops } from './drop.ts';
import { listenToKeys } from './keyboard.ts';
import { Picture } from './picture.ts';
import { Refresher } from './refresher.ts';
import { formulaFor } from './starting_formula.ts';
import { followTheme, toggleTheme } from './theme.ts';
import { Workshop } from './workshop.ts';

const nothing: MeshArrays = { dim: 2, points: new Float64Array(0), cells: new Int32Array(0) };

export class App {
  private settings: Settings = decodeSettings(location.hash);
  private cases: readonly Case[] = [];
  private version = '';
  private initial: MeshArrays = nothing;
  /** Content of a mesh that came as a file. */
  private file: Uint8Array | null = null;
  private irregular: number | null = null;
  /** Event to show as soon as it has been computed. */
  private awaited: number | null = null;

  private readonly workshop = new Workshop();
  private readonly player = new Player(nothing);
  private readonly picture = new Picture(this.player);
  private readonly messages = makeMessages();
  private readonly indicators = makeIndicators();
  private readonly help = makeHelp(() => this.version);
  private readonly tools = makePictureTools({
    toggleMark: (mark) => this.toggleMark(mark),
    setColouring: (colouring) => this.change({ colouring }),
    fit: () => this.picture.fit(),
  });
  private readonly transport = makeTransport({
    toggle: () => this.togglePlay(),
    step: (direction) => this.step(direction),
    stepIteration: (direction) => this.player.stepIteration(direction),
    seek: (index) => {
      this.player.pause();
      this.player.seek(index);
    },
    setPace: (pace) => this.setPace(pace),
  });
  private readonly setup = makeSetup({
    chooseCase: (name) => void this.open({ kind: 'case', name }, ''),
    chooseGrid: (spec) => spec && void this.open({ kind: 'grid', spec }, this.setup.formula.text()),
    chooseFile: (file) => void this.openFile(file),
    changeFormula: debounce(300, (text: string) => void this.applyFormula(text)),
    changeOption: (name, value) => {
      this.settings.options[name] = value;
      void this.forgetRun();
    },
    run: () => void this.start(true),
    stop: () => void this.workshop.stop(),
  });
  private readonly start_ = h(
    'button',
    { type: 'button', class: 'start', 'aria-label': 'Play', onclick: () => this.togglePlay() },
    icon('play'),
  );
  private readonly measures = new Refresher(() => this.measure());
  private readonly ellipses = new Refresher(() =>
    this.picture.refreshEllipses(this.initial, (points) => this.workshop.call('tensors', { points })),
  );
  private pictureLoaded: Promise<void> = Promise.resolve();
  private readonly rewriteLink = debounce(250, () => this.writeLink());

  mount(root: HTMLElement): void {
    const problem = h('p', { class: 'problem', role: 'alert', hidden: true });
    this.picture.onProblem = (sentence) => {
      problem.textContent = sentence ?? '';
      problem.hidden = sentence === null;
    };
    root.replaceChildren(
      makeHeader({
        copyLink: () => void this.copyLink(),
        save: (format) => void this.save(format),
        toggleTheme,
        help: () => this.help.showModal(),
      }),
      h(
        'main',
        {},
        this.setup.element,
        h(
          'section',
          { class: 'view', 'aria-label': 'Picture' },
          h('div', { class: 'frame' }, this.tools.element, this.picture.host, this.tools.legend, this.start_, problem),
          this.transport.caption,
          this.transport.element,
        ),
        this.indicators.element,
      ),
      this.messages.element,
      this.help,
    );
    this.listen();
    this.pictureLoaded = this.picture.load().then(() => this.ellipses.request(0));
    void this.begin();
  }

  private listen(): void {
    const { player, workshop } = this;
    const reduced = matchMedia('(prefers-reduced-motion: reduce)');
    player.still = reduced.matches;
    reduced.addEventListener('change', () => (player.still = reduced.matches));
    player.onShow = (shown) => {
      this.picture.show(shown);
      this.measures.request(player.playing ? 200 : 20);
      this.refresh();
    };
    let last = 0;
    const tick = (now: number): void => {
      if (!player.playing) return;
      player.tick(now - last);
      last = now;
      requestAnimationFrame(tick);
    };
    let wasPlaying = false;
    player.onState = () => {
      if (player.playing && !wasPlaying) {
        last = performance.now();
        requestAnimationFrame(tick);
      }
      wasPlaying = player.playing;
      this.refresh();
    };
    workshop.onEvents = (events) => {
      player.append(events);
      this.showAwaited();
    };
    workshop.onCrash = (error) => this.messages.show({ kind: 'error', text: error.message, action: this.restartAction() });
    this.picture.onPose = () => this.rewriteLink();
    followTheme(() => {
      this.picture.retheme();
      this.refresh();
    });
    acceptDrops((file) => void this.openFile(file));
    addEventListener('hashchange', () => void this.followLink());
    addEventListener('resize', debounce(100, () => this.refresh()));
    const mark = (name: Mark) => () => this.toggleMark(name);
    listenToKeys({
      ' ': () => this.togglePlay(),
      ArrowLeft: () => this.step(-1),
      ArrowRight: () => this.step(1),
      'Shift+ArrowLeft': () => player.stepIteration(-1),
      'Shift+ArrowRight': () => player.stepIteration(1),
      Home: () => player.seek(0),
      End: () => player.seek(player.events.length),
      '+': () => this.setPace(paces[Math.min(paces.length - 1, paces.indexOf(player.pace) + 1)]),
      '-': () => this.setPace(paces[Math.max(0, paces.indexOf(player.pace) - 1)]),
      t: mark('tags'),
      l: mark('layer'),
      h: mark('hull'),
      b: mark('buffer'),
      m: mark('ellipses'),
      c: () => this.change({ colouring: colourings[(colourings.indexOf(this.settings.colouring) + 1) % colourings.length] }),
      f: () => this.picture.fit(),
      o: () => this.setup.openFileDialog(),
      '?': () => this.help.showModal(),
    });
  }

  // ---- opening

  /** First contact with the core, at the start and after it was lost. */
  private async begin(): Promise<void> {
    this.refresh();
    try {
      const { version, cases } = await this.workshop.call('about', {});
      this.version = version;
      this.cases = cases;
      this.setup.setCases(cases);
    } catch (error) {
      this.tell(error);
      return;
    }
    await this.applySettings();
    await this.pictureLoaded;
    if (this.settings.camera) this.picture.pose = this.settings.camera;
  }

  /** Makes the page show what the settings say. */
  private async applySettings(): Promise<void> {
    const { mesh, formula, event, pace } = this.settings;
    this.player.pace = pace;
    this.picture.setLook(this.settings);
    if (mesh.kind === 'file' && !this.file) {
      await this.open({ kind: 'case', name: 'iso2d' }, '');
      this.messages.show({
        kind: 'error',
        text: `This link belongs to the mesh file “${mesh.name}”, which is not part of it. Drop that file here to go on.`,
      });
      return;
    }
    const done = await this.open(mesh, formula, true);
    if (!done && this.initial === nothing) await this.open({ kind: 'case', name: 'iso2d' }, '', true);
    else if (done && event !== null && event > 0) {
      this.awaited = event;
      await this.start(false);
    }
  }

  private async followLink(): Promise<void> {
    if (location.hash.slice(1) === this.link()) return;
    this.settings = decodeSettings(location.hash);
    await this.applySettings();
    this.picture.pose = this.settings.camera;
  }

  /** Opens a mesh with a metric (empty: the case's own, or one that suits the mesh). False when it was refused. */
  private async open(choice: MeshChoice, formula: string, fromLink = false): Promise<boolean> {
    const found = choice.kind === 'case' ? this.cases.find((c) => c.name === choice.name) : undefined;
    const source: MeshSource =
      choice.kind === 'file' ? { kind: 'file', name: choice.name, bytes: this.file ?? new Uint8Array(0) } : choice;
    let mesh: MeshArrays;
    let text = formula || found?.formula || '';
    try {
      mesh = await this.workshop.open(source, text ? { formula: text } : undefined);
      if (!text) {
        text = formulaFor(mesh);
        await this.workshop.setMetric(text);
      }
    } catch (error) {
      this.tell(error);
      this.refresh();
      return false;
    }
    if (!fromLink) this.messages.clear();
    this.settings.mesh = choice;
    this.settings.formula = text === found?.formula ? '' : text;
    if (!fromLink) this.settings.camera = null;
    this.setup.formula.setText(text);
    this.setup.formula.setError(null);
    this.initial = mesh;
    this.indicators.setCase(choice.kind === 'case' && this.settings.formula === '' ? choice.name : null);
    this.showInitial(true);
    await this.metricChanged();
    return true;
  }

  private async openFile(file: File): Promise<void> {
    const before = this.file;
    this.file = new Uint8Array(await file.arrayBuffer());
    if (!(await this.open({ kind: 'file', name: file.name }, ''))) this.file = before;
  }

  private async applyFormula(text: string): Promise<void> {
    try {
      await this.workshop.setMetric(text);
    } catch (error) {
      if (error instanceof CoreError) this.setup.formula.setError(error.message);
      else this.tell(error);
      return;
    }
    if (text !== this.setup.formula.text()) return; // typed on meanwhile
    this.setup.formula.setError(null);
    const { mesh } = this.settings;
    const own = mesh.kind === 'case' ? this.cases.find((c) => c.name === mesh.name)?.formula : undefined;
    this.settings.formula = text === own ? '' : text;
    this.indicators.setCase(mesh.kind === 'case' && this.settings.formula === '' ? mesh.name : null);
    this.showInitial(false);
    await this.metricChanged();
  }

  /** Numbers that depend on mesh and metric alone. */
  private async metricChanged(): Promise<void> {
    try {
      const report = JSON.parse(await this.workshop.call('report', {})) as { complexity?: number };
      this.indicators.setIdealCells(report.complexity ?? null);
    } catch {
      this.indicators.setIdealCells(null);
    }
  }

  /** Back to the initial mesh, without a run. */
  private showInitial(fit: boolean): void {
    this.awaited = null;
    this.irregular = null;
    this.setup.setStatus('');
    this.player.reset(this.initial);
    this.picture.clearEllipses();
    this.picture.showAll(fit);
    this.measures.request(0);
    this.ellipses.request(0);
    this.refresh();
  }

  private async forgetRun(): Promise<void> {
    const { events } = this.player;
    await this.workshop.abandon();
    if (events.length > 0) this.showInitial(false);
    this.refresh();
  }

  // ---- running

  /** Computes the run; plays it while it comes if wished. */
  private async start(play: boolean): Promise<void> {
    const { player, workshop } = this;
    await workshop.abandon();
    const { awaited } = this;
    if (player.events.length > 0) this.showInitial(false);
    this.awaited = awaited;
    const run = workshop.adapt({ ...this.settings.options });
    this.setup.setStatus('Computing');
    if (play) player.play();
    this.refresh();
    try {
      const result = await run;
      if (!result) return;
      player.finish();
      const report = JSON.parse(result.report) as { irregular_vertices?: number; mesh?: { cells: number } };
      this.irregular = report.irregular_vertices ?? null;
      const made = report.mesh ? `${report.mesh.cells.toLocaleString('en')} ${cellWord(this.initial.dim, report.mesh.cells)}` : 'Done';
      this.setup.setStatus(
        `${made} in ${result.seconds.toFixed(result.seconds < 10 ? 1 : 0)} s. ${result.outcome.status === 'ok' ? '' : result.outcome.message}`.trim(),
      );
      this.showAwaited(true);
    } catch (error) {
      player.pause();
      player.finish();
      this.setup.setStatus('');
      this.tell(error);
    }
    this.refresh();
  }

  private showAwaited(last = false): void {
    if (this.awaited === null) return;
    const { player } = this;
    if (player.events.length < this.awaited && !last) return;
    const index = Math.min(this.awaited, player.events.length);
    this.awaited = null;
    player.seek(index);
  }

  private get hasRun(): boolean {
    return this.player.events.length > 0 || this.workshop.running;
  }

  private togglePlay(): void {
    if (this.initial === nothing) return;
    if (this.player.playing) this.player.pause();
    else if (this.hasRun) this.player.play();
    else void this.start(true);
  }

  private step(direction: 1 | -1): void {
    if (this.initial === nothing) return;
    if (!this.hasRun && direction === 1) {
      this.awaited = 1;
      void this.start(false);
    } else {
      this.player.step(direction);
    }
  }

  private setPace(pace: Pace): void {
    this.player.pace = pace;
    this.change({ pace });
  }

  // ---- looking

  private change(patch: Partial<Settings>): void {
    Object.assign(this.settings, patch);
    this.picture.setLook(this.settings);
    this.refresh();
  }

  private toggleMark(mark: Mark): void {
    this.change({ marks: { ...this.settings.marks, [mark]: !this.settings.marks[mark] } });
  }

  private async measure(): Promise<void> {
    const { mesh } = this.player;
    const { points, cells } = mesh.snapshot();
    const measures = await this.workshop.call('measure', { points, cells, lengths: true }, [points.buffer, cells.buffer] as ArrayBuffer[]);
    if (mesh !== this.player.mesh) return;
    this.picture.setShapes(measures.shapes as Float64Array<ArrayBuffer>);
    this.indicators.update(measures);
  }

  /** Brings every panel up to date with settings and player. */
  private refresh(): void {
    const { player, settings } = this;
    const event = player.current;
    this.transport.update({
      events: player.events,
      index: player.index,
      playing: player.playing,
      running: this.workshop.running,
      pace: settings.pace,
      caption: this.initial === nothing ? 'Loading' : captionOf(event, player.mesh, settings.options.threshold, player.events.length),
      kind: event?.kind ?? null,
      iteration: player.iterations,
    });
    this.setup.update({ mesh: settings.mesh, options: settings.options, running: this.workshop.running, summary: this.summary() });
    this.tools.update({ marks: settings.marks, colouring: settings.colouring, dim: player.mesh.dim });
    const { colours } = this.picture;
    this.tools.setLegend(
      colours &&
        (settings.colouring === 'shape'
          ? { colours, title: 'Shape η', low: '0 flat', high: '1 unit' }
          : { colours, title: 'Made in iteration', low: 'initial', high: String(player.iterations) }),
    );
    this.start_.hidden = this.hasRun || this.initial === nothing;
    this.indicators.setIrregular(player.atEnd && player.complete ? this.irregular : null);
    this.rewriteLink();
  }

  private summary(): string {
    if (this.initial === nothing) return '';
    const { mesh } = this.settings;
    const { dim, cells, points } = this.initial;
    const count = cells.length >> dim;
    const name = mesh.kind === 'file' ? `${mesh.name}: ` : '';
    return `${name}${count.toLocaleString('en')} ${cellWord(dim, count)}, ${(points.length / dim).toLocaleString('en')} vertices at the start`;
  }

  // ---- links and files

  private link(): string {
    const event = this.player.index > 0 ? this.player.index : null;
    return encodeSettings({ ...this.settings, event: this.awaited ?? event, camera: this.picture.pose });
  }

  private writeLink(): void {
    if (this.player.playing || this.initial === nothing) return;
    history.replaceState(null, '', `#${this.link()}`);
  }

  private async copyLink(): Promise<void> {
    this.player.pause();
    this.writeLink();
    try {
      await navigator.clipboard.writeText(location.href);
      this.messages.show({ kind: 'note', text: 'The link is copied: it shows exactly this, event and camera included.' });
    } catch {
      this.messages.show({ kind: 'note', text: 'The address bar holds the link to exactly this; copy it from there.' });
    }
  }

  private async save(format: SaveFormat): Promise<void> {
    const { mesh } = this.settings;
    const stem = (mesh.kind === 'case' ? mesh.name : mesh.kind === 'file' ? mesh.name.replace(/\.\w+$/, '') : 'grid').replace(/[^\w-]+/g, '-');
    const name = `${stem}-${this.player.index}.${format}`;
    try {
      this.player.pause();
      const blob = format === 'png' ? await this.picture.capture() : await this.fileOf(name);
      const url = URL.createObjectURL(blob);
      h('a', { href: url, download: name }).click();
      setTimeout(() => URL.revokeObjectURL(url), 10_000);
      this.messages.show({ kind: 'note', text: `Saved ${name}, ${saveFormats.find((f) => f.id === format)?.label}.` });
    } catch (error) {
      this.tell(error);
    }
  }

  private async fileOf(name: string): Promise<Blob> {
    const { player } = this;
    const last = player.complete && player.atEnd;
    const bytes = await this.workshop.call('write', { name, ...(last ? {} : { events: player.index }) });
    return new Blob([bytes as Uint8Array<ArrayBuffer>], { type: 'application/octet-stream' });
  }

  // ---- mishaps

  private restartAction(): { label: string; run(): void } {
    return {
      label: 'Start again',
      run: () => {
        this.workshop.restart();
        void this.begin();
      },
    };
  }

  private tell(error: unknown): void {
    const text = error instanceof Error ? error.message : String(error);
    if (error instanceof LoadError) this.messages.show({ kind: 'error', text, action: this.restartAction() });
    else if (!(error instanceof Error) || error.name !== 'CrashError') this.messages.show({ kind: 'error', text });
  }
}
