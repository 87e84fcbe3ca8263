// The npm package: ES modules in build/npm/dist, three.js left to the user. scripts/package.mjs names the entries: the
// worker is built by itself, so that a bundler can copy it as one file.
import { copyFileSync, mkdirSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { defineConfig, type Plugin } from 'vite';

const web = dirname(fileURLToPath(import.meta.url));
const wasm = join(web, '../build/wasm');
export const out = join(web, '../build/npm/dist');

/** `import url from '.../x.wasm?url'` becomes an address beside the code, which every bundler understands. */
function besideTheCode(): Plugin {
  return {
    name: 'beside-the-code',
    enforce: 'pre',
    resolveId: (source) => {
      if (source.endsWith('/server_code.ts')) return join(web, 'src/stage/server_code_bundled.ts');
      const name = /([\w-]+\.wasm)\?url$/.exec(source)?.[1] ?? (source.endsWith('worker.ts?worker&url') ? 'worker.js' : null);
      return name ? `\0beside:${name}` : null;
    },
    load: (id) => {
      const name = /^\0beside:(.+)/.exec(id)?.[1];
      return name ? `export default new URL(${JSON.stringify(`./${name}`)}, import.meta.url).href;` : null;
    },
    // Vite writes '' + import.meta.url where it has found no file, which hides the addresses from the next bundler.
    generateBundle(_, bundle) {
      for (const chunk of Object.values(bundle))
        if (chunk.type === 'chunk') chunk.code = chunk.code.replace(/(?:``|''|"")\s*\+\s*import\.meta\.url/g, 'import.meta.url');
    },
    closeBundle() {
      mkdirSync(out, { recursive: true });
      for (const name of readdirSync(wasm)) if (name.endsWith('.wasm')) copyFileSync(join(wasm, name), join(out, name));
    },
  };
}

export default defineConfig({
  root: web,
  publicDir: false,
  plugins: [besideTheCode()],
  build: {
    outDir: out,
    emptyOutDir: false,
    target: 'es2022',
    cssTarget: ['chrome123', 'firefox120', 'safari17.5'],
    minify: true,
    rolldownOptions: {
      external: /^(three|node:)/,
      preserveEntrySignatures: 'strict',
      output: {
        format: 'es',
        entryFileNames: '[name].js',
        chunkFileNames: 'parts/[name]-[hash].js',
      },
    },
  },
});
