// The single classic script pillow-mesh.standalone.js.
import { readFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { defineConfig, type Plugin } from 'vite';

const web = dirname(fileURLToPath(import.meta.url));

/** `import text from 'x.wasm?packed'`: compressed, as base64. */
function packed(): Plugin {
  return {
    name: 'packed',
    enforce: 'pre',
    resolveId(source, importer) {
      if (source.endsWith('.wasm?packed') && importer) return `\0${resolve(dirname(importer), source)}`;
      // Worker and modules are fetched from nowhere.
      if (source.endsWith('/core_pool.ts')) return join(web, 'src/stage/core_pool_inline.ts');
      return null;
    },
    load(id) {
      if (!id.endsWith('.wasm?packed')) return null;
      const bytes = readFileSync(id.slice(1).replace('?packed', ''));
      return `export default ${JSON.stringify(gzipSync(bytes, { level: 9 }).toString('base64'))};`;
    },
  };
}

export default defineConfig({
  root: web,
  publicDir: false,
  plugins: [packed()],
  worker: { format: 'iife' },
  build: {
    emptyOutDir: false,
    target: 'es2022',
    cssTarget: ['chrome123', 'firefox120', 'safari17.5'],
    chunkSizeWarningLimit: 2000,
    lib: {
      entry: join(web, 'src/standalone/index.ts'),
      name: 'PillowMesh',
      formats: ['iife'],
      fileName: () => 'pillow-mesh.standalone.js',
    },
  },
});
