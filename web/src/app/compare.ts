// A second answer to the same question over the first, with a slider that wipes between them.
import '../../style/comparison.css';
import { rivals } from '../data/rivals.ts';
import { statistics } from '../panels/statistics.ts';
import { cellWord } from '../replay/caption.ts';
import { Stage } from '../stage/stage.ts';
import { defaultMarks, lastEvent, optionDefaults, type OptionName, type Settings } from '../state/settings.ts';
import { grouped, h } from '../ui/dom.ts';

/** The settings of the second answer. */
export function rivalSettings(settings: Settings, rival: string): Settings {
  const options = { ...settings.options };
  for (const [name, value] of new URLSearchParams(rival)) if (name in optionDefaults) options[name as OptionName] = value;
  const marks = { ...defaultMarks, ...settings.marks, tags: false, layer: false, hull: false, buffer: false };
  return { ...settings, options, marks, event: rival === 'initial' ? null : lastEvent, camera: null };
}

export interface Comparison {
  element: HTMLElement;
  /** The first answer's settings or camera may have changed. */
  update(settings: Settings): void;
  /** "1,402 quads, l 0.98 ± 0.11" of the first answer. */
  setFirst(words: string): void;
  close(): void;
}

/** "1,402 quads, l 0.98, cv 0.112" */
export function summaryOfMeasures(lengths: Float64Array, shapes: Float64Array, dim: number): string {
  const [l, eta] = [statistics(lengths), statistics(shapes)];
  if (!l || !eta) return '';
  const count = eta.row[0];
  return `${grouped(count)} ${cellWord(dim, count)}, l ${l.row[2].toFixed(2)}, cv ${l.row[4].toFixed(3)}, η ${eta.row[2].toFixed(2)}`;
}

/** Lays the second answer over `first`. */
export async function compare(first: Stage, rival: string, tell: (error: unknown) => void): Promise<Comparison> {
  let settings = rivalSettings(first.settings(), rival);
  const label = rivals.find(({ value }) => value === rival)?.label ?? rival;
  const [left, right] = [h('span', { class: 'side-note left' }), h('span', { class: 'side-note right' })];
  right.textContent = `${label}: computing`;
  const second = new Stage(() => settings, {
    refresh: () => undefined,
    opened: () => undefined,
    measured: ({ lengths, shapes }) =>
      (right.textContent = `${label}: ${summaryOfMeasures(lengths, shapes, second.player.mesh.dim)}`),
    setStatus: () => undefined,
    done: () => undefined,
    stepped: () => undefined,
    tell,
  });
  for (const [name, bytes] of first.subject.files) second.subject.files.set(name, bytes);
  const over = h('div', { class: 'over', 'aria-hidden': 'true' }, second.picture.host);
  const slider = h('input', {
    type: 'range',
    class: 'wipe',
    min: 0,
    max: 100,
    value: 50,
    'aria-label': `Wipe between what is set and ${label}`,
    oninput: () => wipe(),
  });
  const line = h('div', { class: 'wipe-line' });
  const element = h('div', { class: 'comparison' }, over, line, left, right, slider);
  function wipe(): void {
    over.style.clipPath = `inset(0 0 0 ${slider.value}%)`;
    line.style.left = `${slider.value}%`;
  }
  wipe();
  const follow = (): void => {
    const pose = first.picture.pose;
    if (pose) second.picture.pose = pose;
    else second.picture.fit();
  };
  first.picture.onMove = follow;
  void second.show().then(() => second.apply()).then(follow).catch(tell);
  return {
    element,
    update(next) {
      settings = { ...settings, colouring: next.colouring, inside: next.inside };
      second.picture.setLook(settings);
    },
    setFirst: (words) => (left.textContent = words && `as set: ${words}`),
    close() {
      first.picture.onMove = () => undefined;
      second.close();
      element.remove();
    },
  };
}
