// Small helpers that the other scripts share. Plain Node: they run before any package is installed.
import { spawn, spawnSync } from 'node:child_process';
import { accessSync, constants } from 'node:fs';
import { delimiter, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

/** The repository's root folder. */
export const root = dirname(dirname(fileURLToPath(import.meta.url)));

/** A failure that is the user's to mend: printed without a stack. */
export class Failure extends Error {}

/** The full path of a command on PATH, or null. */
export function which(command) {
  for (const folder of (process.env.PATH ?? '').split(delimiter)) {
    const path = join(folder, command);
    try {
      accessSync(path, constants.X_OK);
      return path;
    } catch {}
  }
  return null;
}

/**
 * Runs a command in the root folder, its output going where ours goes; `stdout: 2` sends all of it to stderr.
 * @returns true when it ended with status 0
 */
export function run(command, args, { env = {}, quiet = false, stdout = 1, cwd = root } = {}) {
  const result = spawnSync(command, args, {
    cwd,
    env: { ...process.env, ...env },
    stdio: quiet ? 'ignore' : ['ignore', stdout, 2],
  });
  return result.status === 0;
}

/**
 * The same without waiting. `to`: a file descriptor for all of its output.
 * @returns a promise of true when it ended with status 0
 */
export function start(command, args, { env = {}, to, stdout = 1, cwd = root } = {}) {
  return new Promise((resolve) => {
    const child = spawn(command, args, {
      cwd,
      env: { ...process.env, ...env },
      stdio: ['ignore', to ?? stdout, to ?? 2],
    });
    child.on('error', () => resolve(false));
    child.on('close', (status) => resolve(status === 0));
  });
}

/** Standard output of a command, '' when it cannot be run. Its exit status is not looked at. */
export function output(command, args, { cwd = root } = {}) {
  const stdio = ['ignore', 'pipe', 'inherit'];
  return spawnSync(command, args, { cwd, stdio, encoding: 'utf8', maxBuffer: 1 << 28 }).stdout ?? '';
}

/** True when the module is the program that Node was asked to run. */
export function isMain(meta) {
  return process.argv[1] === fileURLToPath(meta.url);
}

/** Runs `body`; a Failure ends the process with its message and status 1. */
export async function main(body) {
  try {
    await body();
  } catch (error) {
    if (!(error instanceof Failure)) throw error;
    console.error(`\n${error.message}`);
    process.exit(1);
  }
}
