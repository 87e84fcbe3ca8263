// The page: settings, player, picture and panels, and what happens between them.
import { LoadError } from '../../../wasm/loader.ts';
import { CoreError } from '../../../wasm/session.ts';
import { makeHeader, type SaveFormat } from '../panels/header.ts';
import { makeHelp } from '../panels/help.ts';
import { makeIndicators } from '../panels/indicators.ts';
import { makeLookInside } from '../panels/look_inside.ts';
import { makeMessages } from '../panels/messages.ts';
import { makePictureTools } from '../panels/picture_tools.ts';
import { makeSetup } from '../panels/setup.ts';
import { makeTransport } from '../panels/transport.ts';
import { looksInside } from '../inside/look_inside.ts';
import { captionOf } from '../replay/caption.ts';
import { Player } from '../replay/player.ts';
import { decodeSettings, encodeSettings } from '../state/permalink.ts';
import { type Mark, type MeshChoice, type Pace, type Settings } from '../state/settings.ts';
import { debounce, h } from '../ui/dom.ts';
import { icon } from '../ui/icons.ts';
import { acceptDrops } from './drop.ts';
import { listenToKeys } from './keyboard.ts';
import { keyActions } from './keys.ts';
import { Picture } from './picture.ts';
import { Refresher } from './refresher.ts';
import { RunControl } from './run_control.ts';
import { saveShown } from './saving.ts';
import { Subject, nothing } from './subject.ts';
import { followTheme, toggleTheme } from './theme.ts';
import { makeTicker } from './ticker.ts';
import { legendOf, summaryOf } from './words.ts';
import { Workshop } from './workshop.ts';

export class App {
  private settings: Settings = decodeSettings(location.hash);
  private version = '';

  private readonly workshop = new Workshop();
  private readonly subject = new Subject(this.workshop);
  private readonly player = new Player(nothing);
  private readonly picture = new Picture(this.player);
  private readonly run = new RunControl(this.player, this.workshop, {
    options: () => this.settings.options,
    ready: () => !this.subject.empty,
    showInitial: () => this.showInitial(false),
    setStatus: (sentence) => this.setup.setStatus(sentence),
    refresh: () => this.refresh(),
    tell: (error) => this.tell(error),
  });
  private readonly messages = makeMessages();
  private readonly indicators = makeIndicators();
  private readonly help = makeHelp(() => this.version);
  private readonly inside = makeLookInside({
    change: (inside) => this.change({ inside }),
    viewDirection: () => this.picture.direction,
  });
  private readonly tools = makePictureTools({
    inside: this.inside.toggle,
    toggleMark: (mark) => this.toggleMark(mark),
    setColouring: (colouring) => this.change({ colouring }),
    fit: () => this.picture.fit(),
  });
  private readonly transport = makeTransport({
    toggle: () => this.run.togglePlay(),
    step: (direction) => this.run.step(direction),
    stepIteration: (direction) => this.player.stepIteration(direction),
    seek: (index) => {
      this.player.pause();
      this.player.seek(index);
    },
    setPace: (pace) => this.setPace(pace),
  });
  private readonly setup = makeSetup({
    chooseCase: (name) => void this.open({ kind: 'case', name }, ''),
    chooseFigure: ({ link }) => void this.follow(decodeSettings(link)),
    chooseGrid: (spec) => spec && void this.open({ kind: 'grid', spec }, this.setup.formula.text()),
    chooseFile: (file) => void this.openFile(file),
    changeFormula: debounce(300, (text: string) => void this.applyFormula(text)),
    changeOption: (name, value) => {
      this.settings.options[name] = value;
      void this.run.forget();
    },
    run: () => void this.run.start('play'),
    stop: () => void this.run.stop(),
  });
  private readonly start_ = h(
    'button',
    { type: 'button', class: 'start', 'aria-label': 'Play', onclick: () => this.run.togglePlay() },
    icon('play'),
  );
  private readonly measures = new Refresher(() => this.measure());
  private readonly ellipses = new Refresher(() =>
    this.picture.refreshEllipses(this.subject.initial, (points) => this.workshop.call('tensors', { points })),
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
          h(
            'div',
            { class: 'frame' },
            this.tools.element,
            h('div', { class: 'stage' }, this.picture.host, this.tools.legend, this.start_, problem),
            this.inside.element,
          ),
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
    const refresh = (): void => this.refresh();
    const reduced = matchMedia('(prefers-reduced-motion: reduce)');
    player.still = reduced.matches;
    reduced.addEventListener('change', () => (player.still = reduced.matches));
    player.onShow = (shown) => {
      this.picture.show(shown);
      this.measures.request(player.playing ? 200 : 20);
      this.refresh();
    };
    const tick = makeTicker(player);
    player.onState = () => {
      tick();
      this.refresh();
    };
    workshop.onCrash = (error) =>
      this.messages.show({ kind: 'error', text: error.message, action: this.restartAction() });
    this.picture.onPose = () => this.rewriteLink();
    this.picture.onInside = (report) => report && this.inside.setReport(report);
    followTheme(() => {
      this.picture.retheme();
      this.refresh();
    });
    acceptDrops((file) => void this.openFile(file));
    addEventListener('hashchange', () => void this.followLink());
    addEventListener('resize', debounce(100, refresh));
    listenToKeys(
      keyActions({
        settings: () => this.settings,
        change: (patch) => this.change(patch),
        toggleMark: (mark) => this.toggleMark(mark),
        setPace: (pace) => this.setPace(pace),
        openFile: () => this.setup.openFileDialog(),
        help: () => this.help.showModal(),
        run: this.run,
        player,
        picture: this.picture,
        inside: this.inside,
      }),
    );
  }

  // ---- opening

  /** First contact with the core, at the start and after it was lost. */
  private async begin(): Promise<void> {
    this.refresh();
    try {
      const { version, cases } = await this.workshop.call('about', {});
      this.version = version;
      this.subject.cases = cases;
      this.setup.setCases(cases);
    } catch (error) {
      this.tell(error);
      return;
    }
    await this.applySettings();
  }

  /** Makes the page show what the settings say. */
  private async applySettings(): Promise<void> {
    const { mesh, formula, event, pace, camera } = this.settings;
    this.player.pace = pace;
    this.picture.setLook(this.settings);
    if (looksInside(this.settings.inside)) this.inside.setOpen(true);
    if (mesh.kind === 'file' && !this.subject.file) {
      await this.open({ kind: 'case', name: 'iso2d' }, '');
      this.messages.show({
        kind: 'error',
        text: `This link belongs to the mesh file “${mesh.name}”, which it does not hold. Drop that file here to go on.`,
      });
      return;
    }
    const done = await this.open(mesh, formula, true);
    if (done && camera) void this.pictureLoaded.then(() => (this.picture.pose = camera));
    if (!done && this.subject.empty) await this.open({ kind: 'case', name: 'iso2d' }, '', true);
    else if (done && event !== null && event > 0) {
      await this.run.start({ show: event });
    }
  }

  private async followLink(): Promise<void> {
    if (location.hash.slice(1) !== this.link()) await this.follow(decodeSettings(location.hash));
  }

  /** Shows what a link or a figure says. */
  private async follow(settings: Settings): Promise<void> {
    this.messages.clear();
    this.settings = settings;
    await this.applySettings();
  }

  /** Opens a mesh with a metric, see Subject.open. False when it was refused. */
  private async open(choice: MeshChoice, formula: string, fromLink = false): Promise<boolean> {
    let text: string;
    try {
      text = await this.subject.open(choice, formula);
    } catch (error) {
      this.tell(error);
      this.refresh();
      return false;
    }
    if (!fromLink) {
      this.messages.clear();
      this.settings.camera = null;
      const { inside } = this.settings; // layers and qualities are those of another mesh
      this.change({ inside: { ...inside, peel: 0, quality: { ...inside.quality, low: 0, high: 1 } } });
    }
    this.settings.mesh = choice;
    this.setup.formula.setText(text);
    this.takeFormula(text, true);
    return true;
  }

  private openFile(file: File): Promise<void> {
    return this.subject.openFile(file, (choice) => this.open(choice, ''));
  }

  private async applyFormula(text: string): Promise<void> {
    try {
      await this.workshop.setMetric(text);
    } catch (error) {
      if (error instanceof CoreError) this.setup.formula.setError(error.message);
      else this.tell(error);
      return;
    }
    if (text === this.setup.formula.text()) this.takeFormula(text, false); // else: typed on meanwhile
  }

  /** Shows the initial mesh in the metric that is in force now. */
  private takeFormula(text: string, fit: boolean): void {
    const { mesh } = this.settings;
    this.settings.formula = text === this.subject.ownFormula(mesh) ? '' : text;
    this.setup.formula.setError(null);
    this.indicators.setCase(mesh.kind === 'case' && this.settings.formula === '' ? mesh.name : null);
    this.showInitial(fit);
    void this.subject.idealCells().then((count) => this.indicators.setIdealCells(count));
  }

  /** Back to the initial mesh, without a run. */
  private showInitial(fit: boolean): void {
    this.run.reset();
    this.setup.setStatus('');
    this.player.reset(this.subject.initial);
    this.picture.clearEllipses();
    this.picture.showAll(fit);
    this.measures.request(0);
    this.ellipses.request(0);
    this.refresh();
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
    const measures = await this.workshop.call('measure', { points, cells, lengths: true }, [
      points.buffer,
      cells.buffer,
    ] as ArrayBuffer[]);
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
      caption: this.subject.empty
        ? 'Loading'
        : captionOf(event, player.mesh, settings.options.threshold, player.events.length),
      kind: event?.kind ?? null,
      iteration: player.iterations,
    });
    this.setup.update({
      mesh: settings.mesh,
      options: settings.options,
      running: this.workshop.running,
      summary: this.subject.empty ? '' : summaryOf(settings.mesh, this.subject.initial),
    });
    this.tools.update({ marks: settings.marks, colouring: settings.colouring, dim: player.mesh.dim });
    this.inside.update(settings.inside, player.mesh.dim);
    this.tools.setLegend(legendOf(settings.colouring, this.picture.colours, player.iterations));
    this.start_.hidden = this.run.hasRun || this.subject.empty;
    this.indicators.setIrregular(player.atEnd && player.complete ? this.run.irregular : null);
    this.rewriteLink();
  }

  // ---- links and files

  private link(): string {
    const event = this.player.index > 0 ? this.player.index : null;
    return encodeSettings({ ...this.settings, event: this.run.awaited ?? event, camera: this.picture.pose });
  }

  private writeLink(): void {
    if (this.player.playing || this.subject.empty) return;
    history.replaceState(null, '', `#${this.link()}`);
  }

  private async copyLink(): Promise<void> {
    this.player.pause();
    this.writeLink();
    try {
      await navigator.clipboard.writeText(location.href);
      this.messages.show({
        kind: 'note',
        text: 'The link is copied: it shows exactly this, event and camera included.',
      });
    } catch {
      this.messages.show({ kind: 'note', text: 'The address bar holds the link to exactly this; copy it from there.' });
    }
  }

  private async save(format: SaveFormat): Promise<void> {
    const { player, picture, workshop, settings } = this;
    try {
      const name = await saveShown(format, { player, picture, workshop, mesh: settings.mesh });
      this.messages.show({ kind: 'note', text: `Saved ${name}.` });
    } catch (error) {
      this.tell(error);
    }
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
