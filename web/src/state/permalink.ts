// Settings as the fragment of an address and back. Only what differs from the defaults is written.
import { decodeInside, encodeInside, number } from './inside_link.ts';
import {
  colourings,
  defaultSettings,
  lastEvent,
  marks,
  optionDefaults,
  paces,
  type CameraPose,
  type OptionName,
  type Settings,
} from './settings.ts';

/** The names that a link may hold. */
export const stateNames = [
  'case',
  'mesh',
  'file',
  'metric',
  'sketch',
  ...(Object.keys(optionDefaults) as OptionName[]),
  'target-cells',
  'colour',
  'hide',
  'show',
  'cut',
  'peel',
  'quality',
  'cells',
  'edges',
  'without',
  'around',
  'compare',
  'pace',
  'event',
  'view',
] as const;
export type StateName = (typeof stateNames)[number];

function encodeCamera({ target, zoom, direction }: CameraPose): string {
  return [target, [zoom], direction ?? []].map((part) => part.map(number).join(',')).join(';');
}

function decodeCamera(text: string): CameraPose | null {
  const [target, zoom, direction] = text.split(';').map((part) => part.split(',').filter(Boolean).map(Number));
  if (!target?.length || !zoom?.length || !(zoom[0] > 0)) return null;
  if (![...target, ...(direction ?? [])].every(Number.isFinite)) return null;
  return { target, zoom: zoom[0], ...(direction?.length ? { direction } : {}) };
}

/** "case=iso2d&event=57": without the leading '#'. */
export function encodeSettings(settings: Settings): string {
  const standard = defaultSettings();
  const query = new URLSearchParams();
  const { mesh } = settings;
  if (mesh.kind === 'case') query.set('case', mesh.name);
  if (mesh.kind === 'grid') query.set('mesh', mesh.spec);
  if (mesh.kind === 'file') query.set('file', mesh.name);
  if (settings.formula) query.set('metric', settings.formula);
  if (settings.sketch) query.set('sketch', settings.sketch);
  for (const [name, value] of Object.entries(settings.options))
    if (value !== optionDefaults[name as OptionName]) query.set(name, value);
  if (settings.targetCells) query.set('target-cells', String(settings.targetCells));
  if (settings.colouring !== standard.colouring) query.set('colour', settings.colouring);
  const switched = (to: boolean): string =>
    marks.filter((mark) => settings.marks[mark] === to && standard.marks[mark] !== to).join(',');
  for (const [name, list] of [['hide', switched(false)], ['show', switched(true)]]) if (list) query.set(name, list);
  for (const [name, value] of Object.entries(encodeInside(settings.inside))) query.set(name, value);
  if (settings.compare) query.set('compare', settings.compare);
  if (settings.pace !== standard.pace) query.set('pace', settings.pace);
  if (settings.event !== null) query.set('event', settings.event === lastEvent ? 'last' : String(settings.event));
  if (settings.camera) query.set('view', encodeCamera(settings.camera));
  return query.toString();
}

/** Reads a fragment; whatever it does not understand keeps its default. */
export function decodeSettings(fragment: string): Settings {
  const query = new URLSearchParams(fragment.replace(/^#/, ''));
  const settings = defaultSettings();
  const get = (name: string): string | null => query.get(name);
  const [grid, file, name] = [get('mesh'), get('file'), get('case')];
  if (grid) settings.mesh = { kind: 'grid', spec: grid };
  else if (file) settings.mesh = { kind: 'file', name: file };
  else if (name) settings.mesh = { kind: 'case', name };
  settings.formula = get('metric') ?? '';
  settings.sketch = get('sketch') ?? '';
  for (const option of Object.keys(optionDefaults) as OptionName[])
    settings.options[option] = get(option) ?? optionDefaults[option];
  const target = Number(get('target-cells'));
  if (target >= 1 && Number.isFinite(target)) settings.targetCells = target;
  settings.colouring = colourings.find((c) => c === get('colour')) ?? settings.colouring;
  for (const mark of marks) {
    if ((get('hide') ?? '').split(',').includes(mark)) settings.marks[mark] = false;
    if ((get('show') ?? '').split(',').includes(mark)) settings.marks[mark] = true;
  }
  settings.compare = get('compare') ?? '';
  settings.pace = paces.find((p) => p === get('pace')) ?? settings.pace;
  settings.inside = decodeInside(get);
  const event = get('event') === 'last' ? lastEvent : Number.parseInt(get('event') ?? '', 10);
  if (event >= 0) settings.event = event;
  settings.camera = decodeCamera(get('view') ?? '');
  return settings;
}

/** Whether two states show the same run, if perhaps not the same moment of it. */
export function sameComputation(a: Settings, b: Settings): boolean {
  const question = ({ mesh, formula, sketch, options, targetCells }: Settings): string =>
    JSON.stringify([mesh, formula, sketch, options, targetCells]);
  return question(a) === question(b);
}
