// Drawing on the picture: catches the pointer, shows the strokes, and hands each new one over. With its panel.
import '../../style/sketch.css';
import type { Picture } from '../stage/picture.ts';
import { h, svg } from '../ui/dom.ts';
import { simplified, type Stroke } from './sketch.ts';

export interface BoardHost {
  picture: Picture;
  /** The mesh's larger side. */
  extent(): number;
  strokes(): readonly Stroke[];
  change(strokes: Stroke[]): void;
  close(): void;
}

export interface Board {
  panel: HTMLElement;
  /** Laid over the picture. */
  surface: SVGSVGElement;
  /** Strokes or camera may have changed. */
  update(): void;
}

export function makeBoard(host: BoardHost): Board {
  const surface = svg('svg', { class: 'board', 'aria-hidden': 'true' });
  const slider = (label: string, attributes: Record<string, number>, show: (value: number) => string) => {
    const output = h('output');
    const input = h('input', { type: 'range', ...attributes, oninput: () => write() });
    const write = (): void => {
      output.textContent = show(Number(input.value));
      input.setAttribute('aria-valuetext', output.textContent);
    };
    write();
    return { row: h('label', { class: 'slider' }, h('span', {}, label), input, output), value: () => Number(input.value) };
  };
  const size = slider('Size', { min: 0.003, max: 0.1, step: 0.001, value: 0.012 }, (v) => `${(100 * v).toFixed(1)} %`);
  const panel = h(
    'section',
    { class: 'sketch-panel', 'aria-label': 'Sketch' },
    h('p', { class: 'hint' }, 'Draw on the picture: cells become fine along the stroke.'),
    size.row,
    h(
      'div',
      { class: 'minis' },
      h('button', { type: 'button', class: 'mini', onclick: () => host.change(host.strokes().slice(0, -1)) }, 'Last stroke off'),
      h('button', { type: 'button', class: 'mini', onclick: () => host.change([]) }, 'Clear'),
      h('button', { type: 'button', class: 'mini', onclick: () => host.close() }, 'Done'),
    ),
  );

  let drawing: [number, number][] | null = null;
  const place = (event: PointerEvent): [number, number] => host.picture.placeAt(event.clientX, event.clientY);
  surface.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    surface.setPointerCapture(event.pointerId);
    drawing = [place(event)];
    update();
  });
  surface.addEventListener('pointermove', (event) => {
    if (!drawing) return;
    drawing.push(place(event));
    update();
  });
  const end = (): void => {
    if (!drawing) return;
    const extent = host.extent();
    const points = simplified(drawing, 0.006 * extent);
    drawing = null;
    host.change([...host.strokes(), { size: size.value() * extent, stretch: 1, points }]);
  };
  surface.addEventListener('pointerup', end);
  surface.addEventListener('pointercancel', () => {
    drawing = null;
    update();
  });

  function update(): void {
    const box = surface.getBoundingClientRect();
    const line = (points: readonly (readonly [number, number])[]): string =>
      points
        .map(([x, y]) => host.picture.screenOf(x, y))
        .map(([x, y]) => `${(x - box.left).toFixed(1)},${(y - box.top).toFixed(1)}`)
        .join(' ');
    const all = [...host.strokes().map(({ points }) => points), ...(drawing ? [drawing] : [])];
    surface.replaceChildren(
      ...all.map((points) => svg('polyline', { points: line(points.length === 1 ? [points[0], points[0]] : points) })),
    );
  }
  return { panel, surface, update };
}
