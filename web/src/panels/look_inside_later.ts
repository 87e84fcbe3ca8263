// The panel of hexahedral meshes, loaded when there is one; until then there is its button, which 2D does not show.
import type { Inside } from '../inside/look_inside.ts';
import { looksInside } from '../inside/look_inside.ts';
import { h } from '../ui/dom.ts';
import { icon } from '../ui/icons.ts';
import type { InsidePanel, InsideReport, LookInsideActions } from './look_inside.ts';

export interface LookInside {
  /** Shows and hides the panel. */
  toggle: HTMLButtonElement;
  element: HTMLElement;
  update(inside: Inside, dim: number): void;
  setReport(report: InsideReport): void;
  setOpen(open: boolean): void;
  isOpen(): boolean;
  /** Cuts across an axis; once more: from the other side. */
  cutAcross(axis: 0 | 1 | 2): void;
  /** Takes the picked cell away, or leaves it and its neighbours alone. */
  isolate(how: 'without' | 'around'): void;
}

export function makeLookInside(actions: LookInsideActions): LookInside {
  let panel: Promise<InsidePanel> | null = null;
  let open = false;
  let dimension = 2;
  let last: Inside | null = null;
  const element = h('div', { class: 'inside-place' });
  const load = (): Promise<InsidePanel> =>
    (panel ??= import('./look_inside.ts').then((module) => {
      const made = module.makeInsidePanel(actions);
      element.append(made.element);
      return made;
    }));
  const show = (): void => {
    toggle.setAttribute('aria-expanded', String(open));
    if (dimension === 3)
      void load().then((made) => {
        made.element.hidden = !open || dimension === 2;
        if (last) made.update(last);
      });
    else void panel?.then((made) => (made.element.hidden = true));
  };
  const setOpen = (next: boolean): void => {
    open = next;
    show();
  };
  const toggle = h(
    'button',
    {
      type: 'button',
      class: 'chip inside-toggle',
      title: 'Cut, peel and filter the cells (I)',
      'aria-expanded': 'false',
      'aria-controls': 'inside',
      hidden: true,
      onclick: () => setOpen(!open),
    },
    icon('inside'),
    'Look inside',
  );
  return {
    toggle,
    element,
    setOpen,
    isOpen: () => open,
    cutAcross: (axis) => void load().then((made) => made.cutAcross(axis)),
    isolate: (how) => void load().then((made) => made.isolate(how)),
    setReport: (report) => void load().then((made) => made.setReport(report)),
    update(inside, dim) {
      last = inside;
      dimension = dim;
      toggle.hidden = dim === 2;
      toggle.classList.toggle('active', looksInside(inside));
      show();
    },
  };
}
