// The npm package as its users meet it: packed, unpacked, and used from Node, Vite and esbuild, with types.
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, readFileSync, readdirSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { build as esbuild } from 'esbuild';
import { build as vite } from 'vite';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import type { Browser } from 'playwright-core';
// @ts-expect-error a plain script without types
import { makePackage, pack } from '../../scripts/package.mjs';
import { openBrowser, root, serveFolder } from '../web/site.ts';

const work = join(root, 'build', 'package', 'npm');
const unpacked = join(work, 'node_modules', 'pillowmesh');
let browser: Browser;

beforeAll(async () => {
  rmSync(work, { recursive: true, force: true });
  mkdirSync(unpacked, { recursive: true });
  await makePackage();
  const archive = (pack as (target: string) => string)(work);
  execFileSync('tar', ['-xzf', archive, '-C', unpacked, '--strip-components=1']);
  for (const name of ['three', '@types']) symlinkSync(join(root, 'node_modules', name), join(work, 'node_modules', name));
  writeFileSync(join(work, 'package.json'), '{ "type": "module" }');
  browser = await openBrowser();
});
afterAll(() => browser?.close());

/** What is written into the page by an app that shows and measures a mesh. */
const app = `import 'pillowmesh/element';
const figure = document.createElement('pillow-mesh');
figure.setAttribute('case', 'iso2d');
figure.setAttribute('event', '3');
document.body.append(figure);
figure.addEventListener('step', ({ detail }) => (document.title = detail.kind + ' ' + detail.position));
`;

async function titleOf(folder: string): Promise<{ title: string; workers: number }> {
  const serving = await serveFolder(folder);
  const page = await browser.newPage();
  await page.goto(`${serving.address}index.html`);
  await page.waitForFunction(() => document.title !== '', null, { timeout: 30_000 });
  await page.locator('.picture canvas').waitFor();
  const found = { title: await page.title(), workers: page.workers().length };
  await page.close();
  await serving.close();
  return found;
}

describe('the npm package', () => {
  it('adapts a mesh in Node', () => {
    writeFileSync(
      join(work, 'run.mjs'),
      `import { openMesh } from 'pillowmesh/core';
       import 'pillowmesh'; // the element's module does no harm where there is no document
       const mesh = await openMesh({ kind: 'grid', spec: 'grid:4,4:0,1,0,1' });
       const { outcome, report } = await mesh.adapt({ formula: 'h = 0.05 + 0.2*x' });
       const file = await mesh.file('a.mesh');
       const solid = await openMesh({ kind: 'case', name: 'linear3d' });
       await openMesh({ kind: 'grid', spec: 'grid:0' }).catch((error) => console.log(error.name));
       console.log(outcome.status, report.mesh.cells > 60, file.length > 1000, solid.arrays().dim);
       mesh.close();`,
    );
    const said = execFileSync(process.execPath, ['run.mjs'], { cwd: work, encoding: 'utf8' });
    expect(said).toBe('CoreError\nok true true 3\n');
  });

  it('has types that a strict program compiles against, and that refuse what is wrong', () => {
    writeFileSync(
      join(work, 'typed.ts'),
      `import { openMesh, type MeshEvent } from 'pillowmesh/core';
import { PillowMeshElement } from 'pillowmesh/element';
const figure = document.createElement('pillow-mesh');
figure.addEventListener('step', ({ detail }) => detail.position.toFixed());
figure.position = 3;
export const element: PillowMeshElement = figure;
export async function main(events: MeshEvent[]): Promise<void> {
  const mesh = await openMesh({ kind: 'case', name: 'iso2d' });
  await mesh.adapt(undefined, {}, (more) => events.push(...more));
  // @ts-expect-error a position is a number
  figure.position = 'last';
  // @ts-expect-error no such kind of mesh
  await openMesh({ kind: 'cube' });
}
`,
    );
    const tsc = createRequire(import.meta.url).resolve('typescript/package.json').replace('package.json', 'bin/tsc');
    const options = ['--ignoreConfig', '--noEmit', '--strict', '--target', 'es2022', '--module', 'esnext', '--lib', 'es2024,dom,dom.iterable'];
    execFileSync(process.execPath, [tsc, ...options, '--moduleResolution', 'bundler', '--types', '', 'typed.ts'], {
      cwd: work,
      encoding: 'utf8',
    });
  });

  it('is bundled by Vite, worker and modules included', async () => {
    const project = join(work, 'vite');
    mkdirSync(project, { recursive: true });
    writeFileSync(join(project, 'app.js'), app);
    writeFileSync(join(project, 'index.html'), '<!doctype html><script type="module" src="./app.js"></script>');
    await vite({ root: project, configFile: false, base: './', logLevel: 'error', build: { outDir: 'out', target: 'es2022' } });
    expect(readdirSync(join(project, 'out', 'assets')).some((name) => name.endsWith('.wasm'))).toBe(true);
    expect(await titleOf(join(project, 'out'))).toEqual({ title: 'shrink 3', workers: 1 });
  });

  it('is bundled by esbuild, with worker and modules copied beside the bundle', async () => {
    const out = join(work, 'esbuild');
    mkdirSync(out, { recursive: true });
    writeFileSync(join(work, 'app.js'), app);
    await esbuild({
      entryPoints: [join(work, 'app.js')],
      outdir: out,
      bundle: true,
      splitting: true,
      format: 'esm',
      minify: true,
      logLevel: 'error',
    });
    for (const name of readdirSync(join(unpacked, 'dist')))
      if (/\.wasm$|^worker\.js$/.test(name)) cpSync(join(unpacked, 'dist', name), join(out, name));
    writeFileSync(join(out, 'index.html'), '<!doctype html><script type="module" src="./app.js"></script>');
    expect(await titleOf(out)).toEqual({ title: 'shrink 3', workers: 1 });
  });

  it('has a single file that needs nothing beside it', async () => {
    const folder = join(work, 'single');
    mkdirSync(folder, { recursive: true });
    cpSync(join(unpacked, 'dist', 'pillow-mesh.standalone.js'), join(folder, 'mesh.js'));
    const script = app.replace(/^import.*$/m, '');
    writeFileSync(
      join(folder, 'index.html'),
      `<!doctype html><body><script src="mesh.js"></script><script>${script}</script></body>`,
    );
    expect((await titleOf(folder)).title).toBe('shrink 3');
  });

  it('holds no more than it should', () => {
    const manifest = JSON.parse(readFileSync(join(unpacked, 'package.json'), 'utf8')) as { exports: object; version: string };
    const own = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8')) as { version: string };
    expect(manifest.version).toBe(own.version);
    expect(readdirSync(unpacked).sort()).toEqual(['LICENSE', 'README.md', 'dist', 'package.json', 'types']);
    const modules = readdirSync(join(unpacked, 'dist')).filter((name) => name.endsWith('.wasm'));
    expect(modules.length).toBe(readdirSync(join(root, 'build', 'wasm')).filter((name) => name.endsWith('.wasm')).length);
    const code = readFileSync(join(unpacked, 'dist', 'element.js'), 'utf8');
    expect(code).not.toContain('WebGLRenderer');
  });
});
