// Makes the npm package in build/npm and packs it. Usage: node scripts/package.mjs [FOLDER for the archive]; needs the
// WebAssembly modules (npm run build) and the site's single script (scripts/site.mjs).
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { build } from 'vite';
import { Failure, isMain, main, output, root, run } from './run.mjs';

const folder = join(root, 'build', 'npm');
const own = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'));

const entry = (types, code) => ({ types: `./types/${types}.d.ts`, default: `./dist/${code}.js` });

/** What the package says of itself. three.js is the user's, and only those who draw need it. */
const manifest = {
  name: own.name,
  version: own.version,
  description: own.description,
  license: own.license,
  author: own.author,
  keywords: ['mesh', 'quad', 'hex', 'anisotropic', 'adaptation', 'metric', 'custom-element', 'wasm'],
  type: 'module',
  engines: { node: '>=20.19' },
  files: ['dist', 'types'],
  sideEffects: ['./dist/element.js', './dist/pillow-mesh.standalone.js'],
  exports: {
    '.': entry('web/src/element/index', 'element'),
    './element': entry('web/src/element/index', 'element'),
    './core': entry('wasm/core', 'core'),
    './worker': entry('wasm/worker', 'worker'),
    './wasm/*': './dist/*',
    './standalone': './dist/pillow-mesh.standalone.js',
    './package.json': './package.json',
  },
  peerDependencies: { three: `>=${own.devDependencies.three.replace('^', '')}` },
  peerDependenciesMeta: { three: { optional: true } },
};

/** Makes the package's folder. */
export async function makePackage() {
  rmSync(folder, { recursive: true, force: true });
  const entries = { element: 'web/src/element/index.ts', core: 'wasm/core.ts', worker: 'wasm/worker.ts' };
  for (const names of [['element', 'core'], ['worker']]) {
    const input = Object.fromEntries(names.map((name) => [name, join(root, entries[name])]));
    await build({
      configFile: join(root, 'web', 'vite.package.ts'),
      logLevel: 'error',
      build: { rolldownOptions: { input } },
    });
  }
  const tsc = join(root, 'node_modules', 'typescript', 'bin', 'tsc');
  if (!run(process.execPath, [tsc, '-p', 'web/tsconfig.package.json'])) throw new Failure('the types could not be made');
  const single = { configFile: join(root, 'web', 'vite.standalone.ts'), logLevel: 'error' };
  await build({ ...single, build: { outDir: join(folder, 'dist') } });
  copyFileSync(join(root, 'docs', 'npm.md'), join(folder, 'README.md'));
  copyFileSync(join(root, 'LICENSE'), join(folder, 'LICENSE'));
  writeFileSync(join(folder, 'package.json'), `${JSON.stringify(manifest, null, 2)}\n`);
}

/** The archive's path. */
export function pack(target = join(root, 'build')) {
  mkdirSync(target, { recursive: true });
  const said = output('npm', ['pack', folder, '--pack-destination', target, '--json', '--loglevel=error']);
  const parsed = JSON.parse(said);
  const [{ filename }] = Array.isArray(parsed) ? parsed : Object.values(parsed);
  return join(target, filename);
}

if (isMain(import.meta))
  await main(async () => {
    await makePackage();
    console.log(pack(process.argv[2]));
  });
