// How each kind of suite is run, and how its tests are counted: always from the runner's machine-readable output.
// `place` is where and how: { folder: of the reports, to: a file descriptor for what is printed, jobs: at a time,
// part: { number, of } where a suite's files are shared out }.
import { existsSync, readFileSync, readdirSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { root, start } from './run.mjs';
import { chromium } from './setup.mjs';

/** What a runner's exit status says, beside the counts. */
function result(passed, failed, ok) {
  const silent = !ok && failed === 0;
  return {
    count: { passed, failed: silent ? 1 : failed },
    note: silent ? 'the runner ended with an error, or did not run at all' : passed + failed === 0 ? 'no test ran' : '',
  };
}

/** Catch2 through ctest, every test case a process of its own. */
export async function catch2(name, { folder, to, jobs }) {
  const report = join(folder, `${name}.xml`);
  const ok = await start('ctest', ['--test-dir', 'build/release', '--output-on-failure', '--no-tests=error', '--progress',
    '-j', String(jobs), '--output-junit', report], { to });
  if (!existsSync(report)) return result(0, 0, ok);
  const suite = /<testsuite\b[^>]*>/.exec(readFileSync(report, 'utf8'))?.[0] ?? '';
  const number = (key) => Number(new RegExp(`\\b${key}="(\\d+)"`).exec(suite)?.[1] ?? 0);
  const failures = number('failures') + number('errors');
  return result(number('tests') - failures - number('skipped') - number('disabled'), failures, ok);
}

/** No colour codes in a log file. */
const colours = process.stdout.isTTY ? {} : { NO_COLOR: '1' };

/** The test files of a suite that are one of its parts: the largest first, each to the part that has least so far. */
function filesOf(name, { number, of }) {
  const folder = join('tests', name);
  const files = readdirSync(join(root, folder)).filter((file) => file.endsWith('.test.ts'))
    .map((file) => ({ path: join(folder, file), bytes: statSync(join(root, folder, file)).size }))
    .sort((a, b) => b.bytes - a.bytes || (a.path < b.path ? -1 : 1));
  const parts = Array.from({ length: of }, () => ({ bytes: 0, paths: [] }));
  for (const { path, bytes } of files) {
    const least = parts.reduce((a, b) => (b.bytes < a.bytes ? b : a));
    least.bytes += bytes;
    least.paths.push(path);
  }
  return parts[number - 1].paths;
}

/** A project of vitest.config.ts; what its global setup would build is there. */
export async function vitest(name, { folder, to, jobs, part }) {
  const report = join(folder, `${name}${part?.number ?? ''}.json`);
  const program = join(root, 'node_modules', 'vitest', 'vitest.mjs');
  const files = part ? filesOf(name, part) : [];
  const ok = await start(process.execPath, [program, 'run', '--project', name, '--reporter=default', '--reporter=json',
    `--outputFile=${report}`, ...files], {
    to,
    env: { PILLOWMESH_CHROMIUM: chromium(), PILLOWMESH_JOBS: String(jobs), PILLOWMESH_SITE: 'built', CI: '1', ...colours },
  });
  if (!existsSync(report)) return result(0, 0, ok);
  const { numPassedTests, numFailedTests } = JSON.parse(readFileSync(report, 'utf8'));
  return result(numPassedTests, numFailedTests, ok);
}

/** Python tests in tests/NAME, with Debian's Python, which has meshio. */
export async function unittest(name, { folder, to }) {
  const report = join(folder, `${name}.json`);
  const ok = await start('/usr/bin/python3', ['scripts/unittest_json.py', join('tests', name), report], { to });
  if (!existsSync(report)) return result(0, 0, ok);
  const { passed, failed } = JSON.parse(readFileSync(report, 'utf8'));
  return result(passed, failed, ok);
}

/** The type checker over all TypeScript: one test. */
export async function typescript(name, { to }) {
  const ok = await start(process.execPath, [join(root, 'node_modules', 'typescript', 'bin', 'tsc'), '--noEmit'], { to });
  return result(ok ? 1 : 0, ok ? 0 : 1, ok);
}
