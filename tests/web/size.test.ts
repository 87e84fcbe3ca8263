import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { beforeAll, expect, test } from 'vitest';
import { buildSite, root } from './site.ts';

const assets = join(root, 'build', 'site', 'assets');
const compressed = (pattern: RegExp): number =>
  readdirSync(assets)
    .filter((name) => pattern.test(name))
    .reduce((sum, name) => sum + gzipSync(readFileSync(join(assets, name)), { level: 9 }).length, 0);

beforeAll(buildSite);

test('what the first paint needs is at most 40 kB compressed', () => {
  expect(compressed(/^index-.*\.(js|css)$/)).toBeLessThanOrEqual(40_000);
});

test('three.js comes in a part of its own, after the first paint', () => {
  const html = readFileSync(join(root, 'build', 'site', 'index.html'), 'utf8');
  expect(html).not.toContain('assets/viewport');
  expect(compressed(/^viewport-.*\.js$/)).toBeGreaterThan(60_000);
});

test('the worker is at most 10 kB compressed', () => {
  expect(compressed(/^worker-.*\.js$/)).toBeLessThanOrEqual(10_000);
});
