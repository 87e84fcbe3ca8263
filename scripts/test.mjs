// npm test: installs what is missing, builds native and WebAssembly, runs every suite, and ends with one line
// `N passed, N failed`. Usage: npm test [-- SUITE...]; a suite that ran no test counts as failed.
import { closeSync, mkdirSync, openSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { build } from './build.mjs';
import { inLanes } from './lanes.mjs';
import { Failure, root, start as run } from './run.mjs';
import { setup } from './setup.mjs';
import { catch2, typescript, unittest, vitest } from './suites.mjs';

/** Each suite with the builds that it looks at, those first that take long; in parts, which may run side by side. */
const suites = {
  package: { run: vitest, needs: ['release', 'site'] },
  core: { run: catch2, needs: ['release'] },
  web: { run: vitest, needs: ['wasm', 'site'], parts: 3 },
  parity: { run: vitest, needs: ['release', 'wasm'] },
  cli: { run: vitest, needs: ['release'] },
  wasm: { run: vitest, needs: ['wasm'] },
  io: { run: unittest, needs: ['release'] },
  types: { run: typescript, needs: [] },
  structure: { run: vitest, needs: [] },
};

const chosen = process.argv.slice(2);
const unknown = chosen.filter((name) => !(name in suites));
if (unknown.length > 0) {
  console.error(`No suite named ${unknown.join(', ')}. Suites: ${Object.keys(suites).join(' ')}`);
  process.exit(2);
}
const names = Object.keys(suites).filter((name) => chosen.length === 0 || chosen.includes(name));

const results = join(root, 'build', 'test-results');
rmSync(results, { recursive: true, force: true });
mkdirSync(results, { recursive: true });

const rows = [];
const since = (start) => (Date.now() - start) / 1000;

// One thing at a time leaves cores idle: links, the last sources of a build, a test that waits for the browser. So two are
// done at a time, with half of the cores for each.
const lanes = Math.min(2, availableParallelism());
const jobs = Math.ceil(availableParallelism() / lanes);

async function make(name) {
  const start = Date.now();
  // In a process of its own: Vite is loaded and freed there, and is not installed before setup has run.
  if (name !== 'site') await build(name, { jobs });
  else if (!(await run(process.execPath, ['scripts/site.mjs']))) throw new Failure('building the site failed (see above)');
  console.log(`Built ${name} in ${since(start).toFixed(1)} s`);
}

/** What a suite prints is shown when it has ended, so that two at a time can be read. */
async function runSuite(name, part) {
  const start = Date.now();
  const title = part ? `${name}${part.number}` : name;
  const log = join(results, `${title}.log`);
  const to = openSync(log, 'w');
  console.log(`Running ${title}; what it prints goes to build/test-results/${title}.log first`);
  const { count, note } = await suites[name].run(name, { folder: results, to, jobs, part });
  closeSync(to);
  console.log(`\n=== ${title}\n${readFileSync(log, 'utf8')}`);
  // A runner that fails without a failed test (a crash, a file that does not load) is a failure too.
  if (count.passed + count.failed === 0) count.failed = 1;
  if (note) console.error(`${title}: ${note}`);
  rows.push({ name: title, ...count, seconds: since(start) });
}

/** A suite's tasks for the lanes, one for each part. */
function tasksOf(name) {
  const { needs, parts } = suites[name];
  if (!parts) return [{ name, needs, run: () => runSuite(name) }];
  return Array.from({ length: parts }, (_, i) => {
    const part = { number: i + 1, of: parts };
    return { name: `${name}${part.number}`, needs, run: () => runSuite(name, part) };
  });
}

try {
  setup('test');
  const needed = new Set(names.flatMap((name) => suites[name].needs));
  const builds = { release: [], wasm: [], site: ['wasm'] };
  const tasks = [
    ...Object.entries(builds).filter(([name]) => needed.has(name)).map(([name, needs]) => ({ name, needs, run: () => make(name) })),
    ...names.flatMap(tasksOf),
  ];
  await inLanes(tasks, lanes, (name, error) => {
    if (error !== null && !(error instanceof Failure)) throw error;
    console.error(error === null ? `${name}: not run, since what it needs has failed` : `\n${error.message}`);
    rows.push({ name, passed: 0, failed: 1, seconds: 0 });
  });
} catch (error) {
  if (!(error instanceof Failure)) throw error;
  console.error(`\n${error.message}`);
  rows.push({ name: 'setup', passed: 0, failed: 1, seconds: 0 });
}

console.log('\nsuite        passed  failed seconds');
for (const { name, passed, failed, seconds } of rows) {
  const numbers = [passed, failed, seconds.toFixed(1)].map((number) => String(number).padStart(8));
  console.log(`${name.padEnd(11)}${numbers.join('')}`);
}
const sum = (key) => rows.reduce((total, row) => total + row[key], 0);
const summary = `${sum('passed')} passed, ${sum('failed')} failed`;
writeFileSync(join(results, 'summary.txt'), `${summary}\n`);
console.log(summary);
process.exit(sum('failed') > 0 ? 1 : 0);
