// Colours of the picture: read from the style sheet, so that they follow the theme; and the colour maps.

export interface Palette {
  background: string;
  cell: string;
  /** Of facets inside the mesh that a cut lays open. */
  cut: string;
  line: string;
  outline: string;
  tag: string;
  layer: string;
  hull: string;
  buffer: string;
  ellipse: string;
  /** The two dual chords that cross in the cell pointed at. */
  chord: string;
  otherChord: string;
  /** Of irregular edges, in the order of irregularKinds. */
  irregular: readonly [string, string, string];
}

/** Custom properties of the style sheet as colours of the theme in force: the browser resolves `light-dark()`. */
export function readColours<N extends string>(element: Element, names: readonly N[]): Record<N, string> {
  const probe = document.createElement('span');
  probe.hidden = true;
  element.append(probe);
  const style = getComputedStyle(probe);
  const colours = names.map((name) => {
    probe.style.color = `var(--${name})`;
    return [name, style.color] as const;
  });
  probe.remove();
  return Object.fromEntries(colours) as Record<N, string>;
}

/** Whether light is written on dark. */
export function isDark(element: Element): boolean {
  const { ink } = readColours(element, ['ink']);
  const channels = ink.match(/[\d.]+/g)?.slice(0, 3).map(Number) ?? [0];
  return channels[0] > 128;
}

export function readPalette(element: Element): Palette {
  const colours = readColours(element, [
    'picture',
    'cell',
    'cut',
    'mesh-line',
    'outline',
    'tag',
    'layer',
    'hull',
    'buffer',
    'ellipse',
    'fewer',
    'one-more',
    'many-more',
  ]);
  return {
    ...colours,
    background: colours.picture,
    line: colours['mesh-line'],
    chord: colours['one-more'],
    otherChord: colours.fewer,
    irregular: [colours.fewer, colours['one-more'], colours['many-more']],
  };
}

/** A point of a colour map in Oklch: lightness, chroma, hue in degrees. */
type Anchor = readonly [lightness: number, chroma: number, hue: number];

/** Oklab to sRGB bytes (Ottosson, "A perceptual color space for image processing", 2020), clipped to the gamut. */
function toBytes(L: number, a: number, b: number): [number, number, number] {
  const l = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (L - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const linear = [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
  const encode = (x: number): number => {
    const v = x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
    return Math.round(255 * Math.min(1, Math.max(0, v)));
  };
  return linear.map(encode) as [number, number, number];
}

/** 256 RGBA colours through the anchors, evenly spaced, linear in Oklab: equal steps look equal. */
export function colourMap(anchors: readonly Anchor[]): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(256 * 4);
  const lab = anchors.map(([L, c, h]) => [L, c * Math.cos((h * Math.PI) / 180), c * Math.sin((h * Math.PI) / 180)]);
  for (let i = 0; i < 256; ++i) {
    const x = (i / 255) * (lab.length - 1);
    const k = Math.min(Math.floor(x), lab.length - 2);
    const mix = (j: number): number => lab[k][j] + (x - k) * (lab[k + 1][j] - lab[k][j]);
    bytes.set([...toBytes(mix(0), mix(1), mix(2)), 255], 4 * i);
  }
  return bytes;
}

/** Shape eta, 0 to 1. Good cells stay near the paper, bad ones stand out; lightness is monotone in both themes. */
const shape: Record<'light' | 'dark', readonly Anchor[]> = {
  light: [
    [0.33, 0.12, 310],
    [0.48, 0.17, 345],
    [0.64, 0.17, 25],
    [0.81, 0.11, 75],
    [0.955, 0.045, 110],
  ],
  dark: [
    [0.93, 0.09, 100],
    [0.8, 0.14, 65],
    [0.64, 0.17, 30],
    [0.46, 0.14, 345],
    [0.29, 0.055, 285],
  ],
};

/** Iteration that made the cell, first to last: a hue that neither tags, layer, hull nor buffer layer have. */
const age: Record<'light' | 'dark', readonly Anchor[]> = {
  light: [
    [0.975, 0.008, 350],
    [0.89, 0.045, 350],
    [0.77, 0.095, 352],
    [0.6, 0.14, 355],
  ],
  dark: [
    [0.25, 0.012, 300],
    [0.36, 0.06, 345],
    [0.52, 0.12, 350],
    [0.74, 0.13, 355],
  ],
};

/** Metric length, 1/4 to 4 on a logarithmic scale: too short, right, too long. */
const length: Record<'light' | 'dark', readonly Anchor[]> = {
  light: [
    [0.38, 0.12, 255],
    [0.66, 0.1, 245],
    [0.965, 0.008, 100],
    [0.72, 0.13, 55],
    [0.45, 0.14, 35],
  ],
  dark: [
    [0.78, 0.12, 245],
    [0.52, 0.1, 250],
    [0.26, 0.012, 270],
    [0.55, 0.11, 50],
    [0.83, 0.13, 65],
  ],
};

export const colourMaps = {
  length: { light: colourMap(length.light), dark: colourMap(length.dark) },
  jacobian: { light: colourMap(shape.light), dark: colourMap(shape.dark) },
  shape: { light: colourMap(shape.light), dark: colourMap(shape.dark) },
  age: { light: colourMap(age.light), dark: colourMap(age.dark) },
} as const;
