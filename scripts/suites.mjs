// How each kind of suite is run, and how its tests are counted: always from the runner's machine-readable output.
import { existsSync, readFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { output, root, run } from './run.mjs';
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
export function catch2(name, folder) {
  const report = join(folder, `${name}.xml`);
  const ok = run('ctest', ['--test-dir', 'build/release', '--output-on-failure', '--no-tests=error', '--progress',
    '-j', String(availableParallelism()), '--output-junit', report]);
  if (!existsSync(report)) return result(0, 0, ok);
  const suite = /<testsuite\b[^>]*>/.exec(readFileSync(report, 'utf8'))?.[0] ?? '';
  const number = (key) => Number(new RegExp(`\\b${key}="(\\d+)"`).exec(suite)?.[1] ?? 0);
  const failures = number('failures') + number('errors');
  return result(number('tests') - failures - number('skipped') - number('disabled'), failures, ok);
}

/** No colour codes in a log file. */
const colours = process.stdout.isTTY ? {} : { NO_COLOR: '1' };

/** A project of vitest.config.ts. */
export function vitest(name, folder) {
  const report = join(folder, `${name}.json`);
  const program = join(root, 'node_modules', 'vitest', 'vitest.mjs');
  const ok = run(process.execPath, [program, 'run', '--project', name, '--reporter=default', '--reporter=json',
    `--outputFile=${report}`], { env: { PILLOWMESH_CHROMIUM: chromium(), CI: '1', ...colours } });
  if (!existsSync(report)) return result(0, 0, ok);
  const { numPassedTests, numFailedTests } = JSON.parse(readFileSync(report, 'utf8'));
  return result(numPassedTests, numFailedTests, ok);
}

/** Python tests in tests/NAME, with Debian's Python, which has meshio. */
export function unittest(name) {
  const line = output('/usr/bin/python3', ['scripts/unittest_json.py', join('tests', name)]).trim().split('\n').at(-1);
  if (!line) return result(0, 0, false);
  const { passed, failed } = JSON.parse(line);
  return result(passed, failed, failed === 0);
}

/** The type checker over all TypeScript: one test. */
export function typescript() {
  const ok = run(process.execPath, [join(root, 'node_modules', 'typescript', 'bin', 'tsc'), '--noEmit']);
  return result(ok ? 1 : 0, ok ? 0 : 1, ok);
}
