// How each kind of suite is run, and how its tests are counted: always from the runner's machine-readable output.
// `place` is where and how: { folder: of the reports, to: a file descriptor for what is printed, jobs: at a time }.
import { existsSync, readFileSync } from 'node:fs';
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

/** A project of vitest.config.ts. */
export async function vitest(name, { folder, to, jobs }) {
  const report = join(folder, `${name}.json`);
  const program = join(root, 'node_modules', 'vitest', 'vitest.mjs');
  const ok = await start(process.execPath, [program, 'run', '--project', name, '--reporter=default', '--reporter=json',
    `--outputFile=${report}`], { to, env: { PILLOWMESH_CHROMIUM: chromium(), PILLOWMESH_JOBS: String(jobs), CI: '1', ...colours } });
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
