import { availableParallelism } from 'node:os';
import { defineConfig } from 'vitest/config';

/** How much is run at a time: what scripts/test.mjs says, or as the machine has cores. */
const jobs = Number(process.env.PILLOWMESH_JOBS) || availableParallelism();

// One project per suite of scripts/test.mjs. The suites that build, start programs or drive a browser run one file at
// a time: the machine may have two cores.
const project = (name: string, timeout: number, serial = true, globalSetup: string[] = []) => ({
  test: {
    name,
    include: [`tests/${name}/**/*.test.ts`],
    environment: 'node' as const,
    testTimeout: timeout,
    hookTimeout: timeout,
    expect: { poll: { timeout: timeout / 2 } }, // a busy machine is no failure
    fileParallelism: !serial,
    // Vitest would leave one core free, which of two is half.
    maxWorkers: serial ? 1 : jobs,
    globalSetup,
  },
});

export default defineConfig({
  test: {
    projects: [
      project('structure', 20_000, false),
      project('cli', 60_000),
      project('package', 600_000),
      project('wasm', 60_000, false),
      project('parity', 120_000),
      project('web', 120_000, true, ['tests/web/build_site.ts']),
    ],
  },
});
