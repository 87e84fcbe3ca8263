// For everyone: keys, touch, zoomed text, print, lost graphics, missing WebAssembly.
import { join } from 'node:path';
import { expect, test } from 'vitest';
import { eventually, newPage, page, part, pictureNow, visit } from './browsing.ts';
import { screenshots, serveSite } from './site.ts';

const zoom = (): number => Number(part('view')?.split(';')[1] ?? 1);
test('the camera moves, turns and zooms by keys', async () => {
  await visit('#case=iso2d');
  await page.keyboard.press('Control+ArrowRight');
  await expect.poll(() => Number(part('view')?.split(',')[0])).toBeGreaterThan(3.6);
  await page.keyboard.press('.');
  await expect.poll(zoom).toBeCloseTo(1.25);
  await page.keyboard.press('f');
  await expect.poll(() => part('view')).toBe(null);
  await page.locator('#case').selectOption('linear3d');
  await expect.poll(() => page.locator('#caption').innerText(), eventually).toContain('64 hexes');
  const before = await pictureNow();
  await page.locator('h1').click();
  await page.keyboard.press('Control+ArrowUp');
  await expect.poll(() => part('view')).toMatch(/;1;.*,0\.5/);
  expect((await pictureNow()).equals(before)).toBe(false);
});

test('everything can be reached by the tab key, and the focus is seen', async () => {
  await visit('#case=iso2d');
  await page.locator('body').focus();
  const reached = new Set<string>();
  for (let i = 0; i < 70; ++i) {
    await page.keyboard.press('Tab');
    const found = await page.evaluate(() => {
      const element = document.activeElement as HTMLElement | null;
      if (!element || element === document.body) return null;
      const target = element.matches('input[type=radio]') ? (element.nextElementSibling ?? element) : element;
      const style = getComputedStyle(target);
      const seen = style.boxShadow !== 'none' || style.outlineStyle !== 'none';
      return { name: element.getAttribute('aria-label') ?? element.title ?? element.textContent ?? '', id: element.id, seen };
    });
    if (!found) break;
    expect(found.seen, `${found.name} ${found.id}`).toBe(true);
    reached.add(found.id || found.name);
  }
  for (const name of ['case', 'formula', 'run', 'Play', 'Step forward', 'Pace', 'Colour of cells', 'Full screen'])
    expect([...reached], name).toContain(name);
});

test('what is shown is told in words, once it stands still', async () => {
  await visit('#case=iso2d&pace=4');
  const live = page.locator('#caption');
  expect(await live.getAttribute('aria-live')).toBe('polite');
  await page.keyboard.press(' ');
  await expect.poll(() => live.getAttribute('aria-live'), eventually).toBe('off');
  await page.keyboard.press(' ');
  await expect.poll(() => live.getAttribute('aria-live')).toBe('polite');
  const [told, shown] = await page.evaluate(() => [
    document.querySelector('.timeline input')!.getAttribute('aria-valuetext'),
    document.querySelector('#caption .text')!.textContent,
  ]);
  expect(told).toContain(shown);
});

test('two fingers zoom, one tap points', async () => {
  await visit('#case=iso2d&hide=ellipses', { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  const box = (await page.locator('.picture').boundingBox())!;
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const session = await page.context().newCDPSession(page);
  const touch = (type: string, spread: number): Promise<unknown> =>
    session.send('Input.dispatchTouchEvent', {
      type: type as 'touchStart',
      touchPoints: type === 'touchEnd' ? [] : [{ x: x - spread, y: y - 100, id: 0 }, { x: x + spread, y: y - 100, id: 1 }],
    });
  await touch('touchStart', 20);
  for (let spread = 30; spread <= 80; spread += 10) await touch('touchMove', spread);
  await touch('touchEnd', 0);
  await expect.poll(zoom, eventually).toBeGreaterThan(1.5);
  await page.touchscreen.tap(box.x + box.width / 2 + 90, box.y + box.height / 2 - 90);
  await expect.poll(() => page.locator('.pointed').innerText(), eventually).toContain('Chords of');
  await page.screenshot({ path: join(screenshots, 'phone-touch.png') });
});

for (const [name, width, height] of [['laptop at 200 %', 683, 384], ['phone at 200 %', 320, 420]] as const)
  test(`a ${name} loses nothing`, async () => {
    await visit('#case=linear3d', { viewport: { width, height }, deviceScaleFactor: 2 });
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
    for (const button of ['Play', 'Step forward', 'Copy link', 'Embed'])
      await page.getByRole('button', { name: button, exact: true }).last().scrollIntoViewIfNeeded();
  });

test('on paper there is the picture and the numbers, without controls', async () => {
  await visit('#case=iso2d');
  await page.emulateMedia({ media: 'print' });
  expect(await page.locator('.picture canvas').isVisible()).toBe(true);
  expect(await page.locator('table.indicators').first().isVisible()).toBe(true);
  for (const control of ['.transport', '.setup', '.start']) expect(await page.locator(control).isVisible()).toBe(false);
});

test('a lost graphics context is told, and comes back', async () => {
  await visit('#case=iso2d&hide=ellipses');
  const before = await pictureNow();
  await page.evaluate(() => {
    const gl = document.querySelector<HTMLCanvasElement>('.picture canvas')!.getContext('webgl2')!;
    const extension = gl.getExtension('WEBGL_lose_context')!;
    (window as never as { back(): void }).back = () => extension.restoreContext();
    extension.loseContext();
  });
  await expect.poll(() => page.locator('.problem').innerText()).toContain('comes back');
  await page.evaluate(() => (window as never as { back(): void }).back());
  await expect.poll(() => page.locator('.problem').isVisible()).toBe(false);
  await expect.poll(async () => (await pictureNow()).equals(before), eventually).toBe(true);
});

test('a page that forbids WebAssembly says so, and the element shows its own content', async () => {
  const strict = await serveSite({
    headers: { 'content-security-policy': "default-src 'self'" },
    pages: {
      'course.html':
        '<!doctype html><title>Course</title><script type="module" src="pillow-mesh.js"></script><pillow-mesh>A mesh of squares</pillow-mesh>',
    },
  });
  await newPage();
  await page.goto(`${strict.address}course.html`);
  await expect.poll(() => page.locator('.problem').innerText(), eventually).toMatch(/WebAssembly|core/);
  await strict.close();
});
