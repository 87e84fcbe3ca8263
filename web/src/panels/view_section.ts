// The picture with what stands around it: tools, panel for hexahedra, caption, playback.
import { h } from '../ui/dom.ts';
import { icon } from '../ui/icons.ts';
import type { PictureTools } from './picture_tools.ts';
import type { Transport } from './transport.ts';

/** The large button over a picture that nothing has been done to. */
export const makeStartButton = (action: () => void): HTMLButtonElement =>
  h('button', { type: 'button', class: 'start', 'aria-label': 'Play', onclick: action }, icon('play'));

export interface ViewParts {
  tools: PictureTools;
  picture: HTMLElement;
  /** Laid over the picture. */
  over: HTMLElement[];
  inside: HTMLElement;
  transport: Transport;
}

export function makeViewSection({ tools, picture, over, inside, transport }: ViewParts): HTMLElement {
  return h(
    'section',
    { class: 'view', 'aria-label': 'Picture' },
    h('div', { class: 'frame' }, tools.element, h('div', { class: 'stage' }, picture, tools.legend, ...over), inside),
    transport.caption,
    transport.element,
  );
}
