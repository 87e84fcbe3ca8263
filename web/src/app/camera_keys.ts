// The camera by keys: on the page and in the element.
import type { Picture } from '../stage/picture.ts';
import type { KeyActions } from './keyboard.ts';

const step = 0.08;

export function cameraKeys(picture: () => Picture | undefined): KeyActions {
  return {
    'Ctrl+ArrowLeft': () => picture()?.nudge(-step, 0),
    'Ctrl+ArrowRight': () => picture()?.nudge(step, 0),
    'Ctrl+ArrowUp': () => picture()?.nudge(0, step),
    'Ctrl+ArrowDown': () => picture()?.nudge(0, -step),
    ',': () => picture()?.nudge(0, 0, 1 / 1.25),
    '.': () => picture()?.nudge(0, 0, 1.25),
    f: () => picture()?.fit(),
  };
}
