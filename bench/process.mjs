// Runs a program and measures it from outside.
import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';

/** Peak memory comes from GNU time where there is one (Debian: time), else it is NaN. */
const gnuTime = existsSync('/usr/bin/time') ? '/usr/bin/time' : null;

/** @returns wall seconds, peak resident bytes of the process, exit status */
export function timed(command, args, cwd) {
  const start = process.hrtime.bigint();
  const [program, words] = gnuTime ? [gnuTime, ['-f', 'peak_kb=%M', command, ...args]] : [command, args];
  const { status, stderr } = spawnSync(program, words, { cwd, encoding: 'utf8', maxBuffer: 1 << 28 });
  const seconds = Number(process.hrtime.bigint() - start) / 1e9;
  const peak = /peak_kb=(\d+)/.exec(stderr ?? '')?.[1];
  return { seconds, peakBytes: peak ? Number(peak) * 1024 : Number.NaN, status, stderr };
}
