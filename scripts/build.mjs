// Builds CMake presets; ninja rebuilds only what changed.
// Usage: node scripts/build.mjs [PRESET...], default: release wasm
import { existsSync, readFileSync, rmSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { Failure, isMain, main, root, start } from './run.mjs';

/**
 * Configures (once) and builds a preset of CMakePresets.json, with so many compilers at a time. Everything printed goes to
 * stderr, or to the file descriptor `to`.
 */
export async function build(preset, { jobs = availableParallelism(), to } = {}) {
  const folder = join(root, 'build', preset);
  const cache = join(folder, 'CMakeCache.txt');
  // A checkout that was moved or copied with its build folder cannot go on with it.
  if (existsSync(cache) && !readFileSync(cache, 'utf8').includes(`CMAKE_HOME_DIRECTORY:INTERNAL=${root}\n`)) {
    rmSync(folder, { recursive: true });
  }
  if (!existsSync(join(folder, 'build.ninja'))) {
    console.error(`Configuring ${preset}`);
    if (!(await start('cmake', ['--preset', preset], { stdout: 2, to }))) throw new Failure(`cmake --preset ${preset} failed (see above)`);
  }
  console.error(`Building ${preset}`);
  if (!(await start('cmake', ['--build', '--preset', preset, '-j', String(jobs)], { stdout: 2, to }))) {
    throw new Failure(`building ${preset} failed (see above)`);
  }
}

if (isMain(import.meta)) {
  const presets = process.argv.slice(2);
  await main(async () => {
    for (const preset of presets.length > 0 ? presets : ['release', 'wasm']) await build(preset);
  });
}
