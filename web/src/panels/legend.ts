// What the colours of the cells mean: a strip of them with words at its ends, laid over the picture.
import { h } from '../ui/dom.ts';

export interface LegendContent {
  colours: Uint8Array;
  title: string;
  low: string;
  high: string;
}

export function makeLegend(): { element: HTMLElement; set(content: LegendContent | null): void } {
  const bar = h('span', { class: 'bar' });
  const [low, high, title] = [h('span'), h('span'), h('span', { class: 'title' })];
  const element = h('div', { class: 'legend', hidden: true }, title, h('span', { class: 'scale' }, low, bar, high));
  return {
    element,
    set(next) {
      element.hidden = !next;
      if (!next) return;
      const stops = Array.from({ length: 17 }, (_, i) => {
        const at = 4 * Math.min(255, i * 16);
        return `rgb(${next.colours[at]} ${next.colours[at + 1]} ${next.colours[at + 2]})`;
      });
      bar.style.background = `linear-gradient(to right, ${stops.join(', ')})`;
      title.textContent = next.title;
      low.textContent = next.low;
      high.textContent = next.high;
    },
  };
}
