// Builds the site: pages, element, and the single script. Usage: node scripts/site.mjs [FOLDER], build/site by default.
// Needs the WebAssembly modules (npm run build).
import { join, resolve } from 'node:path';
import { build } from 'vite';
import { isMain, main, root } from './run.mjs';

export async function buildSite(folder = join(root, 'build', 'site')) {
  const web = (name) => join(root, 'web', name);
  const common = { logLevel: 'error' };
  await build({ ...common, configFile: web('vite.config.ts'), build: { outDir: folder, emptyOutDir: true } });
  await build({ ...common, configFile: web('vite.standalone.ts'), build: { outDir: folder } });
}

if (isMain(import.meta)) await main(() => buildSite(process.argv[2] && resolve(process.argv[2])));
