// What to adapt and how: case or mesh, metric, options, run.
import type { Case } from '../../../wasm/session.ts';
import { figures, type Figure } from '../data/figures.ts';
import { rivals } from '../data/rivals.ts';
import type { MeshChoice, OptionName, Options } from '../state/settings.ts';
import { field, h } from '../ui/dom.ts';
import { icon } from '../ui/icons.ts';
import { makeFormulaField, type FormulaField } from './formula.ts';

export interface SetupActions {
  chooseCase(name: string): void;
  chooseFigure(figure: Figure): void;
  chooseGrid(spec: string): void;
  chooseFile(file: File): void;
  takePicture(): void;
  changeFormula(text: string): void;
  changeOption(name: OptionName, value: string): void;
  compareWith(rival: string): void;
  sketch(): void;
  run(): void;
  stop(): void;
}

export interface Setup {
  element: HTMLElement;
  formula: FormulaField;
  /** Where the panel for sketching goes. */
  sketchPlace: HTMLElement;
  setCases(cases: readonly Case[]): void;
  update(state: { mesh: MeshChoice; options: Options; compare: string; running: boolean; summary: string }): void;
  /** What the run is doing, or how it ended. */
  setStatus(text: string): void;
  openFileDialog(): void;
}

export const meshEndings = ['.mesh', '.msh', '.vtk', '.vtu'] as const;

interface Choice {
  value: string;
  label: string;
}

const optionFields: readonly { name: OptionName; label: string; hint: string; choices?: readonly Choice[] }[] = [
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
    hint: 'How long full adaptation searches.',
    choices: ['fast', 'normal', 'best'].map((value) => ({ value, label: value })),
  },
  {
    name: 'align',
    label: 'Align',
    hint: 'Full adaptation: edges follow the directions of the metric.',
    choices: [
      { value: '0', label: 'no' },
      { value: '0.5', label: 'somewhat' },
      { value: '1', label: 'yes' },
    ],
  },
  { name: 'threshold', label: 'Threshold', hint: 'Edges longer than this in the metric are tagged.' },
  {
    name: 'smooth',
    label: 'Smooth',
    hint: 'When vertices are moved to even out sizes.',
    choices: [
      { value: 'none', label: 'never' },
      { value: 'end', label: 'at the end' },
      { value: 'between', label: 'between iterations' },
    ],
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
  },
  {
    name: 'thickness',
    label: 'Thickness',
    hint: 'Cells across a layer.',
    choices: ['1', '2', '3'].map((value) => ({ value, label: value })),
  },
  {
    name: 'augment',
    label: 'Augment',
    hint: 'Cells added at the ends of each layer: 1 in 2D and none in 3D, if automatic.',
    choices: ['auto', '0', '1', '2'].map((value) => ({ value, label: value === 'auto' ? 'automatic' : value })),
  },
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
  const openFile = h(
    'button',
    { type: 'button', class: 'plain wide', onclick: () => fileInput.click() },
    icon('open'),
    'Open a mesh, a picture, a metric',
  );
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
          title: `Figure ${figure.number}: ${figure.title}`,
          onclick: () => actions.chooseFigure(figure),
        },
        `Fig. ${figure.number}`,
      ),
    ),
  );
  const sketchPlace = h(
    'div',
    { class: 'sketch-place' },
    h(
      'button',
      { type: 'button', class: 'plain wide', onclick: () => actions.sketch() },
      icon('brush'),
      'Sketch it instead',
    ),
  );
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

  const element = h(
    'aside',
    { class: 'panel setup', 'aria-label': 'Set up' },
    h('h2', {}, 'Mesh and metric'),
    field('Case', caseSelect),
    summary,
    paper,
    formula.element,
    sketchPlace,
    h(
      'details',
      { class: 'group' },
      h('summary', {}, 'Another initial mesh'),
      openFile,
      fileInput,
      h('button', { type: 'button', class: 'plain wide', onclick: () => actions.takePicture() }, icon('camera'), 'Take a picture'),
      h('p', { class: 'hint' }, `Or drop a file anywhere: ${meshEndings.join(', ')}. It stays in your browser.`),
      field('Grid', grid, 'grid:NX,NY:X0,X1,Y0,Y1'),
    ),
    h(
      'details',
      { class: 'group', open: matchMedia('(min-width: 1080px)').matches },
      h('summary', {}, 'Options of the method'),
      ...optionFields.map(({ name, label, hint }) => {
        const row = field(label, controls[name], hint);
        row.classList.add('inline');
        return row;
      }),
    ),
    field('Compare with', rival),
    h('div', { class: 'run-box' }, run, status),
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
      caseSelect.replaceChildren(own, ...[2, 3].filter((dim) => cases.some((c) => c.dim === dim)).map(group));
    },
    update(state) {
      caseSelect.value = state.mesh.kind === 'case' ? state.mesh.name : '';
      summary.textContent = state.summary;
      if (document.activeElement !== grid) grid.value = state.mesh.kind === 'grid' ? state.mesh.spec : '';
      for (const { name } of optionFields) controls[name].value = state.options[name];
      rival.value = state.compare;
      running = state.running;
      run.textContent = running ? 'Stop' : 'Run';
      run.classList.toggle('stop', running);
    },
    setStatus(text) {
      status.textContent = text;
    },
    openFileDialog: () => fileInput.click(),
  };
}
