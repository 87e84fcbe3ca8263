// The attributes of <pillow-mesh>. Those that say what is shown have the names and values of a link's parts, so that a
// link of the page, an address of the embed page and an element say the same in the same words.
import { decodeSettings, encodeSettings, stateNames } from '../state/permalink.ts';
import type { Settings } from '../state/settings.ts';

/** What is shown, by name as in a link; `src` is the address of a mesh file, and `file` its name in a link. */
export const stateAttributes = [...stateNames.filter((name) => name !== 'file'), 'src'] as const;

/** How the element behaves. */
export const behaviourAttributes = ['controls', 'caption', 'autoplay', 'loading', 'theme'] as const;

/** `full`: all; `step`: play and single steps, no pace or iterations; `none`: the picture alone. */
export const controlKinds = ['full', 'step', 'none'] as const;
export type ControlKind = (typeof controlKinds)[number];

const read = (element: Element, name: string): string | null => element.getAttribute(name);

/** The part of an address after the last slash: names the file in messages and chooses its format. */
export function fileNameOf(address: string): string {
  return decodeURIComponent(new URL(address, 'http://x/').pathname.split('/').at(-1) ?? '');
}

export function settingsOf(element: Element): Settings {
  const query = new URLSearchParams();
  for (const name of stateNames) {
    const value = read(element, name);
    if (value !== null) query.set(name, value);
  }
  const src = read(element, 'src');
  if (src) query.set('file', fileNameOf(src));
  return decodeSettings(query.toString());
}

export function controlsOf(element: Element): ControlKind {
  const value = read(element, 'controls');
  return controlKinds.find((kind) => kind === value) ?? 'full';
}

/** Settings as attributes: what a snippet is written with. */
export function attributesOf(settings: Settings): [name: string, value: string][] {
  return [...new URLSearchParams(encodeSettings(settings))].map(([name, value]) =>
    name === 'file' ? ['src', value] : [name, value],
  );
}
