// A small histogram: metric lengths on a logarithmic axis with the unit range marked, shapes on a linear one. Dragging
// over it picks a range of cells.
import { h, svg } from '../ui/dom.ts';

export interface HistogramOptions {
  label: string;
  logarithmic: boolean;
  /** Range of the axis; values beyond widen it when logarithmic and go into the last bin when not. */
  low: number;
  high: number;
  ticks: number[];
  /** A range to shade and a value to mark. */
  band?: [number, number];
  mark?: number;
  /** The visitor has picked a range by dragging over it, or all again. */
  pick(range: [number, number] | null): void;
}

export interface Histogram {
  element: HTMLElement;
  /** The range that is picked out; null: all. */
  setRange(range: [number, number] | null): void;
  update(values: Float64Array): void;
}

const [width, height, foot] = [288, 92, 18];
const bins = 48;

export function makeHistogram(options: HistogramOptions): Histogram {
  const scale = (v: number): number => (options.logarithmic ? Math.log2(v) : v);
  const picture = svg('svg', { viewBox: `0 0 ${width} ${height + foot}`, class: 'histogram', role: 'img' });
  const chosen = svg('rect', { class: 'chosen', y: 0, height, visibility: 'hidden' });
  const element = h(
    'div',
    {
      class: 'pickable',
      tabindex: 0,
      role: 'slider',
      'aria-label': `Cells shown by ${options.label}: arrow keys move the upper bound, with shift the lower, escape shows all`,
      'aria-valuemin': 0,
      'aria-valuemax': bins,
      title: 'Drag over a range to show its cells alone',
    },
    picture,
  );
  let limits: [number, number] = [scale(options.low), scale(options.high)];
  let range: [number, number] | null = null;
  const valueAt = (share: number): number => {
    const v = limits[0] + share * (limits[1] - limits[0]);
    return options.logarithmic ? 2 ** v : v;
  };
  const shareOf = (value: number): number =>
    Math.min(1, Math.max(0, (scale(value) - limits[0]) / (limits[1] - limits[0])));
  function showRange(): void {
    const [from, to] = range ? range.map(shareOf) : [0, 1];
    chosen.setAttribute('visibility', range ? 'visible' : 'hidden');
    chosen.setAttribute('x', String(from * width));
    chosen.setAttribute('width', String(Math.max(2, (to - from) * width)));
    element.setAttribute('aria-valuenow', String(Math.round(to * bins)));
    element.setAttribute('aria-valuetext', range ? range.map((v) => v.toPrecision(2)).join(' to ') : 'all');
  }
  function pick(next: [number, number] | null): void {
    range = next;
    showRange();
    options.pick(next);
  }
  const shareAt = (event: PointerEvent): number => {
    const box = picture.getBoundingClientRect();
    return Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
  };
  let from: number | null = null;
  element.addEventListener('pointerdown', (event) => {
    from = shareAt(event);
    element.setPointerCapture(event.pointerId);
  });
  element.addEventListener('pointermove', (event) => {
    if (from === null) return;
    const to = shareAt(event);
    if (Math.abs(to - from) > 0.01) pick([valueAt(Math.min(from, to)), valueAt(Math.max(from, to))]);
  });
  element.addEventListener('pointerup', (event) => {
    if (from !== null && Math.abs(shareAt(event) - from) <= 0.01 && range) pick(null); // a click: all again
    from = null;
  });
  element.addEventListener('keydown', (event) => {
    const step = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    if (event.key === 'Escape') pick(null);
    else if (step) {
      const ends = range ? range.map(shareOf) : [0, 1];
      const which = event.shiftKey ? 0 : 1;
      ends[which] = Math.min(1, Math.max(0, ends[which] + step / bins));
      if (ends[0] <= ends[1]) pick(ends[0] <= 0 && ends[1] >= 1 ? null : [valueAt(ends[0]), valueAt(ends[1])]);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  });

  function update(values: Float64Array): void {
    let [low, high] = [scale(options.low), scale(options.high)];
    const finite = values.filter((v) => Number.isFinite(v) && (!options.logarithmic || v > 0));
    if (options.logarithmic) {
      for (const v of finite) {
        low = Math.min(low, Math.floor(scale(v)));
        high = Math.max(high, Math.ceil(scale(v)));
      }
    }
    limits = [low, high];
    const x = (v: number): number => ((scale(v) - low) / (high - low)) * width;
    const counts = new Array<number>(bins).fill(0);
    for (const v of finite) counts[Math.min(bins - 1, Math.max(0, Math.floor((x(v) / width) * bins)))]++;
    const top = Math.max(1, ...counts);
    const bar = width / bins;
    const ticks = options.ticks.filter((t) => scale(t) >= low && scale(t) <= high);

    picture.replaceChildren(
      chosen,
      ...(options.band
        ? [
            svg('rect', {
              class: 'band',
              x: x(options.band[0]),
              width: x(options.band[1]) - x(options.band[0]),
              y: 0,
              height,
            }),
          ]
        : []),
      ...counts.flatMap((n, i) =>
        n === 0
          ? []
          : [
              svg('rect', {
                class: 'bar',
                x: i * bar + 0.4,
                width: bar - 0.8,
                y: height - Math.max(1, (n / top) * (height - 4)),
                height: Math.max(1, (n / top) * (height - 4)),
              }),
            ],
      ),
      svg('line', { class: 'axis', x1: 0, x2: width, y1: height + 0.5, y2: height + 0.5 }),
      ...(options.mark
        ? [svg('line', { class: 'unit', x1: x(options.mark), x2: x(options.mark), y1: 0, y2: height })]
        : []),
      ...ticks.map((t) =>
        svg(
          'text',
          { x: Math.min(width - 8, Math.max(8, x(t))), y: height + foot - 4, 'text-anchor': 'middle' },
          t < 1 && options.logarithmic ? `1/${Math.round(1 / t)}` : String(t),
        ),
      ),
    );
    picture.setAttribute('aria-label', describe(options.label, finite, options.band));
    showRange();
  }
  return {
    element,
    update,
    setRange(next) {
      range = next;
      showRange();
    },
  };
}

function describe(label: string, values: Float64Array, band?: [number, number]): string {
  if (values.length === 0) return `Histogram of ${label}: no values yet`;
  const inside = band ? values.filter((v) => v >= band[0] && v <= band[1]).length / values.length : 0;
  const share = band ? `, ${Math.round(100 * inside)} % between ${band[0].toFixed(2)} and ${band[1].toFixed(2)}` : '';
  return `Histogram of ${label}: ${values.length} values${share}`;
}
