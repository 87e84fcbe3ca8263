// Play, step, scrub, pace; and the caption that says in words what is shown.
import { eventKinds, type EventKind, type MeshEvent } from '../../../wasm/events.ts';
import { paces, type Pace } from '../state/settings.ts';
import { h } from '../ui/dom.ts';
import { icon, type IconName } from '../ui/icons.ts';
import { readColours } from '../viewport/palette.ts';

export interface TransportActions {
  toggle(): void;
  step(direction: 1 | -1): void;
  stepIteration(direction: 1 | -1): void;
  seek(index: number): void;
  setPace(pace: Pace): void;
}

export interface TransportState {
  events: readonly MeshEvent[];
  index: number;
  playing: boolean;
  /** The run goes on and more events will come. */
  running: boolean;
  pace: Pace;
  caption: string;
  kind: EventKind | null;
  iteration: number;
}

export interface Transport {
  caption: HTMLElement;
  element: HTMLElement;
  update(state: TransportState): void;
}

const paceLabels: Record<Pace, string> = {
  auto: 'Auto',
  '0.5': '½×',
  '1': '1×',
  '2': '2×',
  '4': '4×',
  '16': '16×',
  '64': '64×',
};
const kindLabels: Record<EventKind, string> = {
  tags: 'Tags',
  layer: 'Layer',
  shrink: 'Shrink',
  connect: 'Connect',
  dice: 'Dice',
  relocation: 'Smooth',
  iteration: 'Iteration',
  rotate: 'Rotate',
  collapse: 'Collapse',
  open: 'Open',
  chord_collapse: 'Row out',
  chord_split: 'Row in',
  boundary_collapse: 'Rows joined',
  boundary_open: 'Rows let out',
  partial_chord_collapse: 'Part of a row out',
  partial_chord_split: 'Part of a row in',
};

export function makeTransport(actions: TransportActions): Transport {
  const button = (name: IconName, label: string, keys: string, action: () => void): HTMLButtonElement =>
    h(
      'button',
      { class: 'round', type: 'button', 'aria-label': label, title: `${label} (${keys})`, onclick: action },
      icon(name),
    );
  const play = h('button', { class: 'round play', type: 'button', onclick: actions.toggle });
  const stepBack = button('back', 'Step back', '←', () => actions.step(-1));
  const stepForward = button('forward', 'Step forward', '→', () => actions.step(1));
  const first = button('start', 'Previous iteration', 'Shift ←', () => actions.stepIteration(-1));
  const last = button('end', 'Next iteration', 'Shift →', () => actions.stepIteration(1));
  const slider = h('input', {
    type: 'range',
    min: 0,
    max: 0,
    step: 1,
    value: 0,
    'aria-label': 'Event shown',
    oninput: () => actions.seek(Number(slider.value)),
  });
  const track = h('canvas', { class: 'track', 'aria-hidden': 'true' });
  const counter = h('output', { class: 'counter' });
  const pace = h(
    'select',
    { 'aria-label': 'Pace', title: 'Pace (+ and −)', onchange: () => actions.setPace(pace.value as Pace) },
    ...paces.map((p) => h('option', { value: p }, paceLabels[p])),
  );
  const element = h(
    'div',
    { class: 'transport', role: 'group', 'aria-label': 'Playback' },
    h('div', { class: 'buttons' }, first, stepBack, play, stepForward, last),
    h('div', { class: 'timeline' }, track, slider),
    h('div', { class: 'side' }, counter, pace),
  );
  const badge = h('span', { class: 'badge' });
  const text = h('span', { class: 'text' });
  const caption = h(
    'p',
    { class: 'caption', id: 'caption', 'aria-live': 'polite', 'aria-atomic': 'true' },
    badge,
    text,
  );

  let drawn = { count: -1, width: 0, theme: '' };
  let shown: readonly MeshEvent[] = [];
  let timer: ReturnType<typeof setTimeout> | undefined;
  /** Events arrive in a stream: the strip keeps up a few times a second. */
  function requestTrack(events: readonly MeshEvent[]): void {
    shown = events;
    timer ??= setTimeout(() => {
      timer = undefined;
      drawTrack(shown);
    }, 120);
  }
  /** One thin column per event, coloured by kind; tags and ends of iterations as taller marks. */
  function drawTrack(events: readonly MeshEvent[]): void {
    const width = Math.round(track.clientWidth * devicePixelRatio);
    const height = Math.round(track.clientHeight * devicePixelRatio);
    const theme = getComputedStyle(track).color;
    if (!width || (drawn.count === events.length && drawn.width === width && drawn.theme === theme)) return;
    drawn = { count: events.length, width, theme };
    track.width = width;
    track.height = height;
    const context = track.getContext('2d', { willReadFrequently: true }); // no graphics card: drawing never waits for one
    if (!context || events.length === 0) return;
    const all = readColours(track.parentElement ?? track, eventKinds.map((kind) => `event-${kind}` as const));
    const colours = Object.fromEntries(eventKinds.map((kind) => [kind, all[`event-${kind}`]]));
    // Where several events share a column of pixels, the last one is drawn; layers stand for what becomes of them.
    const crowded = width < 3 * events.length;
    const columns = new Map<number, EventKind>();
    events.forEach(({ kind }, i) => {
      const shown = crowded && (kind === 'shrink' || kind === 'connect') ? 'layer' : kind;
      columns.set(Math.floor((i * width) / events.length), shown);
    });
    const column = Math.max(1, Math.ceil(width / events.length));
    const tall = events.flatMap(({ kind }, i) => (kind === 'iteration' || kind === 'tags' ? [[i, kind] as const] : []));
    for (const [x, kind] of columns) {
      context.fillStyle = colours[kind];
      context.fillRect(x, height * 0.3, column, height * 0.4);
    }
    for (const [i, kind] of tall) {
      context.fillStyle = colours[kind];
      context.fillRect(Math.floor((i * width) / events.length), 0, Math.max(column, devicePixelRatio), height);
    }
  }

  return {
    caption,
    element,
    update({ events, index, playing, running, pace: chosen, caption: words, kind, iteration }) {
      const action = playing ? 'Pause' : 'Play';
      if (play.ariaLabel !== action) {
        play.replaceChildren(icon(playing ? 'pause' : 'play'));
        play.ariaLabel = action;
        play.title = `${action} (space)`;
      }
      // Not `disabled`: a button that is loses the focus, and the keys with it.
      const atStart = String(index === 0);
      const atEnd = String(index === events.length && (events.length > 0 || running));
      for (const button of [first, stepBack]) button.setAttribute('aria-disabled', atStart);
      for (const button of [stepForward, last]) button.setAttribute('aria-disabled', atEnd);
      slider.max = String(events.length);
      slider.value = String(index);
      slider.disabled = events.length === 0;
      slider.setAttribute('aria-valuetext', `${index} of ${events.length}: ${words}`);
      counter.textContent = events.length ? `${index} / ${events.length}${running ? '…' : ''}` : '';
      counter.title = `Event ${index}, iteration ${iteration}`;
      pace.value = chosen;
      badge.textContent = kind ? kindLabels[kind] : 'Start';
      badge.dataset.kind = kind ?? 'start';
      // A screen reader cannot follow a film: captions are spoken when it stands still.
      caption.setAttribute('aria-live', playing ? 'off' : 'polite');
      if (text.textContent !== words) text.textContent = words;
      requestTrack(events);
    },
  };
}
