// The page: settings, a stage, the panels around it, and what happens between them.
import { CoreError } from '../../../wasm/errors.ts';
import { looksInside, pickedRange, withRange } from '../inside/look_inside.ts';
import { makeHeader, type SaveFormat } from '../panels/header.ts';
import { makeIndicators } from '../panels/indicators_later.ts';
import { makeLookInside } from '../panels/look_inside_later.ts';
import { makeMessages } from '../panels/messages.ts';
import { makePictureTools } from '../panels/picture_tools.ts';
import { makeSetup } from '../panels/setup.ts';
import { makeTransport } from '../panels/transport.ts';
import { makeStartButton, makeViewSection } from '../panels/view_section.ts';
import { Stage } from '../stage/stage.ts';
import { legendOf, summaryOf } from '../stage/words.ts';
import { decodeSettings, encodeSettings, sameComputation } from '../state/permalink.ts';
import { lastEvent, type Mark, type MeshChoice, type Pace, type Settings } from '../state/settings.ts';
import { debounce, h } from '../ui/dom.ts';
import { Comparing } from './comparing.ts';
import { copyAddress, showEmbed, showHelp } from './dialogs.ts';
import { acceptDrops } from './drop.ts';
import { toggleFullScreen } from './full_screen.ts';
import { History } from './history.ts';
import { listenToKeys } from './keyboard.ts';
import { keyActions } from './keys.ts';
import { isMetric } from './given_metric.ts';
import { firstVisit } from './first_visit.ts';
import { messageOf } from './mishaps.ts';
import { Live } from './live.ts';
import { followTheme, toggleTheme } from './theme.ts';

export class App {
  private settings: Settings = decodeSettings(location.hash);
  private version = '';
  private readonly stage: Stage = new Stage(() => this.settings, {
    refresh: () => this.refresh(),
    opened: (formula) => this.opened(formula),
    measured: (measures) => {
      this.indicators.update(measures);
      this.comparing.setFirst(measures);
    },
    setStatus: (sentence) => this.setup.setStatus(sentence),
    done: () => undefined,
    stepped: () => undefined,
    tell: (error) => this.tell(error),
    follow: () => this.live.on && (void this.live.follow(), true),
  });
  private readonly history = new History((link) => void this.follow(decodeSettings(link)));
  private readonly comparing = new Comparing(
    this.stage,
    () => document.querySelector('.stage'),
    (error) => this.tell(error),
  );
  private readonly messages = makeMessages();
  private readonly live = new Live(this.stage, {
    messages: this.messages,
    sketchPlace: () => this.setup.sketchPlace,
    refresh: () => this.refresh(),
    asked: () => this.writeLink(),
    setStatus: (sentence) => this.setup.setStatus(sentence),
    refused: (error) => this.refused(error),
    tell: (error) => this.tell(error),
  });
  private readonly indicators = makeIndicators({
    pick: (measure, range) => this.pick(measure, range),
    worst: () => this.flyToWorst(),
  });
  private readonly pointed = h('output', { class: 'pointed', hidden: true });
  private readonly header = makeHeader({
    copyLink: () => void this.copyLink(),
    embed: () => void showEmbed(this.link(), this.stage.caption, this.messages),
    undo: () => this.history.undo(),
    redo: () => this.history.redo(),
    save: (format) => void this.save(format),
    toggleTheme,
    help: () => void showHelp(() => this.version),
  });
  private readonly inside = makeLookInside({
    change: (inside) => this.change({ inside }),
    viewDirection: () => this.stage.picture.direction,
    flyTo: (cell) => this.stage.picture.pin(cell),
    takePicked: () => {
      const { picked } = this.stage.picture;
      this.stage.picture.unpick();
      return picked;
    },
  });
  private readonly tools = makePictureTools({
    inside: this.inside.toggle,
    toggleMark: (mark) => this.toggleMark(mark),
    setColouring: (colouring) => this.change({ colouring }),
    fit: () => this.stage.picture.fit(),
    fullScreen: () => void toggleFullScreen(),
    lookFrom: (direction) => this.stage.picture.lookFrom(direction),
  });
  private readonly transport = makeTransport({
    toggle: () => this.stage.run.togglePlay(),
    step: (direction) => this.stage.run.step(direction),
    stepIteration: (direction) => this.stage.player.stepIteration(direction),
    seek: (index) => void this.stage.seek(index),
    setPace: (pace) => this.setPace(pace),
  });
  private readonly setup = makeSetup({
    chooseCase: (name) => void this.open({ kind: 'case', name }, ''),
    chooseFigure: ({ link }) => void this.follow(decodeSettings(link)),
    chooseGrid: (spec) => spec && void this.open({ kind: 'grid', spec }, this.setup.formula.text()),
    chooseFile: (file) => void this.openFile(file),
    takePicture: () => void this.live.takePicture(),
    changeFormula: debounce(300, (text: string) => void this.applyFormula(text)),
    changeOption: (name, value) => {
      this.settings.options[name] = value;
      void (this.live.on ? this.live.follow() : this.stage.run.forget());
    },
    changeTarget: (cells) => {
      this.settings.targetCells = cells;
      void this.rescale();
    },
    sketch: () => void this.live.sketch(),
    compareWith: (compare) => this.change({ compare }),
    run: () => {
      this.showPicture();
      void (this.live.on ? this.live.follow() : this.stage.run.start('play'));
    },
    showEnd: () => {
      this.showPicture();
      void this.stage.seek(lastEvent);
    },
    stop: () => void (this.live.working ? this.live.stop() : this.stage.run.stop()),
  });
  private readonly start_ = makeStartButton(() => this.stage.run.togglePlay());
  private readonly rewriteLink = debounce(250, () => this.writeLink());

  /** In one column, what was pressed may be far below it. */
  private showPicture(): void {
    this.stage.picture.host.closest('.frame')?.scrollIntoView({ block: 'nearest' });
  }

  mount(root: HTMLElement): void {
    const { picture } = this.stage;
    const problem = h('p', { class: 'problem', role: 'alert', hidden: true });
    picture.onProblem = (sentence) => {
      problem.textContent = sentence ?? '';
      problem.hidden = sentence === null;
    };
    root.replaceChildren(
      this.header.element,
      h(
        'main',
        {},
        this.setup.element,
        makeViewSection({
          tools: this.tools,
          picture: picture.host,
          over: [this.pointed, this.start_, problem],
          inside: this.inside.element,
          transport: this.transport,
        }),
        this.indicators.element,
      ),
      this.messages.element,
    );
    this.listen();
    void this.stage.show();
    void this.begin();
  }

  private listen(): void {
    const { picture, player, run } = this.stage;
    picture.onPose = () => this.rewriteLink();
    picture.onPoint = (sentence) => {
      this.pointed.textContent = sentence;
      this.pointed.hidden = sentence === null;
    };
    picture.onInside = (report) => report && this.inside.setReport(report);
    followTheme(() => {
      picture.retheme();
      this.refresh();
    });
    acceptDrops((file) => void this.openFile(file));
    addEventListener('hashchange', () => {
      if (location.hash.slice(1) !== this.link()) void this.follow(decodeSettings(location.hash));
    });
    addEventListener('resize', debounce(100, () => this.refresh()));
    listenToKeys(
      keyActions({
        settings: () => this.settings,
        change: (patch) => this.change(patch),
        toggleMark: (mark) => this.toggleMark(mark),
        setPace: (pace) => this.setPace(pace),
        openFile: () => this.setup.openFileDialog(),
        help: () => void showHelp(() => this.version),
        history: this.history,
        worst: () => this.flyToWorst(),
        inside: this.inside,
        player,
        picture,
        run,
      }),
    );
  }

  // ---- opening

  /** First contact with the core, at the start and after it was lost. */
  private async begin(): Promise<void> {
    const plain = location.hash.length <= 1; // before the link is written
    this.refresh();
    try {
      const { version } = await this.stage.subject.begin();
      this.version = version;
      this.setup.setCases(this.stage.subject.cases);
    } catch (error) {
      this.tell(error);
      return;
    }
    await this.applySettings();
    this.writeLink(); // undo leads back to here, however soon something is changed
    if (plain && firstVisit() && !this.stage.player.still) this.stage.run.togglePlay();
  }

  /** Makes the page show what the settings say. */
  private async applySettings(): Promise<void> {
    const { mesh } = this.settings;
    if (looksInside(this.settings.inside)) this.inside.setOpen(true);
    if (mesh.kind === 'file' && !this.stage.subject.files.has(mesh.name)) {
      await this.open({ kind: 'case', name: 'iso2d' }, '');
      this.messages.show({
        kind: 'error',
        text: `This link belongs to the mesh file “${mesh.name}”, which it does not hold. Drop that file here to go on.`,
      });
      return;
    }
    const done = await this.stage.apply();
    if (!done && this.stage.subject.empty) await this.stage.open({ kind: 'case', name: 'iso2d' }, '');
  }

  /** Shows what a link, a figure or an earlier state says; computes only what has changed. */
  private async follow(next: Settings): Promise<void> {
    const { stage } = this;
    this.messages.clear();
    const before = this.settings;
    this.settings = next;
    const live = this.live.on;
    if (!sameComputation(before, next)) {
      const ask = live && next.event === lastEvent && JSON.stringify(before.mesh) === JSON.stringify(next.mesh);
      const formula = next.formula || stage.subject.ownFormula(next.mesh);
      if (ask && (next.sketch || formula)) return this.live.follow(next.sketch ? { sketch: next.sketch } : { formula });
      return this.applySettings();
    }
    stage.player.pace = next.pace;
    stage.picture.setLook(next);
    stage.picture.pose = next.camera;
    if (!live || next.event !== lastEvent || !stage.player.atEnd) await stage.seek(next.event ?? 0);
    this.refresh();
  }

  /** Opens what the visitor has chosen; false when it was refused. */
  private async open(choice: MeshChoice, formula: string): Promise<boolean> {
    if (!(await this.stage.open(choice, formula))) return false;
    this.messages.clear();
    this.settings.camera = null;
    if (this.live.on) void this.live.follow();
    const { inside } = this.settings; // layers and qualities are those of another mesh
    this.change({ inside: { ...inside, peel: 0, quality: { ...inside.quality, low: 0, high: 1 }, without: [], around: [] } });
    return true;
  }

  private openFile(file: File): Promise<void> {
    if (isMetric(file)) return this.live.takeMetric(file);
    return this.stage.subject.openFile(file, (choice) => this.open(choice, ''));
  }

  private opened(formula: string): void {
    const { mesh } = this.settings;
    // What has been typed meanwhile is asked next.
    if (!this.live.on || !this.setup.formula.element.contains(document.activeElement)) this.setup.formula.setText(formula);
    this.setup.formula.setError(null);
    const own = mesh.kind === 'case' && formula === this.stage.subject.ownFormula(mesh);
    this.indicators.setCase(own ? mesh.name : null);
    void this.stage.subject.idealCells().then((count) => this.indicators.setIdealCells(count));
  }

  private async applyFormula(text: string): Promise<void> {
    if (this.live.on) return this.live.follow({ formula: text });
    try {
      await this.stage.setFormula(text, () => text === this.setup.formula.text()); // else: typed on meanwhile
    } catch (error) {
      this.refused(error);
    }
  }

  private async rescale(): Promise<void> {
    await this.stage.workshop.abandon();
    await this.stage.rescale().catch((error: unknown) => this.tell(error));
  }

  private refused(error: unknown): void {
    if (error instanceof CoreError) this.setup.formula.setError(error.message);
    else this.tell(error);
  }

  private setPace(pace: Pace): void {
    this.change({ pace: (this.stage.player.pace = pace) });
  }

  // ---- looking

  private change(patch: Partial<Settings>): void {
    Object.assign(this.settings, patch);
    this.stage.picture.setLook(this.settings);
    this.refresh();
  }

  /** Shows the cells within a range alone. */
  private pick(measure: 'eta' | 'length', range: [number, number] | null): void {
    this.change({ inside: withRange(this.settings.inside, measure, range) });
  }

  /** In 3D better cells are hidden, since they would be in the way. */
  private flyToWorst(): void {
    const { picture, player } = this.stage;
    player.pause();
    const worst = picture.worst('eta');
    if (!worst) return;
    if (player.mesh.dim === 3) {
      this.change({ inside: withRange(this.settings.inside, 'eta', [0, Math.ceil(20 * worst.value + 1) / 20]) });
      this.inside.setOpen(true);
    }
    picture.pin(worst.cell);
  }

  private toggleMark(mark: Mark): void {
    this.change({ marks: { ...this.settings.marks, [mark]: !this.settings.marks[mark] } });
  }

  /** Brings every panel up to date with settings and stage. */
  private refresh(): void {
    const { settings } = this;
    const { player, run, workshop, subject, picture, caption } = this.stage;
    const { dim } = player.mesh;
    this.transport.update({
      events: player.events,
      index: player.index,
      playing: player.playing,
      running: workshop.running,
      pace: settings.pace,
      caption,
      kind: player.current?.kind ?? null,
      iteration: player.iterations,
    });
    this.setup.update({
      mesh: settings.mesh,
      dim,
      options: settings.options,
      targetCells: settings.targetCells,
      compare: settings.compare,
      running: workshop.running || this.live.working,
      behind: player.complete && player.events.length > 0 && !player.atEnd,
      summary: subject.empty ? '' : summaryOf(settings.mesh, subject.initial),
    });
    this.tools.update({ marks: settings.marks, colouring: settings.colouring, dim });
    this.inside.update(settings.inside, dim);
    this.indicators.setPicked(settings.inside.quality.measure, pickedRange(settings.inside.quality));
    this.tools.setLegend(legendOf(settings.colouring, picture.colours, player.iterations));
    this.start_.hidden = run.hasRun || subject.empty || looksInside(settings.inside);
    this.indicators.setIrregular(player.atEnd && player.complete ? run.irregular : null);
    this.comparing.update(settings);
    this.live.update();
    this.rewriteLink();
  }

  // ---- links and files

  private link(): string {
    return encodeSettings(this.stage.state);
  }

  private writeLink(): void {
    if (this.stage.player.playing || this.stage.subject.empty) return;
    const link = this.link();
    this.history.record(link);
    this.header.update(this.history);
    history.replaceState(null, '', `#${link}`);
  }

  private async copyLink(): Promise<void> {
    this.stage.player.pause();
    this.writeLink();
    await copyAddress(this.messages);
  }

  private async save(format: SaveFormat): Promise<void> {
    try {
      const { saveShown } = await import('./saving.ts');
      const name = await saveShown(format, this.stage);
      this.messages.show({ kind: 'note', text: `Saved ${name}.` });
    } catch (error) {
      this.tell(error);
    }
  }

  // ---- mishaps

  private tell(error: unknown): void {
    this.messages.show(
      messageOf(error, () => {
        this.stage.workshop.restart();
        void this.begin();
      }),
    );
  }
}
