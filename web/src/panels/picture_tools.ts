// On the picture: which marks are drawn (and what they look like), how cells are coloured, and the legend of that.
import { colourings, marks, type Colouring, type Mark } from '../state/settings.ts';
import { h, svg } from '../ui/dom.ts';
import { icon } from '../ui/icons.ts';
import { makeLegend, type LegendContent } from './legend.ts';

export interface PictureToolActions {
  toggleMark(mark: Mark): void;
  setColouring(colouring: Colouring): void;
  fit(): void;
  fullScreen(): void;
  /** Looks at a mesh of hexahedra from here, from the mesh to the eye. */
  lookFrom(direction: number[]): void;
  /** Opens the panel of hexahedral meshes. */
  inside: HTMLElement;
}

export interface PictureTools {
  element: HTMLElement;
  /** Laid over the picture. */
  legend: HTMLElement;
  update(state: { marks: Record<Mark, boolean>; colouring: Colouring; dim: number }): void;
  /** Colours of the legend and the words at its ends; null: none. */
  setLegend(legend: LegendContent | null): void;
}

const markLabels: Record<Mark, [label: string, explanation: string]> = {
  tags: ['Tags', 'Edges longer than the threshold'],
  layer: ['Layer', 'Cells of the shrink set'],
  hull: ['Hull', 'Outline of the shrink set'],
  buffer: ['Buffer layer', 'Cells that fill the void'],
  ellipses: ['Metric', 'Ellipses, in space ellipsoids, as wide as a unit edge'],
  isolines: ['Isolines', 'Lines of equal size, each twice as large as the next'],
  irregular: ['Irregular', 'Inner vertices with other than four quads: a dot for fewer, a ring for more'],
};
const colouringLabels: Record<Colouring, string> = {
  plain: 'Plain',
  shape: 'Shape η',
  length: 'Length l',
  jacobian: 'Jacobian',
  age: 'Age',
};

/** A sample of the mark, drawn as in the picture. */
function swatch(mark: Mark): SVGSVGElement {
  const shapes: Record<Mark, SVGElement[]> = {
    tags: [svg('path', { d: 'M5 12L13 4', class: 'swatch-tag' })],
    layer: [svg('rect', { x: 2, y: 2, width: 14, height: 12, rx: 2, class: 'swatch-layer' })],
    hull: [svg('rect', { x: 3, y: 3, width: 12, height: 10, rx: 1, class: 'swatch-hull' })],
    buffer: [
      svg('rect', { x: 2, y: 2, width: 14, height: 12, rx: 2, class: 'swatch-buffer' }),
      svg('path', { d: 'M4 13L14 3M2.5 9L9 2.5M9 13.5L15.5 7', class: 'swatch-hatch' }),
    ],
    ellipses: [
      svg('ellipse', { cx: 9, cy: 8, rx: 6.5, ry: 3.6, transform: 'rotate(-25 9 8)', class: 'swatch-ellipse' }),
    ],
    isolines: [svg('path', { d: 'M1 12C6 2 12 14 17 4M1 6.5C4 0 9 4 12 2', class: 'swatch-isoline' })],
    irregular: [svg('circle', { cx: 5, cy: 8, r: 3.2, class: 'swatch-fewer' }), svg('circle', { cx: 13, cy: 8, r: 3.2, class: 'swatch-more' })],
  };
  return svg('svg', { viewBox: '0 0 18 16', width: 18, height: 16, 'aria-hidden': 'true' }, ...shapes[mark]);
}

/** From the mesh to the eye; seen exactly along z, up would be undefined. */
const directions: readonly (readonly [name: string, direction: readonly [number, number, number]])[] = [
  ['+x', [1, 0, 0]],
  ['−x', [-1, 0, 0]],
  ['+y', [0, 1, 0]],
  ['−y', [0, -1, 0]],
  ['+z', [0, -1e-4, 1]],
  ['−z', [0, -1e-4, -1]],
  ['aslant', [0.55, -0.72, 0.42]],
];

export function makePictureTools(actions: PictureToolActions): PictureTools {
  const chips = Object.fromEntries(
    marks.map((mark) => [
      mark,
      h(
        'button',
        { type: 'button', class: 'chip', title: markLabels[mark][1], onclick: () => actions.toggleMark(mark) },
        swatch(mark),
        markLabels[mark][0],
      ),
    ]),
  ) as Record<Mark, HTMLButtonElement>;
  const colouring = h(
    'select',
    {
      'aria-label': 'Colour of cells',
      title: 'Colour of cells (C)',
      onchange: () => actions.setColouring(colouring.value as Colouring),
    },
    ...colourings.map((c) => h('option', { value: c }, colouringLabels[c])),
  );
  const views = h(
    'select',
    {
      'aria-label': 'View from',
      title: 'View from',
      hidden: true,
      onchange: () => {
        const direction = directions.find(([name]) => name === views.value);
        if (direction) actions.lookFrom([...direction[1]]);
        views.value = '';
      },
    },
    h('option', { value: '' }, 'View'),
    ...directions.map(([name]) => h('option', { value: name }, name)),
  );
  const legend = makeLegend();
  const element = h(
    'div',
    { class: 'picture-tools' },
    h(
      'div',
      { class: 'chips', role: 'group', 'aria-label': 'Drawn on the mesh' },
      ...marks.map((mark) => chips[mark]),
      actions.inside,
    ),
    h(
      'div',
      { class: 'colouring' },
      colouring,
      views,
      h(
        'button',
        {
          type: 'button',
          class: 'round',
          'aria-label': 'Show the whole mesh',
          title: 'Show the whole mesh (F)',
          onclick: actions.fit,
        },
        icon('fit'),
      ),
      h(
        'button',
        {
          type: 'button',
          class: 'round',
          'aria-label': 'Full screen',
          title: 'Full screen',
          onclick: actions.fullScreen,
        },
        icon('full'),
      ),
    ),
  );
  return {
    element,
    legend: legend.element,
    update(state) {
      for (const mark of marks) chips[mark].setAttribute('aria-pressed', String(state.marks[mark]));
      for (const mark of ['isolines', 'irregular'] as const) chips[mark].hidden = state.dim === 3;
      colouring.value = state.colouring;
      views.hidden = state.dim === 2;
    },
    setLegend: legend.set,
  };
}
