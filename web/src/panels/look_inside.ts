// Beside the picture of a hexahedral mesh: what is cut away, peeled off, hidden, and drawn as glass.
import '../../style/inside_panel.css';
import {
  anglesOf,
  bodies,
  cutKinds,
  defaultInside,
  directionOf,
  looksInside,
  qualityMeasures,
  type Body,
  type Cut,
  type CutKind,
  type Inside,
  type QualityMeasure,
} from '../inside/look_inside.ts';
import { grouped, h } from '../ui/dom.ts';

export interface LookInsideActions {
  change(inside: Inside): void;
  /** From the mesh to the eye; null when nothing is drawn. */
  viewDirection(): number[] | null;
  /** The cell framed in the picture, -1 for none; it is let go. */
  takePicked(): number;
  flyTo(cell: number): void;
}

/** What there is to see, see viewport/hex_body.ts. */
export interface InsideReport {
  kept: number;
  total: number;
  deepest: number;
  irregular: readonly number[] | null;
}

export interface InsidePanel {
  element: HTMLElement;
  update(inside: Inside): void;
  setReport(report: InsideReport): void;
  /** Cuts across an axis; once more: from the other side. */
  cutAcross(axis: 0 | 1 | 2): void;
  /** Takes the picked cell away, or leaves it and its neighbours alone. */
  isolate(how: 'without' | 'around'): void;
}

const cutLabels: Record<CutKind, string> = { off: 'Off', plane: 'Plane', slab: 'Slab' };
const bodyLabels: Record<Body, string> = { auto: 'Auto', solid: 'Solid', glass: 'Glass' };
const measureLabels: Record<QualityMeasure, string> = { eta: 'Shape η', jacobian: 'Scaled Jacobian', length: 'Metric length' };
const irregularLabels = ['3 or less', '5', '6 or more'];
const percent = (share: number): string => `${Math.round(100 * share)} %`;
const degrees = (angle: number): string => `${angle}°`;

/** A slider with its name before and its value behind it. */
function slider(
  label: string,
  attributes: { min: number; max: number; step: number },
  show: (value: number) => string,
  change: (value: number) => void,
): { row: HTMLElement; set(value: number, high?: number): void } {
  const output = h('output');
  const input = h('input', { type: 'range', ...attributes, oninput: () => change(Number(input.value)) });
  const row = h('label', { class: 'slider' }, h('span', {}, label), input, output);
  return {
    row,
    set(value, high) {
      if (high !== undefined) input.max = String(high);
      input.value = String(value);
      output.textContent = show(value);
      input.setAttribute('aria-valuetext', show(value));
    },
  };
}

/** One of a few words. */
function choice<W extends string>(
  name: string,
  title: string,
  words: readonly W[],
  labels: Record<W, string>,
  change: (word: W) => void,
): { element: HTMLElement; set(word: W): void } {
  const inputs = new Map(
    words.map((w) => [w, h('input', { type: 'radio', name, value: w, onchange: () => change(w) })]),
  );
  const element = h(
    'fieldset',
    { class: 'segments' },
    h('legend', { class: 'unseen' }, title),
    ...words.map((w) => h('label', {}, inputs.get(w), h('span', {}, labels[w]))),
  );
  return { element, set: (word) => (inputs.get(word)!.checked = true) };
}

export function makeInsidePanel(actions: LookInsideActions): InsidePanel {
  let inside = defaultInside();
  let deepest = 1;
  const change = (patch: Partial<Inside>): void => actions.change({ ...inside, ...patch });
  const changeCut = (patch: Partial<Cut>): void => change({ cut: { ...inside.cut, ...patch } });

  /** Cuts away the side that faces the eye; when that is so already, the other. */
  const cutAlong = (direction: number[]): void => {
    const eye = actions.viewDirection() ?? directionOf({ turn: -50, tilt: 25 });
    const facing = direction.reduce((sum, x, i) => sum + x * eye[i], 0) < 0 ? direction.map((x) => -x) : direction;
    const angles = anglesOf(facing);
    const { cut } = inside;
    const again = cut.kind !== 'off' && cut.turn === angles.turn && cut.tilt === angles.tilt;
    if (again) flip();
    else changeCut({ ...angles, kind: cut.kind === 'off' ? 'plane' : cut.kind });
  };
  const flip = (): void => {
    const { cut } = inside;
    const shown = cut.kind === 'slab' ? 1 - cut.position + cut.thickness : 1 - cut.position;
    changeCut({ ...anglesOf(directionOf(cut).map((x) => -x)), position: Math.min(1, shown) });
  };
  const cutAcross = (axis: 0 | 1 | 2): void => cutAlong([0, 1, 2].map((d) => (d === axis ? 1 : 0)));

  const kind = choice('cut', 'Cut', cutKinds, cutLabels, (word) => changeCut({ kind: word }));
  const position = slider('Position', { min: 0, max: 1, step: 0.01 }, percent, (x) => changeCut({ position: x }));
  const thickness = slider('Thickness', { min: 0.02, max: 1, step: 0.01 }, percent, (x) => changeCut({ thickness: x }));
  const turn = slider('Turn', { min: -180, max: 180, step: 1 }, degrees, (x) => changeCut({ turn: x }));
  const tilt = slider('Tilt', { min: -90, max: 90, step: 1 }, degrees, (x) => changeCut({ tilt: x }));
  const small = (label: string, title: string, action: () => void): HTMLButtonElement =>
    h('button', { type: 'button', class: 'mini', title, 'aria-label': `${label}: ${title}`, onclick: action }, label);
  const directions = h(
    'div',
    { class: 'minis', role: 'group', 'aria-label': 'Direction of the cut' },
    small('X', 'Cut across x', () => cutAcross(0)),
    small('Y', 'Cut across y', () => cutAcross(1)),
    small('Z', 'Cut across z', () => cutAcross(2)),
    small('View', 'Cut across the view', () => cutAlong(actions.viewDirection() ?? [1, 0, 0])),
    small('Flip', 'Show the other side', flip),
  );
  const cutBox = h('div', { class: 'sliders' }, directions, position.row, thickness.row, turn.row, tilt.row);

  const layers = (count: number): string => (count === 1 ? '1 layer' : `${count} layers`);
  const peel = slider('Peel', { min: 0, max: 1, step: 1 }, layers, (x) => change({ peel: x }));

  const showPeel = (): void => peel.set(inside.peel, Math.max(deepest, inside.peel));

  const measure = h(
    'select',
    {
      'aria-label': 'Hide cells by',
      onchange: () => change({ quality: { ...inside.quality, measure: measure.value as QualityMeasure } }),
    },
    ...qualityMeasures.map((m) => h('option', { value: m }, measureLabels[m])),
  );
  /** A bound as the measure has it; a length is kept as l / (1 + l). */
  const bound = (x: number): string =>
    inside.quality.measure !== 'length' ? x.toFixed(2) : x < 1 ? (x / (1 - x)).toPrecision(2) : '∞';
  const low = slider('From', { min: 0, max: 1, step: 0.01 }, bound, (x) =>
    change({ quality: { ...inside.quality, low: x, high: Math.max(x, inside.quality.high) } }),
  );
  const high = slider('To', { min: 0, max: 1, step: 0.01 }, bound, (x) =>
    change({ quality: { ...inside.quality, high: x, low: Math.min(x, inside.quality.low) } }),
  );

  const body = choice('body', 'Cells drawn as', bodies, bodyLabels, (word) => change({ body: word }));
  const irregular = h('input', { type: 'checkbox', onchange: () => change({ irregular: irregular.checked }) });
  const counts = irregularLabels.map(() => h('b'));
  const legend = h(
    'ul',
    { class: 'valences', hidden: true },
    ...irregularLabels.map((label, i) =>
      h('li', { class: `valence-${i}` }, h('i', { 'aria-hidden': 'true' }), h('span', {}, label), counts[i]),
    ),
  );
  const note = h(
    'p',
    { class: 'hint', hidden: true },
    'Cells around an edge; 4 is regular. On the boundary, one cell for each right angle is, and counts as 4 here.',
  );
  const told = h('output', { class: 'hint', 'aria-live': 'polite' }, 'Click a cell in the picture, or press W for the worst.');
  const isolate = (how: 'without' | 'around'): void => {
    const cell = actions.takePicked();
    told.textContent = cell < 0 ? 'First click a cell in the picture, or press W for the worst.' : '';
    if (cell < 0) return;
    change(how === 'around' ? { around: [cell] } : { without: [...inside.without, cell] });
    if (how === 'around') actions.flyTo(cell);
  };
  const back = small('Back', 'Bring back what was hidden by hand', () => change({ without: [], around: [] }));
  const byHand = h(
    'div',
    { class: 'minis', role: 'group', 'aria-label': 'By hand' },
    small('Hide', 'Hide the framed cell (Delete)', () => isolate('without')),
    small('Around', 'Show the framed cell and its neighbours alone (N)', () => isolate('around')),
    back,
  );
  const drawn = h('output', { class: 'drawn', 'aria-live': 'polite' });
  const reset = h(
    'button',
    { type: 'button', class: 'mini', onclick: () => actions.change(defaultInside()) },
    'Show all',
  );

  const heading = (title: string, ...rest: HTMLElement[]): HTMLElement =>
    h('div', { class: 'heading' }, h('h3', {}, title), ...rest);
  const element = h(
    'section',
    { class: 'inside', id: 'inside', 'aria-label': 'Look inside', tabindex: 0, hidden: true },
    h('div', { class: 'total' }, drawn, reset),
    h('div', { class: 'part cut-part' }, heading('Cut', kind.element), cutBox),
    h('div', { class: 'part sliders' }, peel.row),
    h('div', { class: 'part sliders' }, heading('Quality', measure), low.row, high.row),
    h('div', { class: 'part' }, heading('By hand', byHand), told),
    h('div', { class: 'part' }, heading('Cells', body.element)),
    h('div', { class: 'part' }, h('label', { class: 'check' }, irregular, 'Irregular edges'), legend, note),
  );
  return {
    element,
    cutAcross,
    isolate,
    update(next) {
      inside = next;
      reset.disabled = !looksInside(next);
      const { cut, quality, without, around } = next;
      back.disabled = without.length + around.length === 0;
      showPeel();
      kind.set(cut.kind);
      cutBox.hidden = cut.kind === 'off';
      position.set(cut.position);
      thickness.set(cut.thickness);
      thickness.row.hidden = cut.kind !== 'slab';
      turn.set(cut.turn);
      tilt.set(cut.tilt);
      measure.value = quality.measure;
      low.set(quality.low);
      high.set(quality.high);
      body.set(next.body);
      irregular.checked = next.irregular;
      legend.hidden = note.hidden = !next.irregular;
    },
    setReport({ kept, total, deepest: layers, irregular: found }) {
      const words = `${grouped(kept)} of ${grouped(total)} hexes`;
      if (drawn.textContent !== words) drawn.textContent = words;
      deepest = layers;
      showPeel();
      found?.forEach((count, i) => (counts[i].textContent = grouped(count)));
    },
  };
}
