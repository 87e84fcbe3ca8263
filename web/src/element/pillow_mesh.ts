// <pillow-mesh>: a mesh that adapts, anywhere in a page. Describes itself by attributes (attributes.ts), computes in the
// workers that all elements of the page share, loads when it comes near the window.
import type { MetricRequest } from '../../../wasm/metrics.ts';
import type { RunResult } from '../../../wasm/protocol.ts';
import type { MeshArrays } from '../../../wasm/session.ts';
import controlsSheet from '../../style/controls.css?inline';
import stageSheet from '../../style/stage.css?inline';
import tokensSheet from '../../style/tokens.css?inline';
import { cameraKeys } from '../app/camera_keys.ts';
import { listenToKeys } from '../app/keyboard.ts';
import { makeTransport } from '../panels/transport.ts';
import { makeLegend } from '../panels/legend.ts';
import { Stage } from '../stage/stage.ts';
import { legendOf } from '../stage/words.ts';
import { encodeSettings, sameComputation } from '../state/permalink.ts';
import { lastEvent, type Settings } from '../state/settings.ts';
import { h } from '../ui/dom.ts';
import { icon } from '../ui/icons.ts';
import { behaviourAttributes, controlsOf, fileNameOf, settingsOf, stateAttributes } from './attributes.ts';
import elementSheet from './element.css?inline';
import type { PillowMeshEventMap } from './event_map.ts';

let sheets: CSSStyleSheet[] | null = null;

/** Constructed style sheets: a strict content security policy has nothing against them. */
function styleSheets(): CSSStyleSheet[] {
  return (sheets ??= [tokensSheet, controlsSheet, stageSheet, elementSheet].map((text) => {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(text);
    return sheet;
  }));
}

/** How far outside of the window an element loads, and beyond which it gives its graphics context back. */
const nearby = '400px 0px';

// The module can be imported where there is no document, e.g. by a site generator.
const Base = globalThis.HTMLElement ?? (class {} as typeof HTMLElement);

export class PillowMeshElement extends Base {
  static readonly observedAttributes = [...stateAttributes, ...behaviourAttributes];

  private settings!: Settings;
  private stage: Stage | null = null;
  private transport: ReturnType<typeof makeTransport> | null = null;
  private readonly legend = globalThis.document ? makeLegend() : (null as never);
  private start: HTMLButtonElement | null = null;
  private status: HTMLElement | null = null;
  private observer: IntersectionObserver | null = null;
  private wasPlaying = false;
  private applying: Promise<unknown> = Promise.resolve();
  private changed = false;
  private readonly loaded = Promise.withResolvers<void>();

  // ---- for scripts

  /** Settled when the initial mesh is there for the first time. */
  get ready(): Promise<void> {
    return this.loaded.promise;
  }

  /** Operations done to the mesh that is shown; set it to show another moment. */
  get position(): number {
    return this.stage?.player.index ?? 0;
  }

  set position(position: number) {
    void this.seek(position);
  }

  /** Operations known so far. */
  get length(): number {
    return this.stage?.player.events.length ?? 0;
  }

  get playing(): boolean {
    return this.stage?.player.playing ?? false;
  }

  /** What is shown in a sentence. */
  get captionText(): string {
    return this.stage?.caption ?? '';
  }

  /** A copy of the mesh that is shown. */
  get mesh(): MeshArrays {
    const { mesh } = this.activate().player;
    return { dim: mesh.dim, ...mesh.snapshot() };
  }

  /** The state as the part of a link behind '#'. */
  get link(): string {
    return encodeSettings(this.stage?.state ?? settingsOf(this));
  }

  play(): void {
    const { player, run } = this.activate();
    if (!player.playing) void this.applying.then(() => run.togglePlay());
  }

  pause(): void {
    this.stage?.player.pause();
  }

  /** One operation forwards or backwards. */
  step(direction: 1 | -1 = 1): void {
    this.activate().run.step(direction);
  }

  /** Shows the mesh after so many operations, or at the end; computes the run if need be. */
  async seek(position: number | 'last'): Promise<void> {
    const stage = this.activate();
    await this.applying;
    await stage.seek(position === 'last' ? lastEvent : position);
  }

  /** Computes the run without playing it. Null when another took its place. */
  async run(): Promise<RunResult | null> {
    const stage = this.activate();
    await this.applying;
    return stage.run.start({ show: lastEvent });
  }

  /** A metric made from a solution, a picture, dabs, walls, ... for the mesh that is open (wasm/metrics.ts). */
  async setMetric(request: MetricRequest): Promise<void> {
    const stage = this.activate();
    await this.applying;
    await stage.setMadeMetric(request);
  }

  /** Opens a mesh file that did not come from an address. */
  async open(file: File): Promise<void> {
    const stage = this.activate();
    await this.applying;
    await stage.subject.openFile(file, (choice) => stage.open(choice, ''));
  }

  /** The camera shows the whole mesh. */
  fit(): void {
    this.stage?.picture.fit();
  }

  /** The mesh that is shown as a file (name.vtu, .vtk, .msh, .mesh), or its report (.json). */
  async save(name: string): Promise<Uint8Array> {
    const { player, workshop } = this.activate();
    const last = player.complete && player.atEnd;
    return workshop.call('write', { name, ...(last ? {} : { events: player.index }) });
  }

  /** The picture as a PNG. */
  async toBlob(): Promise<Blob> {
    return this.activate().picture.capture();
  }

  // ---- life

  connectedCallback(): void {
    if (!this.shadowRoot) this.build();
    this.observer = new IntersectionObserver(
      (entries) => {
        const near = entries.some((entry) => entry.isIntersecting);
        if (near) this.activate();
        else this.rest();
      },
      { rootMargin: nearby },
    );
    this.observer.observe(this);
    if (this.getAttribute('loading') === 'eager') this.activate();
  }

  disconnectedCallback(): void {
    this.observer?.disconnect();
    queueMicrotask(() => {
      if (this.isConnected) return; // only moved
      this.stage?.close();
      this.stage = null;
    });
  }

  attributeChangedCallback(name: string): void {
    if (!this.shadowRoot) return;
    if (behaviourAttributes.some((behaviour) => behaviour === name)) {
      this.behave();
      this.stage?.picture.retheme();
      return;
    }
    if (!this.stage || this.changed) return;
    this.changed = true; // several attributes may change at once
    queueMicrotask(() => {
      this.changed = false;
      this.applying = this.applying.then(() => this.follow());
    });
  }

  private build(): void {
    const root = this.attachShadow({ mode: 'open', delegatesFocus: true });
    root.adoptedStyleSheets = styleSheets();
    this.start = h(
      'button',
      { type: 'button', class: 'start', part: 'start', 'aria-label': 'Play', hidden: true, onclick: () => this.play() },
      icon('play'),
    );
    this.status = h('p', { class: 'problem', part: 'problem', role: 'alert', hidden: true });
    this.transport = makeTransport({
      toggle: () => this.stage?.run.togglePlay(),
      step: (direction) => this.step(direction),
      stepIteration: (direction) => this.stage?.player.stepIteration(direction),
      seek: (index) => void this.seek(index),
      setPace: (pace) => {
        this.settings.pace = this.activate().player.pace = pace;
        this.refresh();
      },
    });
    this.transport.element.setAttribute('part', 'transport');
    this.transport.caption.setAttribute('part', 'caption');
    const picture = h('div', { class: 'stage', part: 'stage' }, this.legend.element, h('output', { class: 'pointed', part: 'pointed', hidden: true }), this.start, this.status);
    this.legend.element.setAttribute('part', 'legend');
    picture.prepend(h('div', { class: 'poster', part: 'poster' }, h('slot')));
    root.append(
      h(
        'div',
        { class: 'whole', part: 'whole' },
        picture,
        this.transport.caption,
        this.transport.element,
        h('slot', { name: 'caption' }),
      ),
    );
    listenToKeys(
      {
        ' ': () => this.stage?.run.togglePlay(),
        ArrowLeft: () => this.step(-1),
        ArrowRight: () => this.step(1),
        'Shift+ArrowLeft': () => this.stage?.player.stepIteration(-1),
        'Shift+ArrowRight': () => this.stage?.player.stepIteration(1),
        Home: () => void this.seek(0),
        End: () => void this.seek('last'),
        ...cameraKeys(() => this.stage?.picture),
      },
      root,
    );
    this.showNothing();
    this.behave();
  }

  private behave(): void {
    const controls = controlsOf(this);
    const whole = this.shadowRoot!.querySelector<HTMLElement>('.whole')!;
    whole.dataset.controls = controls;
    this.transport!.element.hidden = controls === 'none';
    this.transport!.caption.classList.toggle('unseen', this.getAttribute('caption') === 'off');
  }

  /** Loads what is needed; from then on there is a stage. */
  private activate(): Stage {
    if (this.stage) {
      if (!this.stage.picture.available) this.wake();
      return this.stage;
    }
    if (!this.shadowRoot) this.build();
    this.settings = settingsOf(this);
    const stage = (this.stage = new Stage(() => this.settings, {
      refresh: () => this.refresh(),
      opened: () => undefined,
      measured: () => undefined,
      setStatus: () => undefined,
      done: ({ outcome, report, seconds }) =>
        this.say('done', { report: report ? JSON.parse(report) : null, seconds, ...outcome }),
      stepped: ({ to }) =>
        this.say('step', {
          position: to,
          length: stage.player.events.length,
          kind: stage.player.current?.kind ?? null,
          caption: stage.caption,
        }),
      tell: (error) => this.tell(error),
    }));
    const pointed = this.shadowRoot!.querySelector<HTMLElement>('.pointed')!;
    stage.picture.onPoint = (sentence) => {
      pointed.textContent = sentence;
      pointed.hidden = sentence === null;
    };
    stage.picture.onProblem = (sentence) => this.showProblem(sentence);
    this.shadowRoot!.querySelector('.poster')!.after(stage.picture.host);
    this.wake();
    this.applying = this.apply();
    return stage;
  }

  private wake(): void {
    void this.stage!.show().then(() => this.shadowRoot!.querySelector('.poster')?.toggleAttribute('hidden', true));
  }

  private rest(): void {
    this.stage?.rest();
  }

  private async apply(): Promise<void> {
    const stage = this.stage!;
    await this.fetchFile();
    if (!(await stage.apply())) return;
    this.loaded.resolve();
    this.say('load', { cells: stage.player.mesh.liveCellCount(), dim: stage.player.mesh.dim });
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    if (this.hasAttribute('autoplay') && !still && !stage.player.playing) stage.run.togglePlay();
  }

  /** Attributes have changed: computes only what they ask anew. */
  private async follow(): Promise<void> {
    const { stage, settings: before } = this;
    if (!stage) return;
    this.settings = settingsOf(this);
    if (!sameComputation(before, this.settings)) return this.apply();
    stage.player.pace = this.settings.pace;
    stage.picture.setLook(this.settings);
    if (this.settings.camera) stage.picture.pose = this.settings.camera;
    if (this.settings.event !== before.event) await stage.seek(this.settings.event ?? 0);
    this.refresh();
  }

  private async fetchFile(): Promise<void> {
    const src = this.getAttribute('src');
    const name = src && fileNameOf(src);
    if (!src || !name || this.stage!.subject.files.has(name)) return;
    try {
      const response = await fetch(new URL(src, document.baseURI));
      if (!response.ok) throw new Error(`the server answered ${response.status}`);
      this.stage!.subject.files.set(name, new Uint8Array(await response.arrayBuffer()));
    } catch (error) {
      this.tell(new Error(`${src} could not be fetched: ${(error as Error).message}.`));
    }
  }

  /** The controls before anything is loaded. */
  private showNothing(): void {
    this.transport!.update({
      events: [],
      index: 0,
      playing: false,
      running: false,
      pace: 'auto',
      caption: this.getAttribute('aria-label') ?? '',
      kind: null,
      iteration: 1,
    });
  }

  private refresh(): void {
    const { stage, transport } = this;
    if (!stage || !transport) return;
    const { player, run, workshop, subject, picture } = stage;
    if (player.playing !== this.wasPlaying) {
      this.wasPlaying = player.playing;
      this.say(player.playing ? 'play' : 'pause', null);
    }
    transport.update({
      events: player.events,
      index: player.index,
      playing: player.playing,
      running: workshop.running,
      pace: this.settings.pace,
      caption: stage.caption,
      kind: player.current?.kind ?? null,
      iteration: player.iterations,
    });
    this.legend.set(legendOf(this.settings.colouring, picture.colours, player.iterations));
    this.start!.hidden = run.hasRun || subject.empty || controlsOf(this) === 'none';
  }

  private showProblem(sentence: string | null): void {
    if (!this.status) return;
    this.status.textContent = sentence ?? '';
    this.status.hidden = sentence === null;
  }

  private tell(error: unknown): void {
    const message = error instanceof Error ? error.message : String(error);
    this.showProblem(message);
    this.say('error', { message, error });
  }

  private say<N extends keyof PillowMeshEventMap>(name: N, detail: PillowMeshEventMap[N]['detail']): void {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }
}

export interface PillowMeshElement {
  addEventListener<N extends keyof PillowMeshEventMap>(
    name: N,
    listener: (event: PillowMeshEventMap[N]) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(name: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
}

declare global {
  interface HTMLElementTagNameMap {
    'pillow-mesh': PillowMeshElement;
  }
}

/** Makes the element known to the page, once. */
export function definePillowMesh(name = 'pillow-mesh'): void {
  if (globalThis.customElements && !customElements.get(name)) customElements.define(name, PillowMeshElement);
}
