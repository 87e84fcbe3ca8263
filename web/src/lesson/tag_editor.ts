// Tags set by hand: a small grid whose edges can be clicked. The core takes no tags but finds them from a metric; so each
// edge gets a spot in which the metric is fine along it, and along nothing else.
import { PillowMeshElement } from '../element/pillow_mesh.ts';
import { svg } from '../ui/dom.ts';

/** An edge of the grid of unit squares: along x (0) or y (1), from vertex (i, j). */
export interface Edge {
  axis: 0 | 1;
  i: number;
  j: number;
}

/** Half the width of a spot: two spots on neighbouring edges do not touch. */
const reach = 0.24;
/** Size within it: an edge with a spot measures 2 reach / fine + (1 - 2 reach), above any usual threshold. */
const fine = 0.12;

/** A formula by which exactly these edges are long: all others measure 1. */
export function formulaOf(edges: readonly Edge[]): string {
  const size = (axis: 0 | 1): string => {
    const distances = edges
      .filter((edge) => edge.axis === axis)
      .map(({ i, j }) => {
        const [x, y] = axis === 0 ? [i + 0.5, j] : [i, j + 0.5];
        return `max(abs(x - ${x}), abs(y - ${y}))`;
      });
    if (distances.length === 0) return '1';
    return `if(${distances.reduce((all, one) => `min(${all}, ${one})`)} < ${reach}, ${fine}, 1)`;
  };
  return `h1 = ${size(0)}; h2 = ${size(1)}; theta = 0`;
}

/** `<div class="tag-editor" data-figure="id" data-grid="5,4" data-tags="1:2,0 1:2,1">` gets the grid. */
export function makeTagEditor(box: HTMLElement): void {
  const [nx, ny] = (box.dataset.grid ?? '4,4').split(',').map(Number);
  const figure = document.getElementById(box.dataset.figure ?? '');
  const edges: { edge: Edge; rect: SVGRectElement }[] = [];
  const picture = svg('svg', { viewBox: `-0.3 -0.3 ${nx + 0.6} ${ny + 0.6}`, role: 'group', 'aria-label': 'Edges to tag; arrow keys move, space tags' });

  const add = (edge: Edge): void => {
    const { axis, i, j } = edge;
    const [x, y] = [i, ny - j - (axis === 1 ? 1 : 0)];
    const thick = 0.17;
    picture.append(
      svg('line', { x1: x, y1: y, x2: x + (axis === 0 ? 1 : 0), y2: y + axis, 'vector-effect': 'non-scaling-stroke' }),
    );
    const rect = svg('rect', {
      x: axis === 0 ? x + 0.14 : x - thick / 2,
      y: axis === 0 ? y - thick / 2 : y + 0.14,
      width: axis === 0 ? 0.72 : thick,
      height: axis === 0 ? thick : 0.72,
      rx: 0.08,
      role: 'checkbox',
      tabindex: edges.length === 0 ? 0 : -1,
      'aria-checked': 'false',
      'aria-label': `${axis === 0 ? 'horizontal' : 'vertical'} edge, column ${i + 1}, row ${j + 1}`,
    });
    rect.addEventListener('click', () => toggle(rect));
    edges.push({ edge, rect });
  };
  for (let j = 0; j <= ny; ++j) for (let i = 0; i < nx; ++i) add({ axis: 0, i, j });
  for (let j = 0; j < ny; ++j) for (let i = 0; i <= nx; ++i) add({ axis: 1, i, j });
  picture.append(...edges.map(({ rect }) => rect)); // above all lines
  box.prepend(picture);

  const chosen = (): Edge[] =>
    edges.filter(({ rect }) => rect.getAttribute('aria-checked') === 'true').map(({ edge }) => edge);
  function toggle(rect: SVGRectElement): void {
    rect.setAttribute('aria-checked', String(rect.getAttribute('aria-checked') !== 'true'));
    show();
  }
  function show(): void {
    if (!(figure instanceof PillowMeshElement)) return;
    figure.setAttribute('metric', formulaOf(chosen()));
    figure.setAttribute('event', chosen().length > 0 ? '1' : '0');
  }
  const tag = (list: string): void => {
    const wanted = new Set(list.split(' '));
    for (const { edge, rect } of edges)
      rect.setAttribute('aria-checked', String(wanted.has(`${edge.axis}:${edge.i},${edge.j}`)));
    show();
  };

  picture.addEventListener('keydown', (event) => {
    const { key } = event;
    const at = edges.findIndex(({ rect }) => rect === event.target);
    if (at < 0) return;
    if (key === ' ' || key === 'Enter') toggle(edges[at].rect);
    else if (!key.startsWith('Arrow')) return;
    else edges[nearest(at, key)]?.rect.focus();
    event.preventDefault();
  });
  picture.addEventListener('focusin', (event) => {
    for (const { rect } of edges) rect.setAttribute('tabindex', rect === event.target ? '0' : '-1');
  });

  /** The next edge in the direction of an arrow key. */
  function nearest(from: number, key: string): number {
    const middle = ({ axis, i, j }: Edge): [number, number] => (axis === 0 ? [i + 0.5, j] : [i, j + 0.5]);
    const [x, y] = middle(edges[from].edge);
    const [dx, dy] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[key] ?? [0, 0];
    let best = from;
    let least = Infinity;
    edges.forEach(({ edge }, k) => {
      const [p, q] = middle(edge);
      const along = (p - x) * dx + (q - y) * dy;
      const across = Math.abs((p - x) * dy) + Math.abs((q - y) * dx);
      if (along > 0.1 && along + 2.1 * across < least) [best, least] = [k, along + 2.1 * across];
    });
    return best;
  }

  for (const button of document.querySelectorAll<HTMLButtonElement>(`button[data-tags][data-for="${box.id}"]`))
    button.addEventListener('click', () => tag(button.dataset.tags ?? ''));
  if (box.dataset.tags) tag(box.dataset.tags);
}
