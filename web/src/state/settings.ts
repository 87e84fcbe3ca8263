// Everything that a visitor can set. One plain value: the permalink is this, written down.
import { defaultInside, type Inside } from '../inside/look_inside.ts';

/** Where the initial mesh comes from. A file's content is not part of a link: only its name. */
export type MeshChoice =
  { kind: 'case'; name: string } | { kind: 'grid'; spec: string } | { kind: 'file'; name: string };

/** Options of core/pillowmesh/adapt/options.h under their command-line names, as text. */
export const optionDefaults = {
  method: 'paper',
  effort: 'normal',
  align: '1',
  threshold: '2',
  smooth: 'end',
  dice: '1',
  thickness: '1',
  augment: 'auto',
} as const;
export type OptionName = keyof typeof optionDefaults;
export type Options = Record<OptionName, string>;

/** By shape eta, metric length, scaled Jacobian, or the iteration that made the cell. */
export const colourings = ['plain', 'shape', 'length', 'jacobian', 'age'] as const;
export type Colouring = (typeof colourings)[number];

export const marks = ['tags', 'layer', 'hull', 'buffer', 'ellipses', 'isolines', 'irregular'] as const;
/** What can be drawn on top of the mesh. */
export type Mark = (typeof marks)[number];

export const defaultMarks: Readonly<Record<Mark, boolean>> = {
  tags: true,
  layer: true,
  hull: true,
  buffer: true,
  ellipses: true,
  isolines: false,
  irregular: false,
};

export const paces = ['auto', '0.5', '1', '2', '4', '16', '64'] as const;
export type Pace = (typeof paces)[number];

/** Centre of the picture and how far it is zoomed in (1: the mesh fills it); direction and up in 3D. */
export interface CameraPose {
  target: number[];
  zoom: number;
  direction?: number[];
}

/** More events than any run has: stands for the last one. */
export const lastEvent = Number.MAX_SAFE_INTEGER;

export interface Settings {
  mesh: MeshChoice;
  /** Empty: the case's own. */
  formula: string;
  /** Strokes that the metric is drawn with, as sketch/sketch.ts writes them; empty: it is a formula's. */
  sketch: string;
  options: Options;
  /** Sizes are scaled to make so many cells; null: as the metric says. */
  targetCells: number | null;
  colouring: Colouring;
  marks: Record<Mark, boolean>;
  /** In 3D: what is cut away and made transparent. */
  inside: Inside;
  /** What the answer is compared with, see app/compare.ts; empty: nothing. */
  compare: string;
  pace: Pace;
  /** Number of events shown, `lastEvent` for all; null: from the start. */
  event: number | null;
  /** null: the whole mesh. */
  camera: CameraPose | null;
}

export function defaultSettings(): Settings {
  return {
    mesh: { kind: 'case', name: 'iso2d' },
    formula: '',
    sketch: '',
    options: { ...optionDefaults },
    targetCells: null,
    colouring: 'plain',
    marks: { ...defaultMarks },
    inside: defaultInside(),
    compare: '',
    pace: 'auto',
    event: null,
    camera: null,
  };
}
