// What the page shows, and its keys.
import '../../style/dialogs.css';
import { h } from '../ui/dom.ts';

const keys: readonly [string, string][] = [
  ['Space', 'play, pause'],
  ['← →', 'step back, step forward'],
  ['Shift ← →', 'previous, next iteration'],
  ['Home End', 'initial mesh, last mesh'],
  ['+ −', 'faster, slower'],
  ['T L H B M', 'tags, layer, hull, buffer layer, metric'],
  ['C', 'colour of the cells'],
  ['I', 'look inside a mesh of hexes'],
  ['X Y Z', 'cut it across an axis, then from the other side'],
  ['E', 'its irregular edges'],
  ['Delete N', 'hide the hex that was clicked, show it with its neighbours alone'],
  ['F W', 'show the whole mesh, the worst cell'],
  ['Ctrl ← → ↑ ↓', 'move the picture, turn hexes'],
  [', .', 'zoom out, zoom in'],
  ['Ctrl+Z Ctrl+Y', 'undo, redo'],
  ['O', 'open a mesh file'],
  ['?', 'this help'],
];

export function makeHelp(version: () => string): HTMLDialogElement {
  const about = h('p', { class: 'hint' });
  const dialog = h(
    'dialog',
    { class: 'help-dialog', 'aria-labelledby': 'help-title' },
    h('h2', { id: 'help-title' }, 'How to read the picture'),
    h(
      'p',
      {},
      'A metric says how large, how stretched and in which direction cells should be at every point. ' +
        'Measured in it, a perfect edge has length 1. ' +
        'Edges that are much too long are tagged. Cells joined through parallel tagged edges form a layer; the layer ' +
        'is shrunk, and a buffer layer of new cells fills the gap. ' +
        'This is repeated until no edge is too long, and the mesh never has a hanging node on the way.',
    ),
    h('h2', {}, 'Keys'),
    h(
      'dl',
      { class: 'keys' },
      ...keys.flatMap(([key, what]) => [h('dt', {}, ...key.split(' ').map((k) => h('kbd', {}, k))), h('dd', {}, what)]),
    ),
    h('p', {}, 'Drag to move (a mesh of hexes: to turn), wheel or pinch to zoom, double-click for the whole mesh.'),
    about,
    h('form', { method: 'dialog' }, h('button', { class: 'primary', value: 'close' }, 'Close')),
  );
  dialog.addEventListener(
    'toggle',
    () => (about.textContent = `pillowmesh ${version()}. Everything is computed in your browser; nothing leaves it.`),
  );
  dialog.addEventListener('click', (event) => {
    if (event.target === dialog) dialog.close();
  });
  return dialog;
}
