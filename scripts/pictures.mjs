// Makes the pictures of the documentation with the program itself: docs/images/*.svg from the command's meshes, and
// docs/images/page.png from the page. Usage: node scripts/pictures.mjs
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { build } from './build.mjs';
import { Failure, main, root } from './run.mjs';
import { chromium, setup } from './setup.mjs';

const images = join(root, 'docs', 'images');

/** The points and quads of a mesh that the command writes for `args`. */
function adapt(args, folder) {
  const file = join(folder, 'out.mesh');
  const command = join(root, 'build/release/bin/pillowmesh');
  const { status, stderr } = spawnSync(command, ['adapt', ...args, '-q', '-o', file]);
  // 1: stopped before all edges were short, which some of the pictures are about.
  if (status !== 0 && status !== 1) throw new Failure(`pillowmesh adapt ${args.join(' ')} failed: ${stderr}`);
  const words = readFileSync(file, 'utf8').split(/\s+/);
  const table = (name, width) => {
    const at = words.indexOf(name);
    const count = Number(words[at + 1]);
    const row = (i) => words.slice(at + 2 + i * width, at + 2 + (i + 1) * width).map(Number);
    return Array.from({ length: count }, (_, i) => row(i));
  };
  const points = table('Vertices', 3);
  return { points, quads: table('Quadrilaterals', 5).map((row) => row.slice(0, 4).map((id) => points[id - 1])) };
}

const area = ([a, b, c, d]) => Math.abs((c[0] - a[0]) * (d[1] - b[1]) - (d[0] - b[0]) * (c[1] - a[1])) / 2;

/** From large cells to small ones. */
const shades = ['#eef3f8', '#dbe7f1', '#c3d8ea', '#a4c5e0', '#7fadd4', '#5691c4', '#3274b0', '#185a97', '#0b4379'];

/** Quads as one SVG group, shaded by area, `width` wide, with its left edge at `left`. */
function panel({ points, quads }, width, left) {
  const xs = points.map((p) => p[0]);
  const ys = points.map((p) => p[1]);
  const [low, high] = [Math.min(...xs), Math.max(...xs)];
  const top = Math.max(...ys);
  const scale = width / (high - low);
  const areas = quads.map((quad) => Math.log(area(quad)));
  // One scale of shades for all pictures of a domain: relative to the domain, not to the mesh's own extremes.
  const whole = Math.log((high - low) * (top - Math.min(...ys)));
  const shade = (value) => Math.min(shades.length - 1, Math.max(0, Math.floor((whole - value - 3.5) / 1)));
  const paths = shades.map(() => []);
  quads.forEach((quad, i) => {
    const corners = quad.map(([x, y]) => `${(left + (x - low) * scale).toFixed(1)} ${((top - y) * scale).toFixed(1)}`);
    paths[shade(areas[i])].push(`M${corners.join('L')}Z`);
  });
  const height = (top - Math.min(...ys)) * scale;
  const svg = paths.map((path, i) => (path.length ? `<path fill="${shades[i]}" d="${path.join('')}"/>\n` : '')).join('');
  return { height, svg };
}

/** Pictures beside each other, each a list of arguments of `pillowmesh adapt` and a caption. */
function strip(name, panels, width, folder) {
  const gap = 16;
  const drawn = panels.map(({ args, caption }, i) => {
    const mesh = adapt(args, folder);
    return { ...panel(mesh, width, i * (width + gap)), caption: `${caption}: ${mesh.quads.length} quads` };
  });
  const height = Math.max(...drawn.map((d) => d.height));
  const total = panels.length * (width + gap) - gap;
  const middle = (i) => i * (width + gap) + width / 2;
  const captions = drawn.map(({ caption }, i) => `<text x="${middle(i)}" y="${height + 22}">${caption}</text>`);
  const size = [total + 4, Math.ceil(height) + 34];
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="-2 -2 ${size.join(' ')}">
<rect x="-2" y="-2" width="${size[0]}" height="${size[1]}" fill="#fff"/>
<g stroke="#0a2540" stroke-width=".5" stroke-linejoin="round">
${drawn.map(({ svg }) => svg).join('')}</g>
<g font-family="system-ui, sans-serif" font-size="14" text-anchor="middle" fill="#0a2540">
${captions.join('\n')}
</g>
</svg>
`;
  writeFileSync(join(images, `${name}.svg`), svg);
  console.log(`docs/images/${name}.svg`);
}

/** The page in the middle of a run. */
async function pagePicture() {
  const { chromium: browsers } = await import('playwright-core');
  const { build: bundle, preview } = await import('vite');
  const outDir = join(root, 'build', 'pictures-site');
  const config = { configFile: join(root, 'web', 'vite.config.ts'), logLevel: 'error' };
  await bundle({ ...config, build: { outDir, emptyOutDir: true } });
  const server = await preview({ ...config, build: { outDir }, preview: { port: 0 } });
  const browser = await browsers.launch({
    executablePath: chromium(),
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist',
      '--disable-background-networking', '--disable-component-update', '--disable-sync', '--no-first-run'],
  });
  try {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, colorScheme: 'light' });
    await page.goto(`${server.resolvedUrls.local[0]}#case=circle2d&event=44`);
    await page.waitForTimeout(3000);
    await page.waitForFunction(() => !document.body.innerText.includes('Computing'), null, { timeout: 120_000 });
    await page.waitForTimeout(1000);
    await page.screenshot({ path: join(images, 'page.png') });
    console.log('docs/images/page.png');
  } finally {
    await browser.close();
    await server.close();
  }
}

await main(async () => {
  setup('test');
  build('release');
  build('wasm');
  mkdirSync(images, { recursive: true });
  const folder = mkdtempSync(join(tmpdir(), 'pillowmesh-pictures-'));
  try {
    const circle = ['--case', 'circle2d'];
    const initial = ['--threshold', '1000000', '--smooth', 'none'];
    strip('circle2d', [
      { args: [...circle, ...initial], caption: 'initial mesh' },
      { args: [...circle, '--max-iterations', '1', '--smooth', 'none'], caption: 'first layers' },
      { args: circle, caption: 'adapted' },
    ], 300, folder);
    strip('iso2d', [
      { args: ['--case', 'iso2d', ...initial], caption: 'initial mesh' },
      { args: ['--case', 'iso2d', '--smooth', 'none'], caption: 'layers' },
      { args: ['--case', 'iso2d'], caption: 'relocated' },
    ], 300, folder);
  } finally {
    rmSync(folder, { recursive: true });
  }
  await pagePicture();
  process.exit(0);
});
