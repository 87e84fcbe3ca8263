// Solve, estimate, adapt, and again: a solver in the page whose meshes a figure adapts, and the curve of its error.
import '../../style/solver_loop.css';
import { PillowMeshElement } from '../element/pillow_mesh.ts';
import { grouped, h, svg } from '../ui/dom.ts';
import { asMedit, compacted, errorOf, solve, squares, type Plane } from './q1.ts';
import { exact, needed, source, type Point } from './shock.ts';

/** Cells that each turn aims at: the first ones find the shock, the others resolve it. */
const aims = [300, 300, 600, 1200];
const grids = [8, 16, 32, 64];

/** `<div class="solver-loop" data-figure="id">` gets buttons, curve and table. */
export function makeSolverLoop(box: HTMLElement): void {
  const figure = document.getElementById(box.dataset.figure ?? '');
  const uniform: Point[] = [];
  const turns: Point[] = [];
  const chart = makeChart();
  const rows = h('tbody');
  const steps = ['solve', 'estimate', 'adapt'].map((name) => h('li', {}, name));
  const status = h('p', { class: 'hint', role: 'status' });
  const one = h('button', { type: 'button', onclick: () => void go(1) }, 'One turn');
  const all = h('button', { type: 'button', onclick: () => void go(aims.length) }, 'All turns');
  const again = h('button', { type: 'button', onclick: () => restart() }, 'From the start');
  box.append(
    h('div', { class: 'try', role: 'group', 'aria-label': 'Loop' }, one, all, again, h('ol', { class: 'turn' }, ...steps)),
    status,
    chart.element,
    h(
      'table',
      {},
      h('thead', {}, h('tr', {}, ...['turn', 'quads', 'error', 'equal squares would need'].map((name) => h('th', { scope: 'col' }, name)))),
      rows,
    ),
  );
  let mesh: Plane = squares(16);
  let values = solve(mesh, source, exact);
  let generation = 0;

  const show = (): void => {
    chart.draw(uniform, turns);
    rows.replaceChildren(
      ...turns.map(({ cells, error }, i) =>
        h('tr', {}, ...[i === 0 ? 'start' : String(i), count(cells), error.toPrecision(2), i === 0 ? '' : count(needed(uniform, error))].map((text) => h('td', {}, text))),
      ),
    );
    const over = turns.length > aims.length;
    for (const button of [one, all]) button.disabled = over;
  };
  const mark = (at: number): void => steps.forEach((step, i) => step.toggleAttribute('data-now', i === at));
  const rest = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 30)); // what was marked is seen

  function restart(): void {
    ++generation;
    mesh = squares(16);
    values = solve(mesh, source, exact);
    turns.splice(0, Infinity, { cells: mesh.cells.length / 4, error: errorOf(mesh, values, exact) });
    status.textContent = '';
    mark(-1);
    show();
    if (figure instanceof PillowMeshElement) figure.position = 0;
  }

  async function go(most: number): Promise<void> {
    if (!(figure instanceof PillowMeshElement)) return;
    const mine = ++generation;
    try {
      for (let i = 0; i < most && turns.length <= aims.length; ++i) {
        const aim = aims[turns.length - 1];
        mark(1);
        status.textContent = `Turn ${turns.length}: second derivatives of the solution become a metric for ${aim} quads.`;
        await rest();
        const { mesh: background, sol } = asMedit(mesh, values);
        await figure.setMetric({
          hessianSol: { name: 'u.sol', bytes: sol, background: { name: 'u.mesh', bytes: background } },
          operations: { 'target-cells': String(aim), hmax: '0.3' },
        });
        if (mine !== generation) return;
        mark(2);
        const result = await figure.run();
        if (!result || mine !== generation) return;
        mark(0);
        await rest();
        mesh = compacted(figure.mesh);
        values = solve(mesh, source, exact);
        turns.push({ cells: mesh.cells.length / 4, error: errorOf(mesh, values, exact) });
        const { cells, error } = turns[turns.length - 1];
        status.textContent = `Turn ${turns.length - 1}: ${count(cells)} quads, error ${error.toPrecision(2)}.`;
        show();
      }
    } catch (error) {
      status.textContent = (error as Error).message;
    } finally {
      if (mine === generation) mark(-1);
    }
  }

  restart();
  void (async () => {
    for (const n of grids) {
      await rest();
      const grid = squares(n);
      uniform.push({ cells: n * n, error: errorOf(grid, solve(grid, source, exact), exact) });
      show();
    }
  })();
}

const count = (cells: number): string => grouped(Math.round(cells));

/** Error over cells, both logarithmic. */
function makeChart(): { element: SVGSVGElement; draw(uniform: readonly Point[], turns: readonly Point[]): void } {
  const [left, top, width, height] = [46, 12, 400, 220];
  const x = (cells: number): number => left + (width * Math.log10(cells / 50)) / Math.log10(100);
  const y = (error: number): number => top + (height * -Math.log10(error)) / 3.5;
  const element = svg('svg', { class: 'curve', viewBox: '0 0 470 270', role: 'img', 'aria-label': 'Error against number of quads; the table below has the numbers' });
  const label = (at: [number, number], anchor: string, text: string, name?: string): SVGTextElement => {
    const made = svg('text', { x: at[0], y: at[1], 'text-anchor': anchor, class: name });
    made.textContent = text;
    return made;
  };
  const frame = [
    ...[100, 1000].flatMap((n) => [svg('path', { class: 'grid', d: `M${x(n)} ${top}v${height}` }), label([x(n), top + height + 16], 'middle', count(n))]),
    ...[1, 0.1, 0.01, 0.001].flatMap((e) => [svg('path', { class: 'grid', d: `M${left} ${y(e)}h${width}` }), label([left - 6, y(e) + 4], 'end', String(e))]),
    label([left + width, top + height + 32], 'end', 'quads'),
    label([left + 6, top + 14], 'start', 'L2 error'),
  ];
  return {
    element,
    draw(uniform, turns) {
      const line = (points: readonly Point[], name: string): SVGElement =>
        svg('polyline', { class: name, points: points.map(({ cells, error }) => `${x(cells).toFixed(1)},${y(error).toFixed(1)}`).join(' ') });
      const last = turns[turns.length - 1];
      const [first] = uniform;
      element.replaceChildren(
        ...frame,
        line(uniform, 'uniform'),
        ...uniform.map(({ cells, error }) => svg('rect', { class: 'uniform', x: x(cells) - 3.5, y: y(error) - 3.5, width: 7, height: 7 })),
        line(turns, 'adapted'),
        ...turns.map(({ cells, error }) => svg('circle', { class: 'adapted', cx: x(cells), cy: y(error), r: 4.5 })),
        ...(first ? [label([x(first.cells) - 4, y(first.error) + 22], 'start', 'equal squares')] : []),
        ...(turns.length > 1 ? [label([x(last.cells) - 4, y(last.error) + 20], 'end', 'adapted', 'adapted')] : []),
      );
    },
  };
}
