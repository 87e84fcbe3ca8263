// The few icons of the page, drawn on a 20 x 20 grid.
import { svg } from './dom.ts';

const paths = {
  play: 'M6 3.8v12.4a.8.8 0 0 0 1.2.7l10-6.2a.8.8 0 0 0 0-1.4l-10-6.2a.8.8 0 0 0-1.2.7z',
  pause: 'M5.5 3.5h3v13h-3zM11.5 3.5h3v13h-3z',
  back: 'M13.5 4l-6 6 6 6zM5 4h2v12H5z',
  forward: 'M6.5 4l6 6-6 6zM13 4h2v12h-2z',
  start: 'M16 4l-5.5 6 5.5 6zM10 4l-5.5 6 5.5 6zM3 4h1.5v12H3z',
  end: 'M4 4l5.5 6L4 16zM10 4l5.5 6-5.5 6zM15.5 4H17v12h-1.5z',
  fit: 'M3 3h5v2H5v3H3zM12 3h5v5h-2V5h-3zM3 12h2v3h3v2H3zM15 12h2v5h-5v-2h3z',
  full: 'M3 3h6v2H6.4L9 7.6 7.6 9 5 6.4V9H3zM17 17h-6v-2h2.6L11 12.4l1.4-1.4 2.6 2.6V11h2z',
  link: 'M8.2 11.8a3 3 0 0 0 4.2 0l3-3a3 3 0 0 0-4.2-4.2l-1 1M11.8 8.2a3 3 0 0 0-4.2 0l-3 3a3 3 0 0 0 4.2 4.2l1-1',
  save: 'M10 3v9M6 8.5l4 4 4-4M4 16.5h12',
  open: 'M3 16V4h5l2 2h7v10z',
  theme: 'M10 3a7 7 0 1 0 0 14zM10 3a7 7 0 0 1 0 14',
  help: 'M7.3 7.5a2.7 2.7 0 1 1 4 2.3c-.9.5-1.3 1-1.3 2M10 14.8v.2',
  inside: 'M3 6.5l7-3.5 7 3.5v7L10 17l-7-3.5zM3 6.5l7 3.5M10 10v7',
  book: 'M10 5c-1.8-1.3-4-1.7-7-1.5v11.5c3-.2 5.2.2 7 1.5 1.8-1.3 4-1.7 7-1.5V3.5c-3-.2-5.2.2-7 1.5zM10 5v11.5',
  brush: 'M16.5 3.5c-4 1.5-7.5 5-8.8 7.7l2.1 2.1c2.7-1.3 5.2-4.8 6.7-9.8zM7 12c-2 .2-2.6 1.6-2.8 3.6-.1.8-.6 1.2-1.2 1.4 2.6.6 6 .1 6.2-2.8',
  undo: 'M7.5 4L4 7.5 7.5 11M4 7.5h7.5a4.5 4.5 0 0 1 0 9H8',
  redo: 'M12.5 4L16 7.5 12.5 11M16 7.5H8.5a4.5 4.5 0 0 0 0 9H12',
  embed: 'M7 5.5L2.5 10 7 14.5M13 5.5l4.5 4.5-4.5 4.5',
  camera: 'M3 6h3.5L8 4h4l1.5 2H17v10H3zM10 8a2.8 2.8 0 1 0 0 5.6A2.8 2.8 0 0 0 10 8z',
  close: 'M5 5l10 10M15 5L5 15',
} as const;

export type IconName = keyof typeof paths;
const outlined = new Set<IconName>(['link', 'save', 'open', 'help', 'inside', 'book', 'brush', 'undo', 'redo', 'embed', 'camera', 'close']);

export function icon(name: IconName): SVGSVGElement {
  const stroke = outlined.has(name);
  return svg(
    'svg',
    { viewBox: '0 0 20 20', width: 20, height: 20, 'aria-hidden': 'true', class: 'icon' },
    svg('path', {
      d: paths[name],
      fill: stroke ? 'none' : 'currentColor',
      ...(stroke
        ? { stroke: 'currentColor', 'stroke-width': 1.7, 'stroke-linecap': 'round', 'stroke-linejoin': 'round' }
        : {}),
    }),
  );
}
