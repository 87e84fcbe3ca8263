// The code that puts what is shown into another page: as the element, as a frame, or in Markdown.
import '../../style/dialogs.css';
import { h } from '../ui/dom.ts';

export const snippetKinds = ['element', 'frame', 'markdown'] as const;
export type SnippetKind = (typeof snippetKinds)[number];

export interface SnippetWishes {
  kind: SnippetKind;
  controls: string;
  theme: string;
  autoplay: boolean;
}

const escape = (text: string): string =>
  text.replace(/[&"<>\n]/g, (c) => ({ '&': '&amp;', '"': '&quot;', '<': '&lt;', '>': '&gt;', '\n': '&#10;' })[c]!);

/**
 * `link` is the state as part of an address, `site` the address of the page's folder, `words` what is shown in a
 * sentence.
 */
export function snippetOf(wishes: SnippetWishes, link: string, site: string, words: string): string {
  const behaviour: [string, string][] = [];
  if (wishes.controls !== 'full') behaviour.push(['controls', wishes.controls]);
  if (wishes.theme !== 'auto') behaviour.push(['theme', wishes.theme]);
  if (wishes.autoplay) behaviour.push(['autoplay', '']);
  const state = [...new URLSearchParams(link)];
  if (wishes.kind === 'element') {
    const attributes = [...state, ...behaviour]
      .map(([name, value]) => [name === 'file' ? 'src' : name, value])
      .map(([name, value]) => (value === '' ? ` ${name}` : ` ${name}="${escape(value)}"`));
    return (
      `<script type="module" src="${escape(site)}pillow-mesh.js"></script>\n` +
      `<pillow-mesh${attributes.join('')}>${escape(words)}</pillow-mesh>`
    );
  }
  const query = new URLSearchParams([...state, ...behaviour]).toString();
  if (wishes.kind === 'frame')
    return (
      `<iframe src="${escape(`${site}embed.html#${query}`)}" title="${escape(words)}"\n` +
      `  style="width: 100%; min-height: 480px; aspect-ratio: 10 / 9; border: 0" loading="lazy" allowfullscreen></iframe>`
    );
  return `[${words.replace(/[[\]]/g, '')}](${site}index.html#${link.replace(/[()]/g, encodeURIComponent)})`;
}

export interface EmbedDialog {
  element: HTMLDialogElement;
  /** Opens with the code for a state. */
  show(link: string, words: string): void;
}

const kindLabels: Record<SnippetKind, string> = { element: 'Element', frame: 'Frame', markdown: 'Markdown link' };
const kindHints: Record<SnippetKind, string> = {
  element: 'For your own pages. Several on a page share one core; each loads when it comes into sight.',
  frame: 'For course systems. It tells the page around it how high it is (lti.frameResize, iframe-resizer).',
  markdown: 'A link to this page in exactly this state.',
};

export function makeEmbedDialog(copied: (done: boolean) => void): EmbedDialog {
  let state = { link: '', words: '' };
  const select = (id: string, label: string, choices: [string, string][]): HTMLSelectElement =>
    h('select', { id, 'aria-label': label, onchange: () => write() }, ...choices.map(([value, text]) => h('option', { value }, text)));
  const kinds = snippetKinds.map((kind) =>
    h('input', { type: 'radio', name: 'snippet', value: kind, checked: kind === 'element', onchange: () => write() }),
  );
  const controls = select('embed-controls', 'Controls', [
    ['full', 'all controls'],
    ['step', 'single steps'],
    ['none', 'no controls'],
  ]);
  const theme = select('embed-theme', 'Theme', [
    ['auto', 'theme of the page'],
    ['light', 'light'],
    ['dark', 'dark'],
  ]);
  const autoplay = h('input', { type: 'checkbox', onchange: () => write() });
  const code = h('textarea', { class: 'code', readonly: true, rows: 7, 'aria-label': 'Code', spellcheck: 'false' });
  const hint = h('p', { class: 'hint' });
  const wishes = h('div', { class: 'row' }, controls, theme, h('label', { class: 'check' }, autoplay, 'plays by itself'));
  const write = (): void => {
    const kind = (kinds.find((input) => input.checked)?.value ?? 'element') as SnippetKind;
    hint.textContent = kindHints[kind];
    wishes.hidden = kind === 'markdown';
    code.value = snippetOf(
      { kind, controls: controls.value, theme: theme.value, autoplay: autoplay.checked },
      state.link,
      new URL('./', location.href).href,
      state.words,
    );
  };
  const copy = h(
    'button',
    {
      type: 'button',
      class: 'primary',
      onclick: async () => {
        code.select();
        try {
          await navigator.clipboard.writeText(code.value);
          copied(true);
        } catch {
          copied(false);
        }
      },
    },
    'Copy',
  );
  const element = h(
    'dialog',
    { class: 'help-dialog', 'aria-labelledby': 'embed-title' },
    h('h2', { id: 'embed-title' }, 'Embed what is shown'),
    h(
      'fieldset',
      { class: 'segments' },
      h('legend', { class: 'unseen' }, 'Kind of code'),
      ...kinds.map((input, i) => h('label', {}, input, h('span', {}, kindLabels[snippetKinds[i]]))),
    ),
    hint,
    wishes,
    code,
    h(
      'form',
      { method: 'dialog', class: 'row' },
      copy,
      h('button', { class: 'plain', value: 'close' }, 'Close'),
    ),
  );
  element.addEventListener('click', (event) => {
    if (event.target === element) element.close();
  });
  return {
    element,
    show(link, words) {
      state = { link, words };
      write();
      element.showModal();
    },
  };
}
