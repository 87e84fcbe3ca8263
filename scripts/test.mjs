// npm test: installs what is missing, builds native and WebAssembly, runs every suite, and ends with one line
// `N passed, N failed`. Usage: npm test [-- SUITE...]; a suite that ran no test counts as failed.
import { mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { build } from './build.mjs';
import { Failure, root } from './run.mjs';
import { setup } from './setup.mjs';
import { catch2, typescript, unittest, vitest } from './suites.mjs';

const suites = {
  structure: vitest,
  types: typescript,
  core: catch2,
  cli: vitest,
  io: unittest,
  package: vitest,
  wasm: vitest,
  parity: vitest,
  web: vitest,
};

const chosen = process.argv.slice(2);
const unknown = chosen.filter((name) => !(name in suites));
if (unknown.length > 0) {
  console.error(`No suite named ${unknown.join(', ')}. Suites: ${Object.keys(suites).join(' ')}`);
  process.exit(2);
}

const results = join(root, 'build', 'test-results');
rmSync(results, { recursive: true, force: true });
mkdirSync(results, { recursive: true });

const rows = [];
let passed = 0;
let failed = 0;
function add(name, count, seconds) {
  rows.push({ name, ...count, seconds });
  passed += count.passed;
  failed += count.failed;
}

try {
  setup('test');
  build('release');
  build('wasm');
  for (const name of chosen.length > 0 ? chosen : Object.keys(suites)) {
    console.log(`\n=== ${name}`);
    const start = Date.now();
    const { count, note } = await suites[name](name, results);
    // A runner that fails without a failed test (a crash, a file that does not load) is a failure too.
    if (count.passed + count.failed === 0) count.failed = 1;
    if (note) console.error(`${name}: ${note}`);
    add(name, count, (Date.now() - start) / 1000);
  }
} catch (error) {
  if (!(error instanceof Failure)) throw error;
  console.error(`\n${error.message}`);
  add('build', { passed: 0, failed: 1 }, 0);
}

console.log('\nsuite        passed  failed seconds');
for (const { name, passed, failed, seconds } of rows) {
  const numbers = [passed, failed, seconds.toFixed(1)].map((number) => String(number).padStart(8));
  console.log(`${name.padEnd(11)}${numbers.join('')}`);
}
const summary = `${passed} passed, ${failed} failed`;
writeFileSync(join(results, 'summary.txt'), `${summary}\n`);
console.log(summary);
process.exit(failed > 0 ? 1 : 0);
