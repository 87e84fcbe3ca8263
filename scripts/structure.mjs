// The one-way dependency rule over #include and import, and a look at file lengths and at what must not be committed.
// Usage: node scripts/structure.mjs
import { existsSync, readFileSync } from 'node:fs';
import { dirname, join, normalize } from 'node:path';
import { isMain, output, root } from './run.mjs';

/**
 * The layers from the bottom up: a file may depend on its own layer and on lower ones. Layers of one row stand side by
 * side and do not know each other.
 */
const layers = [
  ['third_party'],
  ['mesh'],
  ['metric'],
  ['quality'],
  ['refine', 'coarsen', 'reconnect', 'smooth'],
  ['adapt'],
  ['io'],
  ['cli', 'c_api', 'examples', 'bench'],
  ['session'],
  ['web'],
];
/** Topology is testable without geometry: `refine` takes metric lengths or tags, not fields. */
const forbidden = [['refine', 'metric']];

/** The layer of a repository path; null for what the rule is not about (tests, scripts, documentation). */
export function layerOf(path) {
  const core = /^core\/pillowmesh\/([a-z_]+)\//.exec(path);
  if (core) return core[1];
  if (path.startsWith('core/third_party/')) return 'third_party';
  if (/^wasm\/.*\.(h|cpp)$/.test(path)) return 'c_api';
  if (/^wasm\/.*\.ts$/.test(path)) return 'session';
  if (path.endsWith('.mjs')) return null;
  const folder = /^(cli|examples|bench|web)\//.exec(path);
  return folder ? folder[1] : null;
}

const rank = (layer) => layers.findIndex((row) => row.includes(layer));

/** What `text`, the content of the file at `path`, includes or imports of this repository: [{ target, line }]. */
export function dependencies(path, text) {
  const found = [];
  const lines = text.split('\n');
  const isCode = /\.(h|hpp|c|cpp)$/.test(path);
  const pattern = isCode
    ? /^\s*#\s*include\s+["<]([^">]+)[">]/
    : /(?:\bfrom\s*|\bimport\s*\(?\s*|\bnew URL\(\s*)['"]([^'"]+)['"]/;
  lines.forEach((content, index) => {
    const name = pattern.exec(content)?.[1];
    const target = name && (isCode ? resolveInclude(path, name) : resolveImport(path, name));
    if (target) found.push({ target, line: index + 1 });
  });
  return found;
}

function resolveInclude(path, name) {
  if (name.startsWith('pillowmesh/') || name.startsWith('third_party/')) return `core/${name}`;
  const beside = normalize(join(dirname(path), name));
  if (existsSync(join(root, beside))) return beside;
  return existsSync(join(root, name)) ? name : null;
}

function resolveImport(path, name) {
  if (!name.startsWith('.')) return null;
  const target = normalize(join(dirname(path), name.replace(/[?#].*$/, '')));
  const candidates = [target, target.replace(/\.js$/, '.ts'), `${target}.ts`, `${target}/index.ts`];
  return candidates.find((candidate) => /\.\w+$/.test(candidate) && existsSync(join(root, candidate))) ?? target;
}

/** What is wrong with the dependencies of one file, a sentence each. */
export function violations(path, text) {
  const from = layerOf(path);
  if (from === null) return [];
  if (rank(from) < 0) return [`${path}: the layer "${from}" has no place in the order of scripts/structure.mjs`];
  const wrong = [];
  for (const { target, line } of dependencies(path, text)) {
    const to = layerOf(target);
    if (to === null) {
      const product = !/^(tests|scripts)\//.test(target);
      if (!product) wrong.push(`${path}:${line}: depends on ${target}, which is not product code`);
    } else if (to !== from && rank(to) >= rank(from)) {
      wrong.push(`${path}:${line}: ${from} must not depend on ${to} (${target})`);
    } else if (forbidden.some(([a, b]) => a === from && b === to)) {
      wrong.push(`${path}:${line}: ${from} must not know ${to} (${target})`);
    }
  }
  return wrong;
}

/** Groups of files that include each other in a circle, as lists of paths. `files`: Map from path to content. */
export function cycles(files) {
  const found = [];
  const state = new Map();
  const trail = [];
  const visit = (path) => {
    if (state.get(path) === 'done' || !files.has(path)) return;
    if (state.get(path) === 'open') {
      found.push([...trail.slice(trail.indexOf(path)), path]);
      return;
    }
    state.set(path, 'open');
    trail.push(path);
    for (const { target } of dependencies(path, files.get(path))) if (target !== path) visit(target);
    trail.pop();
    state.set(path, 'done');
  };
  for (const path of files.keys()) visit(path);
  return found;
}

/** Download addresses and paths of somebody's machine. */
const private_ = /"resolved":\s*"https?:|registry\.npmjs\.org|\/home\/\w+\/|\/work\/(?:main|shared)\b|\/tmp\/build-/;

/** Lines that must not be committed, as `path:line: text`. */
export function privateLines(path, text) {
  const lines = text.split('\n').map((line, index) => ({ line, number: index + 1 }));
  return lines.filter(({ line }) => private_.test(line)).map(({ line, number }) => `${path}:${number}: ${line.trim()}`);
}

/** All files of the repository, committed or about to be added, as a Map from path to content. */
export function repositoryFiles() {
  const paths = output('git', ['ls-files', '--cached', '--others', '--exclude-standard']).split('\n');
  const binary = /\.(png|jpg|gz|bin|ico|woff2|meshb)$/;
  const text = paths.filter((path) => path && existsSync(join(root, path)) && !binary.test(path));
  return new Map(text.map((path) => [path, readFileSync(join(root, path), 'utf8')]));
}

const isSource = (path) => /\.(h|c|cpp|ts|mjs|py)$/.test(path) && !path.startsWith('core/third_party/');
export const lengthLimit = 400;

/** Everything at once: { sources, dependencies, violations, cycles, privateLines, long }. */
export function inspect(files = repositoryFiles()) {
  const sources = new Map([...files].filter(([path]) => isSource(path)));
  const all = [...sources];
  return {
    sources: sources.size,
    dependencies: all.reduce((sum, [path, text]) => sum + dependencies(path, text).length, 0),
    violations: all.flatMap(([path, text]) => violations(path, text)),
    cycles: cycles(sources),
    // This file and its test name the patterns that they look for.
    privateLines: [...files].filter(([path]) => !/structure\b.*\.(mjs|ts)$/.test(path))
      .flatMap(([path, text]) => privateLines(path, text)),
    long: all.map(([path, text]) => ({ path, lines: text.split('\n').length - 1 }))
      .filter(({ lines }) => lines > lengthLimit).sort((a, b) => b.lines - a.lines),
  };
}

if (isMain(import.meta)) {
  const found = inspect();
  for (const { path, lines } of found.long) console.log(`long: ${path}, ${lines} lines (aim: ${lengthLimit} at most)`);
  const wrong = [...found.violations, ...found.cycles.map((c) => `circle: ${c.join(' -> ')}`), ...found.privateLines];
  for (const line of wrong) console.error(line);
  console.log(`${found.sources} sources, ${found.dependencies} dependencies, ${wrong.length} violations`);
  process.exit(wrong.length > 0 ? 1 : 0);
}
