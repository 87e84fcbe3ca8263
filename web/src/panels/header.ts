// The bar at the top: name, link, save, theme, help.
import { h, svg } from '../ui/dom.ts';
import { icon, type IconName } from '../ui/icons.ts';

export interface HeaderActions {
  copyLink(): void;
  embed(): void;
  undo(): void;
  redo(): void;
  save(what: SaveFormat): void;
  toggleTheme(): void;
  help(): void;
}

export const saveFormats = [
  { id: 'vtu', label: 'VTK .vtu', kind: 'mesh' },
  { id: 'vtk', label: 'VTK legacy .vtk', kind: 'mesh' },
  { id: 'msh', label: 'Gmsh .msh', kind: 'mesh' },
  { id: 'mesh', label: 'Medit .mesh', kind: 'mesh' },
  { id: 'png', label: 'Picture .png', kind: 'other' },
  { id: 'svg', label: 'Drawing .svg (quads)', kind: 'other' },
  { id: 'webm', label: 'Film of the run .webm', kind: 'other' },
  { id: 'json', label: 'Report .json', kind: 'other' },
] as const;
export type SaveFormat = (typeof saveFormats)[number]['id'];

function logo(): SVGSVGElement {
  return svg(
    'svg',
    { viewBox: '0 0 32 32', width: 26, height: 26, 'aria-hidden': 'true', class: 'logo' },
    svg('path', { d: 'M4 4h24v24H4z' }),
    svg('path', { d: 'M10 10h12v12H10z', class: 'pillow' }),
    svg('path', { d: 'M4 4l6 6M28 4l-6 6M4 28l6-6M28 28l-6-6' }),
  );
}

export interface Header {
  element: HTMLElement;
  update(state: { canUndo: boolean; canRedo: boolean }): void;
}

export function makeHeader(actions: HeaderActions): Header {
  const button = (name: IconName, label: string, action: () => void): HTMLButtonElement =>
    h(
      'button',
      { type: 'button', class: 'plain', title: label, onclick: action },
      icon(name),
      h('span', { class: 'wide-only' }, label),
    );
  const menu = h(
    'details',
    { class: 'menu' },
    h('summary', { class: 'plain', title: 'Save' }, icon('save'), h('span', { class: 'wide-only' }, 'Save')),
    h(
      'div',
      { class: 'menu-items' },
      h('p', { class: 'hint' }, 'The mesh as it is shown'),
      ...saveFormats.map(({ id, label }) =>
        h(
          'button',
          { type: 'button', 'data-format': id, onclick: () => ((menu.open = false), actions.save(id)) },
          label,
        ),
      ),
    ),
  );
  document.addEventListener('click', (event) => {
    if (!menu.contains(event.target as Node)) menu.open = false;
  });
  menu.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape') return;
    menu.open = false;
    menu.querySelector('summary')?.focus();
  });
  const undo = button('undo', 'Undo', actions.undo);
  const redo = button('redo', 'Redo', actions.redo);
  for (const once of [undo, redo]) once.querySelector('span')!.className = 'unseen';
  const element = h(
    'header',
    { class: 'top' },
    h('h1', {}, logo(), 'pillowmesh'),
    h('p', { class: 'tagline' }, 'Quad and hex meshes adapted to a metric, layer by layer'),
    h(
      'nav',
      { 'aria-label': 'Page' },
      undo,
      redo,
      h('a', { class: 'plain', href: './lessons/index.html', title: 'Lessons' }, icon('book'), h('span', { class: 'wide-only' }, 'Lessons')),
      button('link', 'Copy link', actions.copyLink),
      button('embed', 'Embed', actions.embed),
      menu,
      button('theme', 'Theme', actions.toggleTheme),
      button('help', 'Help', actions.help),
    ),
  );  return {
    element,
    update({ canUndo, canRedo }) {
      undo.setAttribute('aria-disabled', String(!canUndo));
      redo.setAttribute('aria-disabled', String(!canRedo));
    },
  };
}
