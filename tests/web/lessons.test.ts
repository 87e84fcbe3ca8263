// The lessons, read and done as a student would.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { errorOf, solve, squares } from '../../web/src/lesson/q1.ts';
import { exact, needed, source } from '../../web/src/lesson/shock.ts';
import { formulaOf } from '../../web/src/lesson/tag_editor.ts';
import type { PillowMeshElement } from '../../web/src/element/pillow_mesh.ts';
import { complaints, eventually, newPage, page, serving } from './browsing.ts';
import { root, screenshots, site } from './site.ts';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const lessons = JSON.parse(readFileSync(join(root, 'web/lessons/lessons.json'), 'utf8')) as { file: string; title: string }[];
async function visit(address: string, width = 1000, height = 800): Promise<void> {
  await newPage({ viewport: { width, height }, bypassCSP: true });
  await page.goto(address);
}
const lesson = (file: string, width?: number): Promise<void> => visit(`${serving.address}lessons/${file}`, width);
const caption = (id: string): Promise<string> => page.locator(`#${id} .caption .text`).innerText();
const position = (id: string): Promise<number> => page.locator(`#${id}`).evaluate((e) => (e as PillowMeshElement).position);
const cells = (id: string): Promise<number> =>
  page.locator(`#${id}`).evaluate((e) => {
    const { dim, cells } = (e as PillowMeshElement).mesh;
    return cells.filter((corner, i) => i % 2 ** dim === 0 && corner >= 0).length;
  });
/** Figures load near the window: goes past all of them. */
async function readToTheEnd(): Promise<void> {
  for (const figure of await page.locator('pillow-mesh').all()) {
    await figure.scrollIntoViewIfNeeded();
    await figure.locator('.picture canvas').waitFor();
  }
}

describe('every lesson', () => {
  for (const { file, title } of [{ file: 'index.html', title: 'How meshes' }, ...lessons])
    test(`${file}: figures draw, the question is checked, axe has nothing to say, nothing is wider than a phone`, async () => {
      await lesson(file, 320);
      expect(await page.locator('h1').innerText()).toContain(title);
      await readToTheEnd();
      const question = page.locator('form.question');
      if ((await question.count()) > 0) {
        await question.getByRole('button', { name: 'Check' }).click();
        expect(await question.locator('output').innerText()).toContain('Choose');
        await question.locator('input[value=wrong]').first().check();
        await question.getByRole('button', { name: 'Check' }).click();
        expect(await question.locator('output').innerText()).toContain('Not quite.');
        await question.locator('input[value=right]').check();
        await question.getByRole('button', { name: 'Check' }).click();
        expect(await question.locator('output').innerText()).toMatch(/Yes\. \w+/);
      }
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(320);
      await page.evaluate(axe);
      for (const colorScheme of ['light', 'dark'] as const) {
        await page.emulateMedia({ colorScheme });
        const violations = await page.evaluate(async () => {
          const { axe } = window as unknown as {
            axe: { run(): Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> };
          };
          return (await axe.run()).violations.map(({ id, nodes }) => `${id}: ${nodes.map((n) => n.html).join(' ')}`);
        });
        expect(violations).toEqual([]);
      }
      expect(complaints).toEqual([]);
      if (file === 'pillowing.html') await page.screenshot({ path: join(screenshots, 'lesson-phone-dark.png') });
    });
});

describe('tags by hand', () => {
  test('tag exactly the edges that are clicked, by pointer and by keys', async () => {
    await lesson('pillowing.html');
    await expect.poll(() => caption('f3'), eventually).toContain('3 edges are tagged');
    await page.getByRole('button', { name: 'none', exact: true }).click();
    await expect.poll(() => caption('f3'), eventually).toContain('20 quads');
    await page.getByRole('checkbox', { name: 'horizontal edge, column 2, row 2' }).click();
    await expect.poll(() => caption('f3'), eventually).toContain('1 edge is tagged');
    await page.keyboard.press('ArrowUp');
    await page.keyboard.press(' ');
    await expect.poll(() => caption('f3'), eventually).toContain('2 edges are tagged');
    expect(await page.getByRole('checkbox', { checked: true }).count()).toBe(2);
    await page.locator('#f3').getByRole('button', { name: 'Step forward' }).click();
    await expect.poll(() => caption('f3'), eventually).toContain('3 quads joined');
    await page.screenshot({ path: join(screenshots, 'lesson-tags.png') });
  });

  test('are a metric in which all other edges measure 1', () => {
    expect(formulaOf([])).toBe('h1 = 1; h2 = 1; theta = 0');
    expect(formulaOf([{ axis: 0, i: 1, j: 2 }])).toBe(
      'h1 = if(max(abs(x - 1.5), abs(y - 2)) < 0.24, 0.12, 1); h2 = 1; theta = 0',
    );
  });
});

describe('buttons beside a figure', () => {
  test('change its metric', async () => {
    await lesson('metric.html');
    await expect.poll(() => caption('f1'), eventually).toContain('36 quads');
    await page.getByRole('button', { name: 'stretched aslant' }).click();
    await expect.poll(() => page.locator('#f1').evaluate((e) => (e as PillowMeshElement).link), eventually).toContain('theta');
    expect(await page.getByRole('button', { name: 'stretched aslant' }).getAttribute('aria-pressed')).toBe('true');
  });

  test('adapt in full, and cut hexahedra open', async () => {
    await lesson('full-adaptation.html');
    await expect.poll(() => position('f7'), eventually).toBeGreaterThan(10);
    const before = await cells('f7');
    await page.getByRole('button', { name: 'full adaptation' }).click();
    await expect.poll(() => cells('f7'), { timeout: 100_000 }).toBeLessThan(0.6 * before);
    await page.context().close();
    await lesson('hexahedra.html');
    await page.locator('#f8').scrollIntoViewIfNeeded();
    await expect.poll(() => position('f8'), eventually).toBeGreaterThan(10);
    const whole = await page.locator('#f8').screenshot();
    await page.getByRole('button', { name: 'cut', exact: true }).click();
    await expect.poll(async () => (await page.locator('#f8').screenshot()).equals(whole), eventually).toBe(false);
  });
});

describe('the solver loop', () => {
  test('solves, adapts to what it has found, and falls below equal squares', async () => {
    await lesson('solver-loop.html');
    const row = (i: number): Promise<string[]> => page.locator('.solver-loop tbody tr').nth(i).locator('td').allInnerTexts();
    await expect.poll(() => page.locator('rect.uniform').count(), eventually).toBe(4);
    expect(await row(0)).toEqual(['start', '256', '0.15', '']);
    await page.locator('#f9').scrollIntoViewIfNeeded();
    for (const turn of [1, 2]) {
      await page.getByRole('button', { name: 'One turn' }).click();
      await expect.poll(() => page.locator('.solver-loop tbody tr').count(), { timeout: 100_000 }).toBe(turn + 1);
    }
    const [, quads, error, needed] = await row(2);
    expect(Number(quads)).toBe(await cells('f9'));
    expect(Number(quads)).toBeLessThan(400);
    expect(Number(error)).toBeLessThan(0.02);
    expect(Number(needed.replace(/,/g, ''))).toBeGreaterThan(2000);
    await page.screenshot({ path: join(screenshots, 'lesson-loop.png') });
    await page.getByRole('button', { name: 'From the start' }).click();
    await expect.poll(() => cells('f9')).toBe(256);
    expect(complaints).toEqual([]);
  });

  test('has a solver that is exact for linear functions, and the errors that the native example has', () => {
    const linear = (x: number, y: number): number => 1 + 2 * x - 3 * y;
    const crooked = squares(5);
    crooked.points = crooked.points.map((x, i) => (crooked.boundary[i >> 1] ? x : x + 0.05 * Math.sin(7 * i)));
    expect(errorOf(crooked, solve(crooked, () => 0, linear), linear)).toBeLessThan(1e-9);
    for (const [n, error] of [[16, 0.151], [32, 0.0364]] as const) // docs/convergence.md
      expect(errorOf(squares(n), solve(squares(n), source, exact), exact) / error).toBeCloseTo(1, 2);
    expect(needed([{ cells: 100, error: 0.04 }, { cells: 400, error: 0.01 }], 0.0025)).toBeCloseTo(1600, 6);
  });
});

test('a lesson works from a folder without a server', async () => {
  await visit(`file://${join(site, 'lessons/layers-and-corners.html')}`);
  await expect.poll(() => position('f5'), eventually).toBeGreaterThan(10);
  await page.getByRole('button', { name: 'by two' }).click();
  await page.locator('form.question input[value=right]').check();
  await page.getByRole('button', { name: 'Check' }).click();
  expect(await page.locator('form.question output').innerText()).toContain('Yes.');
});
