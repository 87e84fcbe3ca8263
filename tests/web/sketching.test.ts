// Drawing a metric by hand, and a mesh that follows it.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { decodeSketch, encodeSketch, formulaOfSketch, simplified, type Stroke } from '../../web/src/sketch/sketch.ts';
import { complaints, eventually, page, part, visit } from './browsing.ts';
import { screenshots } from './site.ts';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
interface Axe {
  run(): Promise<{ violations: { id: string }[] }>;
}
const cells = async (): Promise<number> => Number((await page.locator('.facts dd').first().innerText()).replace(/,/g, ''));
const status = (): Promise<string> => page.locator('.status').innerText();
/** Cells of the answer, when the numbers have followed what is shown. */
async function counted(): Promise<number> {
  const told = Number(/^[\d,]+/.exec(await status())![0].replace(/,/g, ''));
  await expect.poll(cells, eventually).toBe(told);
  return told;
}
const done = () => expect.poll(() => page.locator('.following').isHidden(), eventually).toBe(true);

describe('sketching', () => {
  test('the mesh follows while a stroke is drawn, then improves; stop, undo, redo and a link keep what is shown', async () => {
    await visit('#mesh=grid:6,6:0,1,0,1&metric=h %3D 0.2&hide=ellipses', { bypassCSP: true });
    await page.getByRole('button', { name: 'Draw', exact: true }).click();
    await page.getByRole('slider', { name: 'Size' }).fill('0.03');
    await page.getByRole('slider', { name: 'Stretch' }).fill('3');
    expect(await page.getByRole('slider', { name: 'Stretch' }).getAttribute('aria-valuetext')).toBe('3 : 1');
    const box = (await page.locator('.picture canvas').boundingBox())!;
    const at = (x: number, y: number): [number, number] => [box.x + box.width * x, box.y + box.height * y];
    await page.mouse.move(...at(0.35, 0.4));
    await page.mouse.down();
    for (let i = 1; i <= 8; ++i) await page.mouse.move(...at(0.35 + 0.04 * i, 0.4 + 0.04 * Math.sin(i)));
    await expect.poll(cells, eventually).toBeGreaterThan(60); // the button is still down
    expect(part('sketch')).toBe(null);
    expect(await page.locator('.board ellipse').count()).toBeGreaterThan(2);
    await page.mouse.up();
    await expect.poll(() => part('sketch'), eventually).toMatch(/^0\.03,3:/);
    expect(part('method')).toBe('full');
    expect(part('event')).toBe('last');
    await expect.poll(() => page.locator('.following [data-state=done]').count(), eventually).toBeGreaterThan(0);
    await page.screenshot({ path: join(screenshots, 'following.png') });
    await page.evaluate(axe);
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme });
      expect(await page.evaluate(() => (window as never as { axe: Axe }).axe.run().then(({ violations }) => violations.map(({ id }) => id)))).toEqual([]);
    }
    await done();
    expect(await status()).toMatch(/^\d+ quads in [\d.]+ s\.$/);
    const one = await counted();

    await page.getByLabel('Effort').selectOption('fast'); // from here on the first answer is the last
    await done();
    await page.mouse.move(...at(0.5, 0.25));
    await page.mouse.down();
    await page.mouse.move(...at(0.52, 0.75), { steps: 4 });
    await page.mouse.up();
    await expect.poll(() => part('sketch')?.split(';').length, eventually).toBe(2);
    await done();
    const two = await counted();
    expect(two).not.toBe(one);
    await page.screenshot({ path: join(screenshots, 'sketch.png') });
    const { hash } = new URL(page.url());

    await page.getByRole('button', { name: 'Undo' }).click();
    await expect.poll(() => page.locator('.board polyline').count(), eventually).toBe(1);
    await done();
    await page.getByRole('button', { name: 'Redo' }).click();
    await expect.poll(() => page.locator('.board polyline').count(), eventually).toBe(2);
    await done();
    await expect.poll(cells, eventually).toBe(two);

    await page.getByLabel('Effort').selectOption('best');
    await expect.poll(() => page.locator('.following [data-state=done]').count(), eventually).toBeGreaterThan(0);
    await page.getByRole('button', { name: 'Stop' }).click();
    await done();
    await expect.poll(() => part('event'), eventually).toMatch(/^(last|\d+)$/);
    await page.getByRole('button', { name: 'Clear' }).click();
    await expect.poll(cells, eventually).toBe(36);
    expect(complaints).toEqual([]);
    await visit(hash);
    await done();
    await expect.poll(cells, eventually).toBe(two);
    expect(complaints).toEqual([]);
  });

  test('can be done by keys alone', async () => {
    await visit('#mesh=grid:6,6:0,1,0,1&metric=h %3D 0.2&hide=ellipses&method=full&effort=fast');
    await page.getByRole('button', { name: 'Draw', exact: true }).press('Enter');
    const board = page.getByRole('application', { name: 'Drawing board' });
    await board.focus();
    for (const key of ['ArrowLeft', 'ArrowLeft', ' ', 'ArrowRight', 'ArrowRight', 'ArrowDown']) await page.keyboard.press(key);
    expect(await page.locator('.board .brush').count()).toBe(1);
    await page.keyboard.press('Shift+ArrowDown');
    await page.keyboard.press(' ');
    await expect.poll(() => part('sketch'), eventually).toMatch(/^0\.012,1:(-?[\d.]+,?){4,}$/);
    await done();
    expect(await cells()).toBeGreaterThan(60);
    await page.keyboard.press('Escape');
    await expect.poll(() => page.locator('.board').count()).toBe(0);
  });

  test('a better answer takes the picture over when it is as fine, not while coarse meshes are searched', async () => {
    await visit('#mesh=grid:6,6:0,1,0,1&metric=h %3D 0.012%2B0.06*x&method=full&effort=best&event=last&hide=ellipses');
    // Effort best: quicker ones may be over before the picture is drawn once.
    // The picture's name tells how many cells an answer had when it took the picture over.
    await page.evaluate(() => {
      const picture = document.querySelector('.picture')!;
      const taken = ((window as never as { taken: string[][] }).taken = []) as string[][];
      new MutationObserver(() => {
        taken.push([document.querySelector('.status')!.textContent!, picture.getAttribute('aria-label')!]);
      }).observe(picture, { attributeFilter: ['aria-label'] });
    });
    await expect.poll(status, eventually).toMatch(/^[\d,]+ quads in [\d.]+ s\.$/);
    const taken = await page.evaluate(() => (window as never as { taken: string[][] }).taken);
    const better = taken.filter(([told]) => told.includes('Improving'));
    expect(better.length).toBeGreaterThan(0);
    const number = (words: string): number => Number(/[\d,]+/.exec(words)![0].replace(/,/g, ''));
    for (const [first, name] of better) expect(number(name)).toBeGreaterThan(0.7 * number(first));
  });

  test('looking at another moment ends the search for better answers', async () => {
    await visit('#mesh=grid:6,6:0,1,0,1&metric=h %3D 0.02%2B0.1*x&method=full&effort=best&event=last&hide=ellipses');
    await expect.poll(() => page.locator('.following [data-state=done]').count(), eventually).toBeGreaterThan(0);
    await page.locator('h1').click();
    await page.keyboard.press('Home');
    await done();
    expect(await status()).toMatch(/^(?!36 )\d+ quads in [\d.]+ s\.$/); // of the answer, not of what is looked at
    await expect.poll(cells, eventually).toBe(36); // the numbers follow what is shown
    expect(await page.locator('.counter').innerText()).toMatch(/^0 \//);
    await page.keyboard.press('End');
    await expect.poll(cells, eventually).toBeGreaterThan(100);
  });
});

describe('a sketch', () => {
  test('is written and read back as it was, and simplified within its tolerance', () => {
    const strokes = [{ size: 0.02, stretch: 4, points: [[0, 0], [0.5, -0.25]] as [number, number][] }];
    expect(decodeSketch(encodeSketch(strokes))).toEqual(strokes);
    expect(decodeSketch('nonsense;0.1,1:1;;x,y:1,2')).toEqual([]);
    expect(formulaOfSketch([], 0.3)).toBe('h = 0.3');
    const line = Array.from({ length: 50 }, (_, i) => [i, i % 2 ? 0.05 : 0] as [number, number]);
    expect(simplified(line, 0.1)).toEqual([[0, 0], [49, 0.05]]);
    expect(simplified([[0, 0], [1, 1], [2, 0]], 0.1).length).toBe(3);
  });

  /** h1, h2 and theta of a formula; h alone for both. */
  function sizesOf(formula: string): (x: number, y: number) => { h1: number; h2: number; theta: number } {
    const names = [...formula.matchAll(/(\w+) =/g)].map((match) => match[1]);
    const code = formula.replaceAll('^', '**').replace(/\b(sqrt|min|max|atan2)\(/g, 'Math.$1(');
    const body = `${code.replace(/(\w+) =/g, 'const $1 =')}; return { ${names.filter((n) => /^h|theta/.test(n)).join(', ')} };`;
    const evaluate = new Function('x', 'y', body) as (x: number, y: number) => Record<string, number>;
    return (x, y) => {
      const { h = 0, h1 = h, h2 = h, theta = 0 } = evaluate(x, y);
      return { h1, h2, theta };
    };
  }
  const cross: Stroke[] = [
    { size: 0.01, stretch: 8, points: [[0.1, 0.5], [0.9, 0.5]] },
    { size: 0.01, stretch: 8, points: [[0.5, 0.1], [0.5, 0.9]] },
  ];

  test('asks for cells of the size and direction of its stroke there, and of the far size away from it', () => {
    const at = sizesOf(formulaOfSketch([{ size: 0.01, stretch: 5, points: [[0.2, 0.2], [0.6, 0.6]] }], 0.2));
    const on = at(0.4, 0.4);
    expect(on.h2).toBeCloseTo(0.01, 5);
    expect(on.h1).toBeCloseTo(0.05, 5);
    expect(on.theta).toBeCloseTo(Math.PI / 4, 6);
    const far = at(9, -9);
    expect(far.h1).toBeCloseTo(0.2, 2);
    expect(far.h2).toBeCloseTo(0.2, 2);
    const round = sizesOf(formulaOfSketch([{ size: 0.1, stretch: 1, points: [[1, 2]] }], 2))(1, 2);
    expect(round.h1).toBeCloseTo(0.1, 5);
  });

  test('asks for cells that are small in both directions where two strokes cross, and has no jump anywhere', () => {
    const at = sizesOf(formulaOfSketch(cross, 0.2));
    expect(at(0.5, 0.5).h1).toBeLessThan(0.0101);
    expect(at(0.7, 0.5).h1).toBeCloseTo(0.08, 2);
    expect(at(0.7, 0.5).theta).toBeCloseTo(0, 3);
    expect(Math.abs(at(0.5, 0.7).theta)).toBeCloseTo(Math.PI / 2, 3);
    /** Logarithm of the tensor, as its mean and its vector of twice the angle. */
    const log = (x: number, y: number): number[] => {
      const { h1, h2, theta } = at(x, y);
      const [mean, half] = [-Math.log(h1 * h2), Math.log(h1 / h2)];
      return [mean, half * Math.cos(2 * theta), half * Math.sin(2 * theta)];
    };
    let steepest = 0;
    const step = 1e-5;
    for (let i = 0; i < 60_000; ++i) {
      const [x, y] = [0.2 + i * step, 0.43 + 0.17 * i * step]; // past the crossing
      const [a, b] = [log(x, y), log(x + step, y + 0.17 * step)];
      steepest = Math.max(steepest, ...a.map((value, k) => Math.abs(value - b[k])));
    }
    expect(steepest).toBeLessThan(0.01); // a jump would be of the order of 1, however small the step
  });
});
