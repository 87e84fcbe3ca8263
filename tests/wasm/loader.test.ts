import { gzipSync } from 'node:zlib';
import { describe, expect, test } from 'vitest';
import { CrashError, LoadError, loadCore } from '../../wasm/loader.ts';
import { Session } from '../../wasm/session.ts';
import { load, moduleBytes } from './core.ts';

/** The reason and sentence with which loading must fail. */
async function failure(source: Parameters<typeof loadCore>[0]): Promise<{ reason: string; message: string }> {
  try {
    await loadCore(source);
  } catch (error) {
    if (error instanceof LoadError) return { reason: error.reason, message: error.message };
    throw error;
  }
  throw new Error('it loaded');
}

describe('the loader', () => {
  test('says when the module cannot be fetched', async () => {
    expect(await failure('http://127.0.0.1:9/pillowmesh.wasm')).toMatchObject({ reason: 'missing' });
  });

  test('says when a file is damaged, and when it is something else', async () => {
    expect(await failure(moduleBytes(2).subarray(0, 1000))).toMatchObject({ reason: 'broken' });
    const empty = Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0);
    expect((await failure(empty)).message).toContain('not the core');
    expect((await failure(moduleBytes('files'))).message).toContain('not the core');
  });

  test('shares a compiled module between instances that do not know each other', async () => {
    const first = await load();
    const second = await loadCore(first.module);
    expect(second.exports.memory).not.toBe(first.exports.memory);
  });

  test('turns a trap into an error that says that the core has stopped', async () => {
    const { exports, module } = await load();
    const trap = (): never => {
      throw new WebAssembly.RuntimeError('unreachable');
    };
    const session = new Session({ exports: { ...exports, pm_load_grid: trap }, module });
    expect(() => session.load({ kind: 'grid', spec: 'grid:1,1:0,1,0,1' })).toThrow(CrashError);
  });
});

describe('the module', () => {
  test('imports nothing but a clock and what ends a program', () => {
    const names = ([2, 'full', 3, 'files'] as const)
      .flatMap((which) => WebAssembly.Module.imports(new WebAssembly.Module(moduleBytes(which))))
      .map(({ name }) => name);
    const known = [
      'clock_time_get',
      'proc_exit',
      'environ_get',
      'environ_sizes_get',
      'fd_write',
      'fd_read',
      'fd_seek',
      'fd_close',
      'emscripten_notify_memory_growth',
    ];
    expect(names.filter((name) => !known.includes(name))).toEqual([]);
  });

  const limits = [
    [2, 150_000],
    ['full', 200_000],
    [3, 200_000],
    ['files', 60_000],
    ['metrics', 180_000],
  ] as const;
  for (const [which, limit] of limits)
    test(`${which} is at most ${limit} bytes when compressed`, () => {
      expect(gzipSync(moduleBytes(which), { level: 9 }).length).toBeLessThanOrEqual(limit);
    });
});
