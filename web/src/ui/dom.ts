// Building elements without a framework.

type Child = Node | string | null | undefined | false;

/** Attributes by name; a function under `onclick`, `oninput`, ... is a listener; false and null leave out. */
export type Attributes = Record<string, string | number | boolean | null | undefined | ((event: never) => void)>;

function assign(element: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === 'function') element.addEventListener(name.slice(2), value as EventListener);
    else element.setAttribute(name, value === true ? '' : String(value));
  }
}

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  assign(element, attributes);
  element.append(...children.filter((c): c is Node | string => Boolean(c)));
  return element;
}

export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  assign(element, attributes);
  element.append(...children.filter((c): c is Node | string => Boolean(c)));
  return element;
}

/** A labelled form row: the label above or beside its control, an explanation below. */
export function field(label: string, control: HTMLElement, hint?: string): HTMLElement {
  const id = (control.id ||= `field-${label.toLowerCase().replace(/\W+/g, '-')}`);
  const hintId = `${id}-hint`;
  if (hint) control.setAttribute('aria-describedby', hintId);
  return h(
    'div',
    { class: 'field' },
    h('label', { for: id }, label),
    control,
    hint ? h('p', { class: 'hint', id: hintId }, hint) : null,
  );
}

/** Calls `action` once, `wait` milliseconds after the last of a burst of calls. */
export function debounce<A extends unknown[]>(wait: number, action: (...args: A) => void): (...args: A) => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  return (...args) => {
    clearTimeout(timer);
    timer = setTimeout(() => action(...args), wait);
  };
}

/** Puts a dialog into the page until it is closed. */
export function showOnce(dialog: HTMLDialogElement): HTMLDialogElement {
  document.body.append(dialog);
  dialog.addEventListener('close', () => dialog.remove());
  return dialog;
}

/** "1,402": `toLocaleString` would load the browser's tables of all languages first. */
export const grouped = (count: number): string => String(count).replace(/\B(?=(\d{3})+$)/g, ',');
