import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { expect, test } from 'vitest';
import { eventually, visit } from './browsing.ts';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

const states = {
  quads: 'case=iso2d&event=3&colour=shape',
  hexes: 'case=linear3d&event=3&colour=shape&cut=slab:-90,0,0.6,0.5&peel=0&edges=irregular',
};

for (const colorScheme of ['light', 'dark'] as const)
  for (const [width, cells] of [[1280, 'quads'], [360, 'quads'], [1280, 'hexes'], [360, 'hexes']] as const)
    test(`axe finds nothing to complain of: ${cells}, ${colorScheme}, ${width} pixels wide`, async () => {
      const page = await visit(`#${states[cells]}`, { colorScheme, viewport: { width, height: 800 }, bypassCSP: true });
      await expect.poll(() => page.locator('.counter').innerText(), eventually).toMatch(/^3 \/ \d+$/);
      await page.evaluate(axe);
      const violations = await page.evaluate(async () => {
        const { axe } = window as unknown as {
          axe: { run(): Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> };
        };
        return (await axe.run()).violations.map(({ id, nodes }) => `${id}: ${nodes.map((n) => n.html).join(' ')}`);
      });
      expect(violations).toEqual([]);
    });
