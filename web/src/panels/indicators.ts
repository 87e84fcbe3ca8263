// The numbers of the displayed mesh, beside the rows that the paper published for its cases.
import { published, type Row } from '../data/published.ts';
import { grouped, h } from '../ui/dom.ts';
import { makeHistogram } from './histogram.ts';
import { statistics } from './statistics.ts';

export interface DisplayedNumbers {
  lengths: Float64Array;
  shapes: Float64Array;
}

export interface Indicators {
  /** What fills the panel. */
  content: HTMLElement[];
  setCase(name: string | null): void;
  /** The range that is shown alone, by which measure. */
  setPicked(measure: string, range: [number, number] | null): void;
  setIdealCells(count: number | null): void;
  /** Shown at the end of a run: from the report of the core. */
  setIrregular(count: number | null): void;
  update(numbers: DisplayedNumbers): void;
}

const columns = ['Nb', 'min', 'mean', 'max', 'cv'] as const;

function cells(row: Row): HTMLTableCellElement[] {
  const [count, low, mean, high, cv] = row;
  return [String(count), low.toFixed(3), mean.toFixed(3), high.toFixed(2), cv.toFixed(3)].map((text) =>
    h('td', {}, text),
  );
}

function makeTable(caption: string): { element: HTMLElement; fill(ours: Row | null, paper: [string, Row][]): void } {
  const body = h('tbody');
  const element = h(
    'table',
    { class: 'indicators' },
    h('caption', { class: 'unseen' }, caption),
    h(
      'thead',
      {},
      h(
        'tr',
        {},
        h('th', { scope: 'col' }, h('span', { class: 'unseen' }, 'Mesh')),
        ...columns.map((c) => h('th', { scope: 'col' }, c)),
      ),
    ),
    body,
  );
  return {
    element,
    fill(ours, paper) {
      const row = (label: string, values: Row, kind: string): HTMLElement =>
        h('tr', { class: kind }, h('th', { scope: 'row' }, label), ...cells(values));
      body.replaceChildren(
        ...(ours ? [row('Shown', ours, 'ours')] : []),
        ...(paper.length
          ? [
              h(
                'tr',
                { class: 'group' },
                h('th', { scope: 'rowgroup', colspan: columns.length + 1 }, 'Published in the paper'),
              ),
            ]
          : []),
        ...paper.map(([label, values]) => row(label, values, 'paper')),
      );
    },
  };
}

function fact(label: string, explanation: string): { element: HTMLElement; set(text: string): void } {
  const value = h('dd', {}, '–');
  return {
    element: h('div', { title: explanation }, h('dt', {}, label), value),
    set: (text) => (value.textContent = text),
  };
}

export interface IndicatorActions {
  /** Cells whose measure is in the range are shown alone; null: all. */
  pick(measure: 'eta' | 'length', range: [number, number] | null): void;
  /** Flies to the cell with the worst shape. */
  worst(): void;
}

export function makeIndicators(actions: IndicatorActions): Indicators {
  const range: [number, number] = [Math.SQRT1_2, Math.SQRT2];
  const cellCount = fact('Cells', 'Cells of the mesh as it is shown');
  const ideal = fact('Ideal', 'The integral of sqrt(det M) over the domain: how many unit cells would fill it');
  const inRange = fact('Unit edges', 'Share of the edges with a metric length between 0.71 and 1.41');
  const irregular = fact(
    'Irregular',
    'Inner vertices with other than 4 quads, or at an irregular edge between hexes, at the end of the run',
  );
  const lengthTable = makeTable('Metric edge length');
  const shapeTable = makeTable('Shape eta');
  const lengthPlot = makeHistogram({
    label: 'metric edge lengths',
    logarithmic: true,
    low: 0.25,
    high: 4,
    ticks: [1 / 16, 0.25, 0.5, 1, 2, 4, 16, 64],
    band: range,
    mark: 1,
    pick: (picked) => actions.pick('length', picked),
  });
  const shapePlot = makeHistogram({
    label: 'shape eta',
    logarithmic: false,
    low: 0,
    high: 1,
    ticks: [0, 0.25, 0.5, 0.75, 1],
    pick: (picked) => actions.pick('eta', picked),
  });
  const content = [
    h('dl', { class: 'facts' }, cellCount.element, ideal.element, inRange.element, irregular.element),
    h('h3', {}, 'Metric edge length ', h('i', {}, 'l'), h('span', { class: 'aim' }, 'aim: 1')),
    lengthPlot.element,
    lengthTable.element,
    h('h3', {}, 'Shape ', h('i', {}, 'η'), h('span', { class: 'aim' }, 'aim: 1, a unit cell in the metric')),
    shapePlot.element,
    shapeTable.element,
    h('button', { type: 'button', class: 'mini worst', title: 'Fly there (W)', onclick: () => actions.worst() }, 'Worst cell'),
    h(
      'p',
      { class: 'hint' },
      'cv is the standard deviation divided by the mean. Drag over a histogram to show a range of cells alone; click it for all.',
    ),
  ];

  let name: string | null = null;
  let last: DisplayedNumbers | null = null;
  const refresh = (): void => {
    const rows = (name && published[name]) || [];
    const lengths = last && statistics(last.lengths);
    const shapes = last && statistics(last.shapes);
    lengthTable.fill(
      lengths?.row ?? null,
      rows.map((r) => [r.label, r.lengths]),
    );
    shapeTable.fill(
      shapes?.row ?? null,
      rows.map((r) => [r.label, r.shapes]),
    );
    if (shapes) cellCount.set(grouped(shapes.row[0]));
    if (lengths) inRange.set(`${Math.round(100 * lengths.inRange)} %`);
  };
  return {
    content,
    setCase(next) {
      name = next;
      refresh();
    },
    setPicked(measure, picked) {
      lengthPlot.setRange(measure === 'length' ? picked : null);
      shapePlot.setRange(measure === 'eta' ? picked : null);
    },
    setIdealCells: (count) => ideal.set(count === null ? '–' : grouped(Math.round(count))),
    setIrregular: (count) => irregular.set(count === null ? '–' : grouped(count)),
    update(numbers) {
      last = numbers;
      lengthPlot.update(numbers.lengths);
      shapePlot.update(numbers.shapes);
      refresh();
    },
  };
}
