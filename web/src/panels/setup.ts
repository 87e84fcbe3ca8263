// What to adapt and how: case or mesh, metric, options, run.
import type { Case } from '../../../wasm/session.ts';
import { figures, type Figure } from '../data/figures.ts';
import { pictured } from '../data/pictured.ts';
import { rivals } from '../data/rivals.ts';
import type { MeshChoice, OptionName, Options } from '../state/settings.ts';
import { field, h } from '../ui/dom.ts';
import { icon, type IconName } from '../ui/icons.ts';
import { makeFormulaField, type FormulaField } from './formula.ts';

export interface SetupActions {
  chooseCase(name: string): void;
  chooseFigure(figure: Figure): void;
  chooseGrid(spec: string): void;
  chooseFile(file: File): void;
  takePicture(): void;
  changeFormula(text: string): void;
  changeOption(name: OptionName, value: string): void;
  /** null: as many as the metric asks for. */
  changeTarget(cells: number | null): void;
  compareWith(rival: string): void;
  sketch(): void;
  run(): void;
  stop(): void;
  /** Shows the mesh at the end of the run. */
  showEnd(): void;
}

export interface SetupState {
  mesh: MeshChoice;
  dim: number;
  options: Options;
  targetCells: number | null;
  compare: string;
  running: boolean;
  /** A run is over, and another moment of it is shown than the end. */
  behind: boolean;
  summary: string;
}

export interface Setup {
  element: HTMLElement;
  formula: FormulaField;
  /** Where the panel for sketching goes. */
  sketchPlace: HTMLElement;
  setCases(cases: readonly Case[]): void;
  update(state: SetupState): void;
  /** What the run is doing, or how it ended. */
  setStatus(text: string): void;
  openFileDialog(): void;
}

export const meshEndings = ['.mesh', '.msh', '.vtk', '.vtu'] as const;

interface Choice {
  value: string;
  label: string;
}

/** The options by the method that they belong to; those without one are always shown. */
const optionFields: readonly {
  name: OptionName;
  label: string;
  hint: string;
  choices?: readonly Choice[];
  method?: 'paper' | 'full';
}[] = [
  {
    name: 'method',
    label: 'Method',
    hint: 'The paper refines. Full adaptation of quads also coarsens, reconnects and aligns, and follows every change.',
    choices: [
      { value: 'paper', label: 'the paper’s' },
      { value: 'full', label: 'full, live' },
    ],
  },
  {
    name: 'effort',
    label: 'Effort',
    hint: 'How long better meshes are searched for.',
    choices: ['fast', 'normal', 'best'].map((value) => ({ value, label: value })),
    method: 'full',
  },
  {
    name: 'align',
    label: 'Align',
    hint: 'Edges follow the directions of the metric.',
    choices: [
      { value: '0', label: 'no' },
      { value: '0.5', label: 'somewhat' },
      { value: '1', label: 'yes' },
    ],
    method: 'full',
  },
  {
    name: 'smooth',
    label: 'Smooth',
    hint: 'When vertices are moved to even out sizes.',
    choices: [
      { value: 'none', label: 'never' },
      { value: 'end', label: 'at the end' },
      { value: 'between', label: 'between iterations' },
    ],
    method: 'paper',
  },
  {
    name: 'dice',
    label: 'Dice',
    hint: 'Refine coarsely, then split every cell.',
    choices: [
      { value: '1', label: 'no' },
      { value: '2', label: '2 × 2' },
      { value: '3', label: '3 × 3' },
    ],
    method: 'paper',
  },
  {
    name: 'thickness',
    label: 'Thickness',
    hint: 'Cells across a layer.',
    choices: ['1', '2', '3'].map((value) => ({ value, label: value })),
    method: 'paper',
  },
  {
    name: 'augment',
    label: 'Augment',
    hint: 'Cells added at the ends of each layer: 1 in 2D and none in 3D, if automatic.',
    choices: ['auto', '0', '1', '2'].map((value) => ({ value, label: value === 'auto' ? 'automatic' : value })),
    method: 'paper',
  },
  { name: 'threshold', label: 'Threshold', hint: 'Edges longer than this in the metric are tagged.' },
];

function optionControl(
  spec: (typeof optionFields)[number],
  change: SetupActions['changeOption'],
): HTMLInputElement | HTMLSelectElement {
  const { name, choices } = spec;
  const id = `option-${name}`;
  if (!choices) {
    const input = h('input', {
      id,
      type: 'number',
      min: 1,
      max: 10,
      step: 0.1,
      onchange: () => change(name, input.value),
    });
    return input;
  }
  const select = h(
    'select',
    { id, onchange: () => change(name, select.value) },
    ...choices.map(({ value, label }) => h('option', { value }, label)),
  );
  return select;
}

export function makeSetup(actions: SetupActions): Setup {
  const caseSelect = h('select', { id: 'case', onchange: () => actions.chooseCase(caseSelect.value) });
  const formula = makeFormulaField(actions.changeFormula);
  const grid = h('input', {
    id: 'grid',
    type: 'text',
    spellcheck: 'false',
    autocomplete: 'off',
    onchange: () => actions.chooseGrid(grid.value.trim()),
  });
  const fileInput = h('input', {
    type: 'file',
    accept: [...meshEndings, '.sol', 'image/*'].join(','),
    class: 'unseen',
    tabindex: -1,
    'aria-label': 'Mesh file',
    onchange: () => {
      const file = fileInput.files?.[0];
      fileInput.value = '';
      if (file) actions.chooseFile(file);
    },
  });
  const button = (name: IconName, label: string, title: string, action: () => void): HTMLButtonElement =>
    h('button', { type: 'button', class: 'plain', title, onclick: action }, icon(name), label);
  const paper = h(
    'div',
    { class: 'figures', role: 'group', 'aria-labelledby': 'figures-title' },
    h('span', { id: 'figures-title' }, 'The paper’s figures'),
    ...figures.map((figure) =>
      h(
        'button',
        {
          type: 'button',
          class: 'mini',
          'aria-label': `Fig. ${figure.number}`,
          title: `Figure ${figure.number}: ${figure.title}`,
          onclick: () => actions.chooseFigure(figure),
        },
        figure.number,
      ),
    ),
  );
  const thumbs = pictured.map(({ name, label }) => {
    const picture = h('span', { class: 'thumb' });
    const choose = (): void => actions.chooseCase(name);
    return h('button', { type: 'button', 'data-case': name, 'aria-pressed': 'false', onclick: choose }, picture, label);
  });
  const sketchPlace = h('div', { class: 'sketch-place' });
  const cells = h('input', {
    id: 'target-cells',
    type: 'number',
    min: 1,
    step: 1,
    placeholder: 'as the metric says',
    onchange: () => actions.changeTarget(cells.value ? Math.max(1, Number(cells.value)) : null),
  });
  const rival = h(
    'select',
    { id: 'compare', onchange: () => actions.compareWith(rival.value) },
    ...rivals.map(({ value, label }) => h('option', { value }, label)),
  );
  const summary = h('p', { class: 'hint', id: 'mesh-summary' });
  const controls = Object.fromEntries(
    optionFields.map((spec) => [spec.name, optionControl(spec, actions.changeOption)]),
  ) as Record<OptionName, HTMLInputElement | HTMLSelectElement>;
  const run = h('button', { type: 'button', class: 'primary wide', id: 'run' });
  let running = false;
  run.addEventListener('click', () => (running ? actions.stop() : actions.run()));
  const status = h('p', { class: 'status', role: 'status' });
  const toEnd = h('button', { type: 'button', class: 'mini', hidden: true, onclick: () => actions.showEnd() }, 'Show the end');

  const rows = Object.fromEntries(
    optionFields.map(({ name, label, hint }) => {
      const row = field(label, controls[name], hint);
      row.classList.add('inline');
      return [name, row];
    }),
  ) as Record<OptionName, HTMLElement>;
  const number = field('Cells', cells, 'Sizes are scaled to make so many.');
  number.classList.add('inline');
  const { method, effort, align, smooth, ...others } = rows;

  const element = h(
    'aside',
    { class: 'panel setup', 'aria-label': 'Set up' },
    h('h2', {}, 'Mesh and metric'),
    h('div', { class: 'gallery', role: 'group', 'aria-label': 'Pictured cases' }, ...thumbs),
    h('div', { class: 'field' }, h('label', { for: 'case', class: 'unseen' }, 'Case'), caseSelect, summary),
    formula.element,
    h(
      'div',
      { class: 'own', role: 'group', 'aria-label': 'A metric or mesh of your own' },
      button('brush', 'Draw', 'Draw where cells are to be small', actions.sketch),
      button('open', 'Open', `Open a mesh (${meshEndings.join(', ')}), a picture, a metric (.sol) (O)`, () => fileInput.click()),
      button('camera', 'Camera', 'A picture from the camera as the metric', actions.takePicture),
    ),
    h('p', { class: 'hint' }, 'Or drop a mesh, a picture or a metric (.sol) anywhere. It stays in your browser.'),
    sketchPlace,
    fileInput,
    paper,
    h('h2', {}, 'Method'),
    method,
    effort,
    align,
    smooth,
    number,
    h('details', { class: 'group' }, h('summary', {}, 'More options'), ...Object.values(others)),
    h('details', { class: 'group' }, h('summary', {}, 'Another initial grid'), field('Grid', grid, 'grid:NX,NY:X0,X1,Y0,Y1')),
    field('Compare with', rival),
    h('div', { class: 'run-box' }, run, h('div', { class: 'outcome' }, status, toEnd)),
  );

  return {
    element,
    formula,
    sketchPlace,
    setCases(cases) {
      const group = (dim: number): HTMLElement =>
        h(
          'optgroup',
          { label: dim === 2 ? 'Quadrilaterals' : 'Hexahedra' },
          ...cases.filter((c) => c.dim === dim).map((c) => h('option', { value: c.name }, `${c.name}: ${c.title}`)),
        );
      const own = h('option', { value: '', hidden: true }, 'Your own mesh');
      // Pictures come after what the first frame needs.
      for (const { dataset, firstChild } of thumbs)
        (firstChild as HTMLElement).style.maskImage = `url("./cases/${dataset.case}.svg")`;
      caseSelect.replaceChildren(own, ...[2, 3].filter((dim) => cases.some((c) => c.dim === dim)).map(group));
    },
    update(state) {
      caseSelect.value = state.mesh.kind === 'case' ? state.mesh.name : '';
      for (const thumb of thumbs) thumb.setAttribute('aria-pressed', String(thumb.dataset.case === caseSelect.value));
      summary.textContent = state.summary;
      if (document.activeElement !== grid) grid.value = state.mesh.kind === 'grid' ? state.mesh.spec : '';
      const full = state.options.method === 'full' && state.dim === 2; // hexahedra have the paper's method alone
      for (const { name, method } of optionFields) {
        controls[name].value = state.options[name];
        rows[name].hidden = method !== undefined && (method === 'full') !== full;
      }
      if (document.activeElement !== cells) cells.value = state.targetCells === null ? '' : String(state.targetCells);
      rival.value = state.compare;
      running = state.running;
      run.textContent = running ? 'Stop' : 'Run';
      run.classList.toggle('stop', running);
      toEnd.hidden = !state.behind;
    },
    setStatus(text) {
      status.textContent = text;
    },
    openFileDialog: () => fileInput.click(),
  };
}
