// The metric formula: typed, checked while typing, mistakes shown where they are.
import { h } from '../ui/dom.ts';

export interface FormulaField {
  element: HTMLElement;
  /** Replaces the text, e.g. by that of another case; not called back. */
  setText(text: string): void;
  text(): string;
  /** The mistake in the present text, or null. A column in the sentence is pointed at. */
  setError(message: string | null): void;
}

/** "column 12: unknown name" -> 12; null when the sentence names no column. */
export function columnOf(message: string): number | null {
  const found = /\bcolumn (\d+)\b/.exec(message);
  return found ? Number(found[1]) : null;
}

/** The line that holds a column of the whole text (a line break counts as one), and the column within it. */
export function locate(text: string, column: number): { line: string; offset: number } {
  const at = Math.min(column - 1, text.length);
  const start = text.lastIndexOf('\n', at - 1) + 1;
  const end = text.indexOf('\n', at);
  return { line: text.slice(start, end < 0 ? undefined : end), offset: at - start };
}

const context = 22;

/** The surroundings of a mistake with the character marked. */
function excerpt(text: string, column: number): HTMLElement {
  const { line, offset } = locate(text, column);
  const start = Math.max(0, offset - context);
  return h(
    'code',
    { class: 'excerpt' },
    (start > 0 ? '…' : '') + line.slice(start, offset),
    h('mark', {}, line[offset] ?? '\u2423'),
    line.slice(offset + 1, offset + context),
  );
}

export function makeFormulaField(onInput: (text: string) => void): FormulaField {
  const area = h('textarea', {
    id: 'formula',
    rows: 4,
    spellcheck: 'false',
    autocapitalize: 'off',
    autocomplete: 'off',
    'aria-describedby': 'formula-error',
    oninput: () => {
      resize();
      onInput(area.value);
    },
  });
  const error = h('div', { class: 'mistake', id: 'formula-error', 'aria-live': 'polite' });
  const resize = (): void => {
    area.style.height = 'auto';
    area.style.height = `${Math.min(150, area.scrollHeight + 2)}px`;
  };
  const element = h(
    'div',
    { class: 'field' },
    h('label', { for: 'formula' }, 'Metric: the size of cell wanted at each point'),
    area,
    error,
    h(
      'details',
      { class: 'help' },
      h('summary', {}, 'What can be written here?'),
      h('p', {}, 'Statements name = expression; separated by semicolons. One of these sets must be given:'),
      h(
        'ul',
        {},
        h('li', {}, h('code', {}, 'h'), ', one size for all directions'),
        h(
          'li',
          {},
          h('code', {}, 'h1'),
          ', ',
          h('code', {}, 'h2'),
          ' and ',
          h('code', {}, 'theta'),
          ', the angle of the first; in 3D also ',
          h('code', {}, 'h3'),
          ', ',
          h('code', {}, 'phi'),
        ),
        h('li', {}, h('code', {}, 'm11 m12 m22'), ', the tensor itself; in 3D also ', h('code', {}, 'm13 m23 m33')),
      ),
      h(
        'p',
        {},
        'x, y, z, r = |(x, y, z)|, pi, + − * / ^, comparisons, if(c, a, b), ' +
          'sqrt exp log sin cos tan atan atan2 asin acos tanh abs min max pow floor.',
      ),
    ),
  );
  return {
    element,
    setText(text) {
      if (area.value !== text) area.value = text;
      resize();
    },
    text: () => area.value,
    setError(message) {
      area.setAttribute('aria-invalid', String(message !== null));
      if (message === null) {
        error.replaceChildren();
        return;
      }
      const column = columnOf(message);
      error.replaceChildren(h('p', {}, message), ...(column ? [excerpt(area.value, column)] : []));
    },
  };
}
