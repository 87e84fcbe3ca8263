// A small histogram: metric lengths on a logarithmic axis with the unit range marked, shapes on a linear one.
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
}

export interface Histogram {
  element: HTMLElement;
  update(values: Float64Array): void;
}

const [width, height, foot] = [288, 92, 18];
const bins = 48;

export function makeHistogram(options: HistogramOptions): Histogram {
  const picture = svg('svg', { viewBox: `0 0 ${width} ${height + foot}`, class: 'histogram', role: 'img' });
  const element = h('div', {}, picture);
  const scale = (v: number): number => (options.logarithmic ? Math.log2(v) : v);

  function update(values: Float64Array): void {
    let [low, high] = [scale(options.low), scale(options.high)];
    const finite = values.filter((v) => Number.isFinite(v) && (!options.logarithmic || v > 0));
    if (options.logarithmic) {
      for (const v of finite) {
        low = Math.min(low, Math.floor(scale(v)));
        high = Math.max(high, Math.ceil(scale(v)));
      }
    }
    const x = (v: number): number => ((scale(v) - low) / (high - low)) * width;
    const counts = new Array<number>(bins).fill(0);
    for (const v of finite) counts[Math.min(bins - 1, Math.max(0, Math.floor((x(v) / width) * bins)))]++;
    const top = Math.max(1, ...counts);
    const bar = width / bins;
    const ticks = options.ticks.filter((t) => scale(t) >= low && scale(t) <= high);

    picture.replaceChildren(
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
  }
  return { element, update };
}

function describe(label: string, values: Float64Array, band?: [number, number]): string {
  if (values.length === 0) return `Histogram of ${label}: no values yet`;
  const inside = band ? values.filter((v) => v >= band[0] && v <= band[1]).length / values.length : 0;
  const share = band ? `, ${Math.round(100 * inside)} % between ${band[0].toFixed(2)} and ${band[1].toFixed(2)}` : '';
  return `Histogram of ${label}: ${values.length} values${share}`;
}
