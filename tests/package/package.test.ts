import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, renameSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { beforeAll, describe, expect, it } from 'vitest';

const here = fileURLToPath(new URL('.', import.meta.url));
const root = join(here, '../..');
const work = join(root, 'build/package');
const prefix = join(work, 'prefix');

/** Runs a program; its output is the test's message when it fails. */
function run(program: string, args: string[], env: Record<string, string> = {}): string {
  return execFileSync(program, args, { encoding: 'utf8', env: { ...process.env, ...env } });
}

/** Configures tests/package/KIND as a user's project. */
function configure(kind: string, ...options: string[]): string {
  const folder = join(work, kind);
  run('cmake', ['-S', join(here, kind), '-B', folder, '-G', 'Ninja', '-DCMAKE_BUILD_TYPE=Release', ...options]);
  return folder;
}

/** Builds it too, and runs what it built. */
function buildAndRun(kind: string, ...options: string[]): string {
  const folder = configure(kind, ...options);
  run('cmake', ['--build', folder, '-j2']);
  return run(join(folder, 'consumer'), []);
}

beforeAll(() => {
  rmSync(prefix, { recursive: true, force: true });
  mkdirSync(work, { recursive: true });
  // Installed in one place and used from another: nothing in the tree may remember where it was.
  run('cmake', ['--install', join(root, 'build/release'), '--prefix', `${prefix}-first`]);
  renameSync(`${prefix}-first`, prefix);
});

describe('an installed copy', () => {
  it('serves a program through find_package', () => {
    expect(buildAndRun('installed', `-DCMAKE_PREFIX_PATH=${prefix}`)).toMatch(/^\d+ quads\n$/);
  });

  it('serves a program through pkg-config', () => {
    const folder = run('find', [prefix, '-name', 'pillowmesh.pc', '-printf', '%h']);
    const flags = run('pkg-config', ['--cflags', '--libs', 'pillowmesh'], { PKG_CONFIG_PATH: folder });
    const program = join(work, 'pkg-config-consumer');
    run('c++', ['-std=c++20', join(here, 'consumer.cpp'), '-o', program, ...flags.trim().split(/\s+/)]);
    expect(run(program, [])).toMatch(/^\d+ quads\n$/);
  });

  it('contains the command, which knows its version', () => {
    const { version } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8')) as { version: string };
    expect(run(join(prefix, 'bin/pillowmesh'), ['--version'])).toContain(version);
  });

  it('contains headers only for what users include', () => {
    expect(existsSync(join(prefix, 'include/pillowmesh/mesh/mesh.h'))).toBe(true);
    expect(existsSync(join(prefix, 'include/third_party'))).toBe(false);
  });
});

describe('the source tree', () => {
  // Compiling the core again is most of the time of this suite: as quickly as may be, and ccache, where there is one, has it.
  const ccache = ['-DCMAKE_CXX_COMPILER_LAUNCHER=ccache', '-DCMAKE_C_COMPILER_LAUNCHER=ccache'];
  const quick = ['-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG', '-DCMAKE_UNITY_BUILD=ON'];
  const launcher = existsSync('/usr/bin/ccache') ? ccache : [];

  it('serves a program as a subproject, as a shared library', () => {
    expect(buildAndRun('subproject', '-DBUILD_SHARED_LIBS=ON', ...quick, ...launcher)).toMatch(/^\d+ quads\n$/);
  });

  it('is configured by FetchContent, which gives the program the same target', () => {
    // Not built a second time: from here on it is a subproject.
    const folder = configure('fetched');
    expect(run('ninja', ['-C', folder, '-t', 'query', 'consumer'])).toMatch(/libpillowmesh\./);
  });
});
