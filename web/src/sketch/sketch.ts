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

/** `far`: the size of cells away from all strokes. */
export function formulaOfSketch(strokes: readonly Stroke[], far: number): string {
  if (strokes.length === 0) return `h = ${short(far)}`;
  const lines: string[] = [];
  const near: { distance: string; across: string; along: string; angle: string }[] = [];
  strokes.forEach(({ size, stretch, points }) => {
    const ends = points.length === 1 ? [points[0], points[0]] : points;
    for (let i = 0; i + 1 < ends.length; ++i) {
      const [[x, y], [p, q]] = [ends[i], ends[i + 1]];
      const [dx, dy] = [p - x, q - y];
      const square = dx * dx + dy * dy;
      const name = `d${near.length + 1}`;
      const [u, v] = [`(x - ${paren(x)})`, `(y - ${paren(y)})`];
      if (square > 0) {
        const t = `t${near.length + 1}`;
        lines.push(`${t} = min(1, max(0, (${u}*${paren(dx / square)} + ${v}*${paren(dy / square)})))`);
        lines.push(`${name} = sqrt((${u} - ${t}*${paren(dx)})^2 + (${v} - ${t}*${paren(dy)})^2)`);
      } else {
        lines.push(`${name} = sqrt(${u}^2 + ${v}^2)`);
      }
      near.push({
        distance: name,
        across: short(size),
        along: short(size * stretch),
        angle: short(Math.atan2(dy, dx)),
      });
    }
  });
  const round = strokes.every(({ stretch }) => stretch === 1);
  const grown = (size: string, { distance }: { distance: string }): string => `${size} + ${growth}*${distance}`;
  const least = near.map((one) => grown(one.across, one)).reduce((all, one) => `min(${all}, ${one})`);
  if (round) return [...lines, `h = min(${short(far)}, ${least})`].join(';\n');
  // The nearest stroke decides: angle, and size along it.
  lines.push(`c = ${least}`);
  const chosen = (of: (one: (typeof near)[number]) => string): string =>
    near.slice(1).reduce((all, one) => `if(${grown(one.across, one)} <= c, ${of(one)}, ${all})`, of(near[0]));
  lines.push(`h1 = min(${short(far)}, ${chosen((one) => grown(one.along, one))})`);
  lines.push(`h2 = min(${short(far)}, c)`);
  lines.push(`theta = ${chosen((one) => one.angle)}`);
  return lines.join(';\n');
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
