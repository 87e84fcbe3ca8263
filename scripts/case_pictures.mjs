// Draws the small pictures that cases are chosen by, web/public/cases/NAME.svg: adapted meshes of few cells, as masks that
// the page fills with its own colours. Usage: node scripts/case_pictures.mjs; needs build/wasm (npm run build).
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { build } from 'esbuild';
import { main, root } from './run.mjs';

/** How many cells make a picture that can be read at its size. */
const pictures = [
  { name: 'iso2d', cells: 240 },
  { name: 'aniso2d', cells: 160 },
  { name: 'circle2d', cells: 260 },
  { name: 'shock2d', cells: 280 },
  { name: 'riemann', cells: 560 },
  { name: 'masabl-1', cells: 220 },
  { name: 'linear3d', cells: 300 },
  { name: 'sphere3d', cells: 160 },
];
const size = 100;

const round = (x) => Math.round(10 * x) / 10;
/** " 12.3-4": as short as a path may have it. */
const pair = ([x, y]) => `${round(x)}${round(y) < 0 ? '' : ' '}${round(y)}`.replace(/(?<!\d)0\./g, '.');

/** Seen from here, 3D meshes fill the picture: x to the right and back, y to the left and back, z up. */
const aslant = ([x, y, z]) => [(x - y) * Math.cos(Math.PI / 6), z + (x + y) / 2];

/** Outlines as one path, each line once. */
function linesOf(polygons) {
  const lines = new Map();
  for (const polygon of polygons)
    polygon.forEach((from, i) => {
      const to = polygon[(i + 1) % polygon.length];
      const [a, b] = [from, to].map((p) => p.map(round)).sort((p, q) => p[0] - q[0] || p[1] - q[1]);
      lines.set(String([a, b]), `M${pair(a)}l${pair([b[0] - a[0], b[1] - a[1]])}`);
    });
  return [...lines.values()].join('');
}

/** The projected quadrilaterals of a mesh, by how bright each is: 2D cells, or the facets of three sides of a box. */
function quadsOf({ dim, points, cells }) {
  const at = (v) => Array.from(points.subarray(dim * v, dim * v + dim));
  const ring = (corners) => [corners[0], corners[1], corners[3], corners[2]].map(at);
  if (dim === 2) {
    const all = [];
    for (let c = 0; c < cells.length; c += 4) if (cells[c] >= 0) all.push({ shade: 0, ring: ring(cells.subarray(c, c + 4)) });
    return all;
  }
  const facets = [];
  for (let c = 0; c < cells.length; c += 8)
    if (cells[c] >= 0)
      for (let axis = 0; axis < 3; ++axis)
        for (let side = 0; side < 2; ++side) {
          const corners = [...Array(8).keys()].filter((k) => ((k >> axis) & 1) === side).map((k) => cells[c + k]);
          facets.push(ring(corners));
        }
  const on = (facet, d, value) => facet.every((p) => Math.abs(p[d] - value) < 1e-9);
  return [
    [0, 0, 0.34],
    [1, 0, 0.16],
    [2, 1, 0.04],
  ].flatMap(([d, value, shade]) =>
    facets.filter((facet) => on(facet, d, value)).map((facet) => ({ shade, ring: facet.map(aslant) })),
  );
}

function svgOf(mesh) {
  const quads = quadsOf(mesh);
  const all = quads.flatMap(({ ring }) => ring);
  const low = [0, 1].map((d) => Math.min(...all.map((p) => p[d])));
  const high = [0, 1].map((d) => Math.max(...all.map((p) => p[d])));
  const scale = (size - 4) / Math.max(high[0] - low[0], high[1] - low[1]);
  const [dx, dy] = [0, 1].map((d) => (size - scale * (high[d] - low[d])) / 2);
  const rings = quads.map(({ ring, shade }) => ({
    shade,
    ring: ring.map(([x, y]) => [dx + scale * (x - low[0]), size - dy - scale * (y - low[1])]),
  }));
  const shades = [...new Set(rings.map(({ shade }) => shade))].filter((shade) => shade > 0);
  const fills = shades.map((shade) => {
    const path = rings.filter((r) => r.shade === shade).map(({ ring }) => `M${ring.map(pair).join('L')}Z`);
    return `<path d="${path.join('')}" fill-opacity="${shade}"/>\n`;
  });
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${size} ${size}">\n${fills.join('')}` +
    `<path d="${linesOf(rings.map(({ ring }) => ring))}" fill="none" stroke="#000" stroke-width=".8" stroke-linecap="round"/>\n</svg>\n`
  );
}

await main(async () => {
  const core = join(root, 'build', 'case_pictures.mjs');
  await build({ entryPoints: [join(root, 'wasm', 'core.ts')], outfile: core, bundle: true, format: 'esm', platform: 'node' });
  const { modulesFrom, openMesh } = await import(core);
  const read = (name) => readFileSync(join(root, 'build', 'wasm', `${name}.wasm`));
  const modules = modulesFrom({
    2: read('pillowmesh'),
    full: read('pillowmesh_full'),
    3: read('pillowmesh3d'),
    files: read('pillowmesh_files'),
    metrics: read('pillowmesh_metrics'),
  });
  const folder = join(root, 'web', 'public', 'cases');
  mkdirSync(folder, { recursive: true });
  for (const { name, cells } of pictures) {
    const mesh = await openMesh({ kind: 'case', name }, modules, cells);
    const solid = mesh.arrays().dim === 3;
    const { report } = await mesh.adapt(undefined, solid ? {} : { method: 'full', effort: 'best' });
    const svg = svgOf(mesh.arrays());
    writeFileSync(join(folder, `${name}.svg`), svg);
    console.log(`${name}: ${report.mesh.cells} cells, ${svg.length} bytes`);
    mesh.close();
  }
});
