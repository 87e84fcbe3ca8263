// What stands around the picture: cases by pictures, options of a method, a number of cells, keys, files, messages.
import { expect, test } from 'vitest';
import { complaints, eventually, newPage, page, part, pictureNow, serving, visit } from './browsing.ts';

const fact = (name: string) => page.locator('.facts > div', { hasText: name }).locator('dd');
const number = async (name: string): Promise<number> => Number((await fact(name).innerText()).replace(/,/g, ''));
const message = () => page.locator('.message');
const settled = () => expect.poll(() => page.locator('.status').innerText(), eventually).toMatch(/ in [\d.]+ s/);

test('a case is chosen by its picture, and the picture is marked', async () => {
  await visit();
  const circle = page.locator('.gallery').getByRole('button', { name: 'Circle' });
  await expect.poll(() => circle.locator('.thumb').evaluate((e) => getComputedStyle(e).maskImage)).toContain('circle2d.svg');
  await circle.click();
  await expect.poll(() => part('case'), eventually).toBe('circle2d');
  expect(await circle.getAttribute('aria-pressed')).toBe('true');
  expect(await page.locator('.gallery [aria-pressed=true]').count()).toBe(1);
  expect(await page.locator('#case').inputValue()).toBe('circle2d');
  await page.locator('#case').selectOption('larsson1'); // not pictured
  await expect.poll(() => page.locator('.gallery [aria-pressed=true]').count(), eventually).toBe(0);
  for (const thumb of await page.locator('.gallery button').all()) {
    const name = await thumb.getAttribute('data-case');
    expect((await page.request.get(`${serving.address}cases/${name}.svg`)).ok(), name ?? '').toBe(true);
  }
  expect(complaints).toEqual([]);
});

test('a number of cells is met; undo and a link know it', async () => {
  await visit('#case=circle2d');
  const before = await number('Ideal');
  await page.getByLabel('Cells', { exact: true }).fill('600');
  await page.getByLabel('Cells', { exact: true }).press('Enter');
  await expect.poll(() => number('Ideal'), eventually).toBe(600);
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await settled();
  await page.locator('h1').click();
  await page.keyboard.press('End');
  await expect.poll(() => number('Cells'), eventually).toBeGreaterThan(540);
  expect(await number('Cells')).toBeLessThan(660);
  await expect.poll(() => part('target-cells')).toBe('600');
  await expect.poll(() => part('event')).not.toBe(null);
  const cells = await number('Cells');
  const { hash } = new URL(page.url());
  for (let i = 0; i < 4 && part('target-cells') !== null; ++i) {
    const link = page.url();
    await page.keyboard.press('Control+z');
    await expect.poll(() => page.url(), eventually).not.toBe(link);
  }
  await expect.poll(() => number('Ideal'), eventually).toBe(before);
  expect(await page.getByLabel('Cells', { exact: true }).inputValue()).toBe('');
  await visit(hash);
  await expect.poll(() => number('Cells'), eventually).toBe(cells);
  expect(await page.getByLabel('Cells', { exact: true }).inputValue()).toBe('600');
});

test('the options of the chosen method are offered, and no others', async () => {
  await visit();
  await page.locator('summary', { hasText: 'More options' }).click();
  const shown = async (): Promise<string[]> => {
    const fields = await page.locator('.setup .inline:visible label').allInnerTexts();
    return fields.sort();
  };
  expect(await shown()).toEqual(['Augment', 'Cells', 'Dice', 'Method', 'Smooth', 'Thickness', 'Threshold']);
  await page.getByLabel('Method').selectOption('full');
  await expect.poll(shown, eventually).toEqual(['Align', 'Cells', 'Effort', 'Method', 'Threshold']);
  await page.locator('.gallery').getByRole('button', { name: 'Cubes' }).click();
  await expect.poll(shown, eventually).toEqual(['Augment', 'Cells', 'Dice', 'Method', 'Smooth', 'Thickness', 'Threshold']);
});

test('keys lead through the run and set the pace; help tells them; the link is copied', async () => {
  await visit('#case=iso2d&event=last');
  await settled();
  const at = async (): Promise<number> => Number((await page.locator('.counter').innerText()).split('/')[0]);
  await expect.poll(at, eventually).toBeGreaterThan(50);
  await page.keyboard.press('Home');
  await expect.poll(at).toBe(0);
  await page.keyboard.press('Shift+ArrowRight');
  await expect.poll(() => page.locator('.badge').innerText()).toBe('Iteration');
  const iteration = await at();
  await page.keyboard.press('Shift+ArrowLeft');
  await expect.poll(at).toBe(0);
  await page.keyboard.press('End');
  await expect.poll(at).toBeGreaterThan(iteration);
  const pace = page.getByLabel('Pace');
  await page.keyboard.press('+');
  await expect.poll(() => pace.inputValue()).toBe('0.5');
  await page.keyboard.press('-');
  await expect.poll(() => pace.inputValue()).toBe('auto');

  await page.keyboard.press('?');
  const help = page.getByRole('dialog', { name: 'How to read the picture' });
  await help.waitFor();
  expect(await help.getByText('play, pause').isVisible()).toBe(true);
  await page.keyboard.press('Escape');
  await expect.poll(() => help.count()).toBe(0);

  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await page.getByRole('button', { name: 'Copy link' }).click();
  await expect.poll(() => message().innerText()).toContain('copied');
  expect(await page.evaluate(() => navigator.clipboard.readText())).toBe(page.url());
});

test('the whole mesh comes back by button and by double click, the window fills', async () => {
  await visit();
  const canvas = page.locator('.picture canvas');
  const near = async (): Promise<void> => {
    await canvas.hover({ position: { x: 60, y: 60 } });
    await page.mouse.wheel(0, -300);
    await expect.poll(() => part('view'), eventually).not.toBe(null);
  };
  await near();
  await page.getByRole('button', { name: 'Show the whole mesh' }).click();
  await expect.poll(() => part('view')).toBe(null);
  await near();
  await canvas.dblclick({ position: { x: 40, y: 40 } });
  await expect.poll(() => part('view')).toBe(null);
  await page.getByRole('button', { name: 'Full screen' }).click();
  await expect.poll(() => page.evaluate(() => document.fullscreenElement?.className)).toBe('view');
  await page.getByRole('button', { name: 'Full screen' }).click();
  await expect.poll(() => page.evaluate(() => document.fullscreenElement)).toBe(null);
});

test('a file is opened by its button', async () => {
  await visit();
  const chooser = page.waitForEvent('filechooser');
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await (await chooser).setFiles({
    name: 'two.mesh',
    mimeType: 'text/plain',
    buffer: Buffer.from('MeshVersionFormatted 2\nDimension 2\nVertices\n6\n0 0 1\n1 0 1\n2 0 1\n0 1 1\n1 1 1\n2 1 1\nQuadrilaterals\n2\n1 2 5 4 1\n2 3 6 5 1\nEnd\n'),
  });
  await expect.poll(() => page.locator('#mesh-summary').innerText(), eventually).toContain('two.mesh: 2 quads');
});

test('a browser that records no films says so', async () => {
  await visit();
  await page.evaluate(() => Reflect.deleteProperty(globalThis, 'MediaRecorder'));
  await page.locator('summary', { hasText: 'Save' }).click();
  await page.locator('[data-format=webm]').click();
  await expect.poll(() => message().innerText()).toContain('no MediaRecorder');
  expect(await message().innerText()).toContain('.png');
});

test('cells are coloured also when the numbers were there before the drawing code', async () => {
  await visit('#case=iso2d&colour=shape&hide=ellipses');
  const coloured = await pictureNow();
  await newPage();
  let letGo: () => void = () => undefined;
  const numbers = new Promise<void>((resolve) => (letGo = resolve));
  await page.route(/three-.*\.js/, async (route) => {
    await numbers;
    await route.continue();
  });
  await page.goto(`${serving.address}#case=iso2d&colour=shape&hide=ellipses`);
  await expect.poll(() => page.locator('.facts dd').first().innerText(), eventually).toMatch(/\d/);
  expect(await page.locator('.picture canvas').count()).toBe(0);
  letGo();
  await page.locator('.picture canvas').waitFor();
  await expect.poll(async () => (await pictureNow()).equals(coloured), eventually).toBe(true);
});
