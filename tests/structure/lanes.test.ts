// In which order npm test builds and runs.
import { setTimeout as pause } from 'node:timers/promises';
import { expect, test } from 'vitest';
// @ts-expect-error plain JavaScript without types: it runs before TypeScript is installed
import { inLanes } from '../../scripts/lanes.mjs';

type Failed = (name: string, error: Error | null) => void;
const run = inLanes as (tasks: object[], lanes: number, failed: Failed) => Promise<void>;
const unexpected: Failed = (name, error) => expect.unreachable(`${name}: ${error?.message}`);

test('a task begins when what it needs has ended, and never are there more than lanes', async () => {
  const said: string[] = [];
  let busy = 0;
  const task = (name: string, needs: string[]) => ({
    name,
    needs,
    run: async () => {
      expect(++busy).toBeLessThanOrEqual(2);
      said.push(`${name} begins`);
      await pause(5);
      said.push(`${name} ends`);
      --busy;
    },
  });
  await run([task('page', ['wasm', 'native']), task('wasm', []), task('native', []), task('command', ['native'])], 2, unexpected);
  expect(said.length).toBe(8);
  expect(said.indexOf('page begins')).toBeGreaterThan(said.indexOf('wasm ends'));
  expect(said.indexOf('page begins')).toBeGreaterThan(said.indexOf('native ends'));
  expect(said.indexOf('command begins')).toBeGreaterThan(said.indexOf('native ends'));
  expect(said.slice(0, 2)).toEqual(['wasm begins', 'native begins']); // side by side
});

test('what needs a task that failed is not run, and the rest is', async () => {
  const ran: string[] = [];
  const failures: string[] = [];
  const task = (name: string, needs: string[]) => ({ name, needs, run: async () => void ran.push(name) });
  const broken = { name: 'wasm', needs: [], run: () => Promise.reject(new Error('no compiler')) };
  await run([task('page', ['parity']), task('parity', ['wasm']), broken, task('types', [])], 2, (name, error) =>
    failures.push(`${name}: ${error?.message}`),
  );
  expect(ran).toEqual(['types']);
  expect(failures).toEqual(['wasm: no compiler', 'parity: undefined', 'page: undefined']);
});
