import { readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { defineConfig, type Plugin } from 'vite';
import { lessonFrame } from './lesson_frame.ts';

const web = dirname(fileURLToPath(import.meta.url));

/** Every page of the site by its name. */
const pages = Object.fromEntries(
  ['.', 'lessons']
    .flatMap((folder) => readdirSync(join(web, folder)).map((name) => join(folder, name)))
    .filter((path) => path.endsWith('.html'))
    .map((path) => [path.replace(/\.html$/, '').replace('/', '-'), join(web, path)]),
);

/** The page asks for no more than this; said in the built page, since the development server injects scripts. */
const policy =
  "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' blob: data:; object-src 'none'";

function contentSecurityPolicy(): Plugin {
  return {
    name: 'content-security-policy',
    apply: 'build',
    transformIndexHtml: () => [
      {
        tag: 'meta',
        attrs: { 'http-equiv': 'Content-Security-Policy', content: policy },
        injectTo: 'head-prepend',
      },
    ],
  };
}

/** The front page asks for its core at once, beside the code that will. */
function preloadCore(): Plugin {
  return {
    name: 'preload-core',
    apply: 'build',
    transformIndexHtml: {
      order: 'post',
      handler: (_, { bundle, filename }) =>
        filename === join(web, 'index.html')
          ? Object.keys(bundle ?? {})
              .filter((name) => /pillowmesh-[^/]*\.wasm$/.test(name))
              .map((name) => ({
                tag: 'link',
                attrs: { rel: 'preload', as: 'fetch', crossorigin: '', href: `./${name}` },
                injectTo: 'head',
              }))
          : [],
    },
  };
}

/** Shaders without their comments and indentation. */
function shortShaders(): Plugin {
  return {
    name: 'short-shaders',
    transform: (code, id) =>
      id.endsWith('shaders.ts')
        ? code.replace(/`[^`]*`/g, (shader) => shader.replace(/\/\/.*$/gm, '').replace(/\s*\n\s*/g, '\n').replace(/ ([=+*/<>?:,-]|&&|[-+*/]=) /g, '$1'))
        : null,
  };
}

/** Where no worker can be started a page imports the worker's file: what it exports stays. */
function keepExports(): Plugin {
  return { name: 'keep-exports', options: (options) => ({ ...options, preserveEntrySignatures: 'strict' }) };
}

export default defineConfig({
  root: web,
  base: './', // works from any folder of any static host
  plugins: [lessonFrame(), contentSecurityPolicy(), preloadCore(), shortShaders()],
  server: { fs: { allow: [dirname(web)] } },
  worker: { format: 'es', plugins: () => [keepExports()] },
  build: {
    outDir: 'dist',
    emptyOutDir: true,
    target: 'es2022',
    cssTarget: ['chrome123', 'firefox120', 'safari17.5'], // those that know light-dark()
    modulePreload: { polyfill: false }, // every browser that knows light-dark() has it
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 900, // three.js, loaded when the first frame stands
    rolldownOptions: {
      input: { ...pages, 'pillow-mesh': join(web, 'src/element/index.ts') },
      preserveEntrySignatures: 'allow-extension',
      // Other sites write this name into their pages.
      output: {
        entryFileNames: ({ name }) => (name === 'pillow-mesh' ? '[name].js' : 'assets/[name]-[hash].js'),
        // What is wanted together comes together: many small parts compress badly.
        codeSplitting: {
          includeDependenciesRecursively: false,
          groups: [
            { name: 'three', test: /node_modules[\\/]three/ },
            { name: 'drawing', test: /src[\\/]viewport[\\/](?!palette)|stage[\\/]pointing|inside[\\/](anatomy|facets|irregular_edges|chords|relief|measures|neighbours)/ },
            { name: 'sketching', test: /src[\\/]sketch[\\/]|app[\\/](sketching|following)|style[\\/](sketch|following)/ },
            { name: 'numbers', test: /panels[\\/](indicators\.|histogram|statistics)|data[\\/]published/ },
            { name: 'extras', test: /src[\\/]export[\\/]|app[\\/](saving|compare\.|brightness|camera_picture)|panels[\\/](help|embed_dialog|look_inside\.)/ },
            { name: 'common', test: /wasm[\\/]events|inside[\\/]look_inside|state[\\/]|ui[\\/]dom|replay[\\/]caption/ },
          ],
        },
      },
    },
  },
});
