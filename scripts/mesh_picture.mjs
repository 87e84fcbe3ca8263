// Draws the edges of a 2D mesh: node scripts/mesh_picture.mjs MESH.mesh OUT.png [WIDTH]. Made docs/images/riemann.png from
// pillowmesh adapt --case riemann -o riemann.mesh.
import { readFileSync, writeFileSync } from 'node:fs';
import { crc32, deflateSync } from 'node:zlib';

const [input, output, width = '800'] = process.argv.slice(2);
const words = readFileSync(input, 'utf8').split(/\s+/);
const section = (name, numbers) => {
  const start = words.indexOf(name) + 2;
  return Array.from({ length: Number(words[start - 1]) }, (_, k) =>
    words.slice(start + k * numbers, start + (k + 1) * numbers).map(Number),
  );
};
const points = section('Vertices', Number(words[words.indexOf('Dimension') + 1]) + 1);
const edges = new Map();
for (const quad of section('Quadrilaterals', 5))
  for (let k = 0; k < 4; ++k) {
    const [a, b] = [quad[k] - 1, quad[(k + 1) % 4] - 1].sort((p, q) => p - q);
    edges.set(a * points.length + b, [a, b]);
  }
const range = (axis) => [Math.min(...points.map((p) => p[axis])), Math.max(...points.map((p) => p[axis]))];
const [[left, right], [bottom, top]] = [range(0), range(1)];
const w = Number(width);
const scale = (w - 2) / (right - left);
const h = Math.ceil((top - bottom) * scale) + 2;

const gray = new Float32Array(w * h).fill(1);
for (const [a, b] of edges.values()) {
  const from = [(points[a][0] - left) * scale, (top - points[a][1]) * scale];
  const to = [(points[b][0] - left) * scale, (top - points[b][1]) * scale];
  const steps = Math.ceil(1.5 * Math.max(Math.abs(to[0] - from[0]), Math.abs(to[1] - from[1]), 1));
  for (let k = 0; k <= steps; ++k) {
    const [x, y] = [0, 1].map((i) => from[i] + ((to[i] - from[i]) * k) / steps);
    const [i, j] = [Math.floor(x), Math.floor(y)];
    for (const [dx, dy] of [[0, 0], [1, 0], [0, 1], [1, 1]])
      if (i + dx < w && j + dy < h)
        gray[(j + dy) * w + i + dx] -= 0.55 * (1 - Math.abs(x - i - dx)) * (1 - Math.abs(y - j - dy));
  }
}

const rows = Buffer.alloc((w + 1) * h); // each row begins with its filter: none
for (let j = 0; j < h; ++j)
  for (let i = 0; i < w; ++i) rows[j * (w + 1) + 1 + i] = Math.round(255 * Math.max(0, gray[j * w + i]));
const chunk = (type, data) => {
  const body = Buffer.concat([Buffer.from(type), data]);
  const [length, sum] = [Buffer.alloc(4), Buffer.alloc(4)];
  length.writeUInt32BE(data.length);
  sum.writeUInt32BE(crc32(body));
  return Buffer.concat([length, body, sum]);
};
const header = Buffer.alloc(13);
header.writeUInt32BE(w, 0);
header.writeUInt32BE(h, 4);
header[8] = 8; // bits of gray
const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
writeFileSync(output, Buffer.concat([signature, chunk('IHDR', header), chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]));
