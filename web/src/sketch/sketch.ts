// A metric drawn by hand: strokes, near which cells are fine, round or stretched along the stroke. A sketch becomes a
// formula, which can be read, edited, shared and embedded like any other.

/** Points in the mesh's coordinates, one after the other. */
export interface Stroke {
  /** Size of cells across the stroke. */
  size: number;
  /** How many times as long they are along it. */
  stretch: number;
  points: readonly (readonly [x: number, y: number])[];
}

const short = (value: number): string => String(Number(value.toPrecision(4)));

/** "0.02,4:0.1,0.2,0.5,0.6;..." */
export function encodeSketch(strokes: readonly Stroke[]): string {
  return strokes
    .map(({ size, stretch, points }) => `${short(size)},${short(stretch)}:${points.flat().map(short).join(',')}`)
    .join(';');
}

/** Strokes that are not understood are left out. */
export function decodeSketch(text: string): Stroke[] {
  return text.split(';').flatMap((part) => {
    const [head, body] = part.split(':').map((list) => list.split(',').map(Number));
    if (!body || body.length < 2 || ![...head, ...body].every(Number.isFinite) || !(head[0] > 0)) return [];
    const points = Array.from({ length: body.length >> 1 }, (_, i) => [body[2 * i], body[2 * i + 1]] as const);
    return [{ size: head[0], stretch: Math.max(1, head[1] ?? 1), points }];
  });
}

/** How fast sizes grow away from a stroke. */
const growth = 0.25;

/**
 * A sketch as a metric, smooth everywhere: what has kinks and jumps takes many times as long to measure and to meet.
 * At the distance d of a straight piece cells should be c = sqrt(size^2 + (d/4)^2) across; away from all strokes, `far`.
 * Of all these the mean is taken, weighted by 1/c^8: a piece counts half where d = 1.7 size, a sixteenth where
 * d = 4 size. The excess of length along the stroke, as a vector of twice the angle, is averaged likewise: strokes turn
 * smoothly, and where two cross cells are small in both directions.
 */
export function formulaOfSketch(strokes: readonly Stroke[], far: number): string {
  if (strokes.length === 0) return `h = ${short(far)}`;
  const lines: string[] = [];
  const excesses: [number, number][] = [];
  for (const { size, stretch, points } of strokes) {
    const ends = points.length === 1 ? [points[0], points[0]] : points;
    for (let i = 0; i + 1 < ends.length; ++i) {
      lines.push(...across(ends[i], ends[i + 1], size, excesses.length + 1));
      const angle = 2 * Math.atan2(ends[i + 1][1] - ends[i][1], ends[i + 1][0] - ends[i][0]);
      const excess = size * (stretch - 1);
      excesses.push([excess * Math.cos(angle), excess * Math.sin(angle)]);
    }
  }
  const sum = (term: (n: number, excess: [number, number]) => string | null): string =>
    excesses.flatMap((excess, i) => term(i + 1, excess) ?? []).join(' + ') || '0';
  lines.push(`w = ${sum((n) => `w${n}`)} + ${short(far ** -8)}`);
  const size = `(${sum((n) => `w${n}*c${n}`)} + ${short(far ** -7)})/w`;
  if (strokes.every(({ stretch }) => stretch === 1)) return [...lines, `h = ${size}`].join(';\n');
  const part = (axis: 0 | 1): string =>
    sum((n, { [axis]: x }) => (Math.abs(x) < 1e-12 ? null : `${paren(x)}*w${n}`));
  lines.push(`p = (${part(0)})/w`, `q = (${part(1)})/w`);
  lines.push(`h2 = ${size}`, 'h1 = h2 + sqrt(p^2 + q^2)', 'theta = atan2(q, p)/2');
  return lines.join(';\n');
}

/** Statements for the size c1, c2, ... that a straight piece of a stroke asks for, and its weight w1, w2, ... */
function across([x, y]: readonly [number, number], [p, q]: readonly [number, number], size: number, n: number): string[] {
  const [dx, dy] = [p - x, q - y];
  const square = dx * dx + dy * dy;
  const [u, v] = [`(x - ${paren(x)})`, `(y - ${paren(y)})`];
  const foot = `t${n} = min(1, max(0, ${u}*${paren(dx / square)} + ${v}*${paren(dy / square)}))`;
  const away = square > 0 ? `(${u} - t${n}*${paren(dx)})^2 + (${v} - t${n}*${paren(dy)})^2` : `${u}^2 + ${v}^2`;
  return [
    ...(square > 0 ? [foot] : []),
    `c${n} = sqrt(${short(size * size)} + ${growth ** 2}*(${away}))`,
    `w${n} = 1/(c${n}^2)^4`,
  ];
}

function paren(value: number): string {
  const text = short(value);
  return text.startsWith('-') ? `(${text})` : text;
}

/** Fewer points, none of which was farther than `tolerance` from what is left (Douglas and Peucker, 1973). */
export function simplified(points: readonly (readonly [number, number])[], tolerance: number): [number, number][] {
  if (points.length < 3) return points.map(([x, y]) => [x, y]);
  const [a, b] = [points[0], points[points.length - 1]];
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
  let [worst, at] = [tolerance, -1];
  points.forEach(([x, y], i) => {
    const away =
      length > 0
        ? Math.abs((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / length
        : Math.hypot(x - a[0], y - a[1]);
    if (away > worst) [worst, at] = [away, i];
  });
  if (at <= 0) return [[a[0], a[1]], [b[0], b[1]]];
  return [...simplified(points.slice(0, at + 1), tolerance).slice(0, -1), ...simplified(points.slice(at), tolerance)];
}
