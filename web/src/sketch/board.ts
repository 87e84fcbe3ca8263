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
  /** The last of them is still being drawn. */
  paint(strokes: Stroke[]): void;
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
  const surface = svg('svg', {
    class: 'board',
    tabindex: 0,
    role: 'application',
    'aria-label': 'Drawing board: arrow keys move the brush, with shift in small steps; space sets it down and lifts it; escape ends',
  });
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
  const stretches = [1, 1.5, 2, 3, 4, 6, 8, 12, 16];
  const size = slider('Size', { min: 0.003, max: 0.1, step: 0.001, value: 0.012 }, (v) => `${(100 * v).toFixed(1)} %`);
  const stretch = slider('Stretch', { min: 0, max: stretches.length - 1, step: 1, value: 0 }, (i) =>
    i === 0 ? 'round' : `${stretches[i]} : 1`,
  );
  const panel = h(
    'section',
    { class: 'sketch-panel', 'aria-label': 'Sketch' },
    h('p', { class: 'hint' }, 'Draw on the picture: cells become fine along the stroke, and as much longer along it as you stretch them. The mesh follows. By keys: tab to the picture, arrows move the brush, space sets it down and lifts it.'),
    size.row,
    stretch.row,
    h(
      'div',
      { class: 'minis' },
      h('button', { type: 'button', class: 'mini', onclick: () => host.change(host.strokes().slice(0, -1)) }, 'Last stroke off'),
      h('button', { type: 'button', class: 'mini', onclick: () => host.change([]) }, 'Clear'),
      h('button', { type: 'button', class: 'mini', onclick: () => host.close() }, 'Done'),
    ),
  );

  let drawing: [number, number][] | null = null;
  /** Where the keys have moved the brush, in the window; null while there is only a pointer. */
  let brush: [number, number] | null = null;
  const place = (event: PointerEvent): [number, number] => host.picture.placeAt(event.clientX, event.clientY);
  /** All strokes, with the one that is being drawn. */
  const all = (): Stroke[] => {
    if (!drawing) return [...host.strokes()];
    const extent = host.extent();
    const points = simplified(drawing, 0.006 * extent);
    return [...host.strokes(), { size: size.value() * extent, stretch: stretches[stretch.value()], points }];
  };
  const begin = (at: [number, number]): void => {
    drawing = [at];
    update();
  };
  const end = (): void => {
    if (!drawing) return;
    const strokes = all();
    drawing = null;
    host.change(strokes);
    update();
  };
  surface.addEventListener('keydown', (event) => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey || !(step || event.key === ' ' || event.key === 'Escape')) return;
    event.preventDefault();
    event.stopPropagation(); // these keys play the run elsewhere
    const box = surface.getBoundingClientRect();
    brush ??= [box.left + box.width / 2, box.top + box.height / 2];
    if (step) {
      const length = (event.shiftKey ? 0.01 : 0.04) * Math.min(box.width, box.height);
      brush = [
        Math.min(box.right, Math.max(box.left, brush[0] + length * step[0])),
        Math.min(box.bottom, Math.max(box.top, brush[1] + length * step[1])),
      ];
      if (drawing) {
        drawing.push(host.picture.placeAt(...brush));
        host.paint(all());
      }
      return update();
    }
    if (event.key === 'Escape') return host.close();
    if (drawing) end();
    else begin(host.picture.placeAt(...brush));
  });
  surface.addEventListener('mousedown', (event) => event.preventDefault()); // the focus is for keys
  surface.addEventListener('blur', () => {
    end();
    brush = null;
    update();
  });
  surface.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    brush = null;
    surface.setPointerCapture(event.pointerId);
    begin(place(event));
  });
  surface.addEventListener('pointermove', (event) => {
    if (!drawing) return;
    for (const one of event.getCoalescedEvents?.() ?? [event]) drawing.push(place(one));
    update();
    host.paint(all());
  });
  surface.addEventListener('pointerup', end);
  surface.addEventListener('pointercancel', () => {
    if (!drawing) return;
    drawing = null;
    host.change([...host.strokes()]);
  });

  function update(): void {
    // The camera looks straight down: three places tell where all others are.
    const box = surface.getBoundingClientRect();
    const [origin, right, up] = [[0, 0], [1, 0], [0, 1]].map(([x, y]) => host.picture.screenOf(x, y));
    const seen = ([x, y]: readonly [number, number]): [number, number] => [
      origin[0] - box.left + x * (right[0] - origin[0]) + y * (up[0] - origin[0]),
      origin[1] - box.top + x * (right[1] - origin[1]) + y * (up[1] - origin[1]),
    ];
    surface.replaceChildren(
      ...all().flatMap(({ points, size, stretch }) => {
        const ends = (points.length === 1 ? [points[0], points[0]] : points).map(seen);
        const unit = Math.hypot(...difference(seen([size, 0]), seen([0, 0])));
        const line = svg('polyline', { points: ends.map((end) => end.map((x) => x.toFixed(1)).join(',')).join(' ') });
        return [line, ...glyphs(ends, unit, stretch)];
      }),
      ...(brush ? [svg('circle', { class: 'brush', cx: brush[0] - box.left, cy: brush[1] - box.top, r: drawing ? 6 : 9 })] : []),
    );
  }
  return { panel, surface, update };
}

const difference = (a: readonly number[], b: readonly number[]): [number, number] => [a[0] - b[0], a[1] - b[1]];

/** The cells that a stroke asks for, one behind the other: ellipses as wide and as long as they, along it. */
function glyphs(ends: readonly [number, number][], size: number, stretch: number): SVGElement[] {
  const [along, across] = [Math.max(3, size * stretch) / 2, Math.max(1.5, size) / 2];
  const gap = Math.max(2.2 * along, 9);
  const made: SVGElement[] = [];
  let next = along;
  for (let i = 0; i + 1 < ends.length && made.length < 400; ++i) {
    const [x, y] = difference(ends[i + 1], ends[i]);
    const length = Math.hypot(x, y);
    for (; next <= length; next += gap) {
      const [cx, cy] = [ends[i][0] + (x * next) / length, ends[i][1] + (y * next) / length].map((v) => v.toFixed(1));
      const turn = ((Math.atan2(y, x) * 180) / Math.PI).toFixed(0);
      const shape = { cx, cy, rx: along.toFixed(1), ry: across.toFixed(1), transform: `rotate(${turn} ${cx} ${cy})` };
      made.push(svg('ellipse', shape));
    }
    next -= length;
  }
  return made;
}
