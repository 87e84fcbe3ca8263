// How the mesh is looked into, as parts of a link:
// cut=slab:90,0,0.5,0.2 peel=1 quality=eta:0,0.5 cells=glass edges=irregular without=7,12 around=3
import { bodies, cutKinds, defaultInside, qualityMeasures, type Inside } from '../inside/look_inside.ts';

/** At most six digits; what rounding has left of a zero is one. */
export const number = (value: number): string => String(Math.abs(value) < 1e-12 ? 0 : Number(value.toPrecision(6)));

export function encodeInside({ cut, peel, quality, body, irregular, without, around }: Inside): Record<string, string> {
  const parts: Record<string, string> = {};
  if (cut.kind !== 'off') {
    const numbers = [cut.turn, cut.tilt, cut.position, ...(cut.kind === 'slab' ? [cut.thickness] : [])];
    parts.cut = `${cut.kind}:${numbers.map(number).join(',')}`;
  }
  if (peel > 0) parts.peel = String(peel);
  if (quality.low > 0 || quality.high < 1)
    parts.quality = `${quality.measure}:${number(quality.low)},${number(quality.high)}`;
  if (body !== 'auto') parts.cells = body;
  if (irregular) parts.edges = 'irregular';
  if (without.length > 0) parts.without = without.join(',');
  if (around.length > 0) parts.around = around.join(',');
  return parts;
}

/** "word:1,2" as a word of the list and finite numbers, each within its range; undefined when it is something else. */
function read<W extends string>(
  text: string | null,
  words: readonly W[],
  ranges: readonly (readonly [number, number])[],
  least: number,
): { word: W; numbers: number[] } | undefined {
  const [name, list = ''] = (text ?? '').split(':');
  const word = words.find((w) => w === name);
  const numbers = list.split(',').filter(Boolean).map(Number);
  if (word === undefined || numbers.length < least || numbers.length > ranges.length) return undefined;
  return numbers.every((x, i) => x >= ranges[i][0] && x <= ranges[i][1]) ? { word, numbers } : undefined;
}

const share = [0, 1] as const;

export function decodeInside(get: (name: string) => string | null): Inside {
  const inside = defaultInside();
  const cut = read(get('cut'), cutKinds, [[-180, 180], [-90, 90], share, share], 3);
  if (cut) {
    const [turn, tilt, position, thickness = inside.cut.thickness] = cut.numbers;
    inside.cut = { kind: cut.word, turn, tilt, position, thickness };
  }
  const quality = read(get('quality'), qualityMeasures, [share, share], 2);
  if (quality) inside.quality = { measure: quality.word, low: quality.numbers[0], high: quality.numbers[1] };
  const peel = Number.parseInt(get('peel') ?? '', 10);
  if (peel > 0) inside.peel = Math.min(peel, 1000);
  inside.body = bodies.find((body) => body === get('cells')) ?? inside.body;
  inside.irregular = get('edges') === 'irregular';
  const cells = (name: string): number[] => (get(name)?.match(/\d+/g) ?? []).map(Number);
  inside.without = cells('without');
  inside.around = cells('around');
  return inside;
}
