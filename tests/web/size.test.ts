// What visitors download, compressed by gzip.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { expect, test } from 'vitest';
import { site } from './site.ts';

const files = (): string[] =>
  readdirSync(site, { recursive: true })
    .map(String)
    .filter((name) => /\.(js|css|wasm)$/.test(name));
const size = (name: string): number => gzipSync(readFileSync(join(site, name)), { level: 9 }).length;
const total = (names: string[]): number => names.reduce((sum, name) => sum + size(name), 0);

/** What a page loads before anything else: its scripts, what they import at once, its style sheets. */
function firstPaint(page: string): string[] {
  const html = readFileSync(join(site, page), 'utf8');
  return [...new Set([...html.matchAll(/(?:src|href)="\.?\.?\/([^"]+\.(?:js|css))"/g)].map((match) => match[1]))].filter(
    (name) => !name.includes('fallback'),
  );
}

test('what the first paint needs is at most 40 kB', () => {
  for (const page of ['index.html', 'embed.html', 'lessons/metric.html']) {
    const names = firstPaint(page);
    expect(names.length).toBeGreaterThan(1);
    expect(total(names), `${page}: ${names.join(' ')}`).toBeLessThanOrEqual(40_000);
  }
});

test('three.js comes in a part of its own, after the first paint', () => {
  const three = files().filter((name) => /assets\/three-.*\.js$/.test(name));
  expect(three.length).toBe(1);
  expect(total(three)).toBeGreaterThan(60_000);
  for (const page of ['index.html', 'embed.html']) expect(firstPaint(page)).not.toContain(three[0]);
});

test('all code of our own is at most 90 kB, the worker at most 10 kB', () => {
  const own = files().filter((name) => /\.(js|css)$/.test(name) && !/three-|standalone/.test(name));
  expect(own.length).toBeGreaterThan(8);
  expect(total(own), own.map((name) => `${name} ${size(name)}`).join('\n')).toBeLessThanOrEqual(90_000);
  const worker = own.filter((name) => /worker-/.test(name));
  expect(Math.max(...worker.map(size))).toBeLessThanOrEqual(10_000);
});

test('each WebAssembly module is at most 200 kB', () => {
  const modules = files().filter((name) => name.endsWith('.wasm'));
  expect(modules.length).toBeGreaterThan(2);
  for (const name of modules) expect(size(name), name).toBeLessThanOrEqual(200_000);
});
