// Computes a picture like a photograph of a face: a head of some fifteen ellipsoids under one lamp, with hair, a wall behind,
// and the grain of film. 512 x 512, as PGM: node scripts/photograph.mjs OUT.pgm [SIDE]. Nothing to store, nothing to license.
import { writeFileSync } from 'node:fs';

/** Uniform in [0, 1): the same on every system. */
function makeRandom(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 4294967296;
  };
}

const lamp = [-0.48, 0.55, 0.68];
/** Centre, half axes, brightness: x to the right, y up, z towards the eye. */
const solids = [
  [[0, -1.25, -0.35], [1.05, 0.62, 0.45], 0.22], // coat
  [[0, -0.72, -0.15], [0.2, 0.34, 0.2], 0.72], // neck
  [[0, 0.3, -0.22], [0.6, 0.62, 0.55], 0.14], // hair
  [[0, 0.02, 0], [0.46, 0.64, 0.52], 0.78], // head
  [[-0.47, 0, -0.12], [0.07, 0.13, 0.1], 0.72], // ears
  [[0.47, 0, -0.12], [0.07, 0.13, 0.1], 0.72],
  [[0, -0.06, 0.5], [0.065, 0.17, 0.13], 0.8], // nose
  [[0, -0.15, 0.53], [0.085, 0.06, 0.09], 0.8],
  [[-0.17, 0.24, 0.44], [0.13, 0.03, 0.06], 0.16], // brows
  [[0.17, 0.24, 0.44], [0.13, 0.03, 0.06], 0.16],
  [[-0.17, 0.11, 0.43], [0.09, 0.045, 0.05], 0.95], // eyes
  [[0.17, 0.11, 0.43], [0.09, 0.045, 0.05], 0.95],
  [[-0.165, 0.11, 0.46], [0.036, 0.04, 0.035], 0.06],
  [[0.175, 0.11, 0.46], [0.036, 0.04, 0.035], 0.06],
  [[0, -0.3, 0.46], [0.13, 0.028, 0.05], 0.42], // lips
  [[0, -0.345, 0.46], [0.11, 0.03, 0.05], 0.5],
  [[0.06, 0.56, 0.12], [0.44, 0.16, 0.34], 0.16], // hair in front
];

/** Brightness at a point of the picture, -1 to 1 along both sides. */
function brightness(x, y) {
  let depth = -Infinity;
  let shade = 0.5 + 0.12 * y - 0.18 * x; // the wall
  for (const [c, a, albedo] of solids) {
    const u = (x - c[0]) / a[0];
    const v = (y - c[1]) / a[1];
    const rest = 1 - u * u - v * v;
    if (rest <= 0) continue;
    const w = Math.sqrt(rest);
    const z = c[2] + a[2] * w;
    if (z <= depth) continue;
    depth = z;
    const normal = [u / a[0], v / a[1], w / a[2]];
    const length = Math.hypot(...normal);
    const light = normal.reduce((sum, n, d) => sum + (n / length) * lamp[d], 0);
    shade = albedo * (0.25 + 0.8 * Math.max(0, light));
  }
  return shade;
}

const [out, size = '512'] = process.argv.slice(2);
if (!out) throw new Error('node scripts/photograph.mjs OUT.pgm [SIDE]');
const side = Number(size);
const random = makeRandom(1857);
const pixels = new Uint8Array(side * side);
for (let j = 0; j < side; ++j)
  for (let i = 0; i < side; ++i) {
    let sum = 0;
    for (const [p, q] of [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]])
      sum += brightness((2 * (i + p)) / side - 1, 1 - (2 * (j + q)) / side) / 4;
    const grain = (random() + random() + random() - 1.5) * 0.06;
    pixels[j * side + i] = Math.max(0, Math.min(255, Math.round(255 * (sum + grain))));
  }
writeFileSync(out, Buffer.concat([Buffer.from(`P5\n${side} ${side}\n255\n`), pixels]));
