// The built page in a real browser, driven as a visitor would.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { complaints, eventually, newPage, page, pictureNow, serving, visit } from './browsing.ts';
import { screenshots, serveSite } from './site.ts';

const fact = async (name: string) => page.locator('.facts > div', { hasText: name }).locator('dd');
const caption = (): Promise<string> => page.locator('#caption .text').innerText();
const counter = (): Promise<string> => page.locator('.counter').innerText();
const status = () => page.locator('.status');
const ours = (table: number) => page.locator('table.indicators').nth(table).locator('.ours td').allInnerTexts();

/** Computes the whole run without playing it, and leaves the page at its end. */
async function runToEnd(): Promise<void> {
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await expect.poll(() => status().innerText(), eventually).toMatch(/ in [\d.]+ s/);
  await page.keyboard.press('End');
}

/** Hands a file to the page as a drop. */
async function drop(name: string, content: string): Promise<void> {
  await page.evaluate(
    ([name, content]) => {
      const data = new DataTransfer();
      data.items.add(new File([content], name));
      document.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
    },
    [name, content] as const,
  );
}

describe('the first frame', () => {
  test('shows the initial mesh in its metric, a play button and a sentence that teaches', async () => {
    await visit();
    expect(await caption()).toContain('63 quads');
    expect(await caption()).toContain('ellipse');
    expect(await page.locator('.start').isVisible()).toBe(true);
    expect(await ours(0)).toEqual(['142', '1.000', '4.205', '20.00', '1.042']);
    expect(await page.locator('table.indicators .paper').count()).toBe(6);
    expect(complaints).toEqual([]);
  });

  test('draws the mesh, and draws it differently when asked to', async () => {
    await visit();
    // A plain background compresses to a tenth of that.
    await expect.poll(async () => (await pictureNow()).length, eventually).toBeGreaterThan(20_000);
    const plain = await pictureNow();
    await page.keyboard.press('c');
    await expect.poll(async () => (await pictureNow()).equals(plain), eventually).toBe(false);
  });
});

describe('playing', () => {
  test('play computes the run and shows its events; space pauses', async () => {
    await visit('#pace=4');
    await page.locator('.start').click();
    await expect.poll(counter, eventually).toMatch(/^[4-9]\d* \/|^\d\d+ \//);
    await page.locator('body').press('Space');
    const held = await counter();
    await page.waitForTimeout(700);
    expect((await counter()).split(' ')[0]).toBe(held.split(' ')[0]);
    expect(await page.getByRole('button', { name: 'Play', exact: true }).isVisible()).toBe(true);
  });

  test('a step forward and a step back lead through tags, layer, shrink and connect', async () => {
    await visit();
    const kinds: string[] = [];
    for (let i = 0; i < 4; ++i) {
      await page.keyboard.press('ArrowRight');
      await expect.poll(counter, eventually).toMatch(new RegExp(`^${i + 1} /`));
      kinds.push(await page.locator('.badge').innerText());
    }
    expect(kinds).toEqual(['Tags', 'Layer', 'Shrink', 'Connect']);
    await expect.poll(async () => (await fact('Cells')).innerText(), eventually).not.toBe('63');
    for (let i = 0; i < 4; ++i) await page.getByRole('button', { name: 'Step back' }).click();
    expect(await caption()).toContain('63 quads');
    await expect.poll(async () => (await fact('Cells')).innerText(), eventually).toBe('63');
    await expect.poll(() => ours(0), eventually).toEqual(['142', '1.000', '4.205', '20.00', '1.042']);
  });

  test('scrubbing to the end and back to the start restores the initial mesh', async () => {
    await visit();
    await runToEnd();
    const [at, all] = (await counter()).split(' / ');
    expect(at).toBe(all);
    const cells = Number((await status().innerText()).replace(/,/g, '').match(/^\d+/)![0]);
    await expect.poll(async () => (await fact('Cells')).innerText(), eventually).toBe(cells.toLocaleString('en'));
    await expect.poll(async () => Number((await ours(0))[4]), eventually).toBeLessThan(0.35);
    expect(await (await fact('Irregular')).innerText()).toMatch(/\d/);
    await page.getByLabel('Event shown').fill('0');
    await expect.poll(() => ours(0), eventually).toEqual(['142', '1.000', '4.205', '20.00', '1.042']);
    expect(complaints).toEqual([]);
  });

  test('a run can be stopped, and what it has done can be played', async () => {
    await visit('#mesh=grid:20,20:0,1,0,1&metric=h %3D 0.002%2B0.01*abs(x-y)');
    await page.getByRole('button', { name: 'Run', exact: true }).click();
    await page.getByRole('button', { name: 'Stop' }).click();
    await expect.poll(() => status().innerText(), eventually).toContain('stopped');
    await page.keyboard.press('End');
    expect(await counter()).toMatch(/\d+ \/ \d+$/);
  });

  test('a changed option starts afresh', async () => {
    await visit('#case=aniso2d');
    await runToEnd();
    await page.getByLabel('Smooth').selectOption('none');
    expect(await caption()).toContain('63 quads');
    expect(await counter()).toBe('');
    await expect.poll(() => page.url()).not.toContain('event'); // the link follows a little later
  });
});

describe('looking', () => {
  test('cells are coloured by shape and age, each with a legend', async () => {
    await visit();
    expect(await page.locator('.legend').isVisible()).toBe(false);
    await page.getByLabel('Colour of cells').selectOption('shape');
    expect(await page.locator('.legend').innerText()).toMatch(/flat[\s\S]*unit/);
    await page.locator('h1').click();
    for (const words of [/too short[\s\S]*too long/, /right angles/]) {
      await page.keyboard.press('c');
      expect(await page.locator('.legend').innerText()).toMatch(words);
    }
    await page.keyboard.press('c');
    expect(await page.locator('.legend').innerText()).toContain('iteration');
  });

  test('marks can be switched by button and by key', async () => {
    await visit();
    const ellipses = page.getByRole('button', { name: 'Metric' });
    await ellipses.click();
    expect(await ellipses.getAttribute('aria-pressed')).toBe('false');
    await page.locator('h1').click();
    await page.keyboard.press('m');
    expect(await ellipses.getAttribute('aria-pressed')).toBe('true');
  });

  test('hexahedral cases open, too', async () => {
    await visit('#case=linear3d');
    expect(await caption()).toContain('64 hexes');
    expect(await ours(0)).toEqual(['300', '1.250', '2.456', '5.00', '0.497']);
    expect(await page.getByRole('button', { name: 'Isolines' }).isVisible()).toBe(false);
  });

  test('the portrait opens from the list of cases, with the metric of its picture', async () => {
    await visit();
    await page.getByLabel('Case', { exact: true }).selectOption('riemann');
    const ideal = page.locator('.facts > div', { hasText: 'Ideal' }).locator('dd');
    await expect.poll(() => ideal.innerText(), { timeout: 200_000 }).toMatch(/^(5,9|6,0)\d\d$/);
    expect(await caption()).toContain('320 quads');
    await expect.poll(() => page.url()).toContain('case=riemann');
  }, 240_000);

  test('nothing is drawn while nothing changes', async () => {
    await visit();
    const frames = (): Promise<number> =>
      page.evaluate(async () => {
        let count = 0;
        const real = window.requestAnimationFrame;
        window.requestAnimationFrame = (callback) => (++count, real.call(window, callback));
        await new Promise((resolve) => setTimeout(resolve, 700));
        window.requestAnimationFrame = real;
        return count;
      });
    await expect.poll(frames, eventually).toBe(0); // what was still to be sampled and measured has come
    expect(await frames()).toBe(0);
  });
});

describe('a link', () => {
  test('restores case, options, event, colours and camera in a new page', async () => {
    await visit('#case=circle2d&threshold=2.5&smooth=none&colour=age&hide=hull');
    await page.keyboard.press('ArrowRight');
    await expect.poll(counter, eventually).toMatch(/^1 \/ \d+$/);
    for (let i = 0; i < 6; ++i) await page.keyboard.press('ArrowRight');
    const canvas = page.locator('.picture canvas');
    await canvas.hover();
    await page.mouse.wheel(0, -400);
    await expect.poll(() => page.url(), eventually).toMatch(/event=7.*view=/);
    const url = page.url();
    const [words, numbers] = [await caption(), await ours(0)];
    await visit(new URL(url).hash);
    await expect.poll(counter, eventually).toMatch(/^7 \//);
    expect(await caption()).toBe(words);
    await expect.poll(() => ours(0), eventually).toEqual(numbers);
    expect(await page.getByLabel('Threshold').inputValue()).toBe('2.5');
    expect(await page.getByRole('button', { name: 'Hull' }).getAttribute('aria-pressed')).toBe('false');
    await expect.poll(() => page.url(), eventually).toBe(url);
  });

  test('to an unknown case says so and shows the first one', async () => {
    await visit('#case=atlantis');
    expect(await caption()).toContain('63 quads');
    await expect.poll(() => page.url(), eventually).toContain('case=iso2d');
    expect(await page.getByRole('alert').filter({ hasText: 'atlantis' }).isVisible()).toBe(true);
  });

  test('of a dropped file asks for the file', async () => {
    await visit('#file=plate.msh');
    expect(await page.getByRole('alert').filter({ hasText: 'plate.msh' }).innerText()).toContain('Drop that file');
  });
});

const square = (quads: string): string =>
  `MeshVersionFormatted 2\nDimension 2\nVertices\n6\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n${quads}\nEnd\n`;

describe('own input', () => {
  test('a formula is applied while it is typed, and its mistakes are shown where they are', async () => {
    await visit();
    await page.getByLabel('Metric: the size').fill('h = 0.3 + 0.1*foo');
    const mistake = page.locator('.mistake');
    await expect.poll(() => mistake.innerText(), eventually).toContain('column 15');
    expect(await mistake.locator('mark').innerText()).toBe('f');
    expect(await ours(0)).toEqual(['142', '1.000', '4.205', '20.00', '1.042']); // the old metric still holds
    await page.getByLabel('Metric: the size').fill('h = 0.5');
    await expect.poll(() => ours(0), eventually).toEqual(['142', '2.000', '2.000', '2.00', '0.000']);
    expect(await mistake.innerText()).toBe('');
    expect(await page.locator('table.indicators .paper').count()).toBe(0); // the paper's rows are for its own metric
    await expect
      .poll(() => new URLSearchParams(new URL(page.url()).hash.slice(1)).get('metric'), eventually)
      .toBe('h = 0.5');
  });

  test('a dropped mesh file is opened, adapted and saved', async () => {
    await visit();
    await drop('two.mesh', square('Quadrilaterals\n2\n1 2 5 4 1\n2 3 6 5 1'));
    await expect.poll(caption, eventually).toContain('2 quads');
    expect(await page.locator('#formula').inputValue()).toMatch(/^h = .*abs\(x/);
    await runToEnd();
    expect(Number((await status().innerText()).match(/^[\d,]+/)![0].replace(',', ''))).toBeGreaterThan(20);
  });

  test('a bad file is refused in a sentence and leaves the page as it was', async () => {
    await visit();
    await drop('bad.mesh', square('Quadrilaterals\n1\n1 2 5 99 1'));
    const alert = page.getByRole('alert').filter({ hasText: 'bad.mesh' });
    await alert.waitFor();
    expect(await alert.innerText()).toMatch(/99|4/);
    expect(await caption()).toContain('63 quads');
    await alert.getByRole('button', { name: 'Dismiss' }).click();
    expect(await alert.count()).toBe(0);
  });

  test('a grid can be typed', async () => {
    await visit();
    await page.getByText('Another initial grid').click();
    await page.getByLabel('Grid').fill('grid:5,4:0,7,0,9');
    await page.getByLabel('Grid').press('Enter');
    await expect.poll(caption, eventually).toContain('20 quads');
    await expect.poll(() => page.url(), eventually).toContain('mesh=grid');
  });
});

describe('saving', () => {
  async function save(format: string): Promise<{ name: string; bytes: Buffer }> {
    await page.getByTitle('Save').click();
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.locator(`[data-format=${format}]`).click(),
    ]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  }

  test('gives the mesh in every format, a picture and a report', async () => {
    await visit('#case=aniso2d');
    await runToEnd();
    for (const format of ['vtu', 'vtk', 'msh', 'mesh']) {
      const { name, bytes } = await save(format);
      expect(name).toMatch(new RegExp(`^aniso2d-\\d+\\.${format}$`));
      expect(bytes.length).toBeGreaterThan(10_000);
    }
    const png = await save('png');
    expect(png.bytes.subarray(1, 4).toString()).toBe('PNG');
    expect(png.bytes.readUInt32BE(16)).toBeGreaterThan(800);
    const report = JSON.parse((await save('json')).bytes.toString()) as { mesh: { cells: number }; valid: boolean };
    expect(report.valid).toBe(true);
    await expect.poll(async () => (await fact('Cells')).innerText(), eventually).toBe(String(report.mesh.cells));
  });

  test('gives the mesh as it is shown, also in the middle of a run', async () => {
    await visit('#smooth=none&event=4');
    await expect.poll(counter, eventually).toMatch(/^4 \/ \d+$/);
    await expect.poll(async () => (await fact('Cells')).innerText(), eventually).not.toBe('63');
    const shown = Number(await (await fact('Cells')).innerText());
    const { bytes } = await save('mesh');
    expect(Number(/Quadrilaterals\s+(\d+)/.exec(bytes.toString())![1])).toBe(shown);
  });
});

describe('what a visitor downloads', () => {
  const modules = async (hash: string): Promise<string[]> => {
    await newPage();
    const asked: string[] = [];
    page.on('request', (request) => {
      const module = /(pillowmesh\w*)-[^/]*\.wasm$/.exec(request.url())?.[1];
      if (module) asked.push(module);
    });
    await page.goto(serving.address + hash);
    const cells = await fact('Cells');
    await expect.poll(() => cells.innerText(), { timeout: 20_000 }).toMatch(/\d/);
    return asked;
  };

  test('is no code for hexahedra, when the mesh is of quadrilaterals', async () => {
    expect(await modules('#case=iso2d')).toEqual(['pillowmesh']);
  });

  test('is the code for hexahedra, once the mesh turns out to be of them', async () => {
    expect(await modules('#case=linear3d')).toEqual(['pillowmesh', 'pillowmesh3d']);
  });
});

describe('mishaps', () => {
  test('a missing core is told, with a way to try again', async () => {
    const without = await serveSite({ hide: (path) => path.endsWith('.wasm') });
    const lost = await newPage();
    await lost.goto(without.address);
    const alert = lost.getByRole('alert').filter({ hasText: 'core' });
    await alert.waitFor();
    expect(await alert.innerText()).toContain('404');
    expect(await alert.getByRole('button', { name: 'Start again' }).isVisible()).toBe(true);
    await without.close();
  });

  test('without WebGL the numbers and the run still work', async () => {
    await newPage();
    await page.addInitScript(() => {
      HTMLCanvasElement.prototype.getContext = () => null;
    });
    await page.goto(serving.address);
    await page.getByRole('alert').filter({ hasText: 'WebGL' }).waitFor();
    await expect.poll(() => ours(0), eventually).toEqual(['142', '1.000', '4.205', '20.00', '1.042']);
    await runToEnd();
  });

  test('a worker that cannot work is told and can be replaced', async () => {
    let broken = true;
    const flaky = await serveSite({ hide: (path) => broken && /worker/.test(path) });
    await newPage();
    await page.goto(flaky.address);
    const alert = page.getByRole('alert').filter({ hasText: 'stopped' });
    await alert.waitFor();
    broken = false;
    await alert.getByRole('button', { name: 'Start again' }).click();
    await expect.poll(caption, eventually).toContain('63 quads');
    await runToEnd();
    await flaky.close();
  });
});

describe('on every screen', () => {
  const screens = [
    { name: 'laptop-light', width: 1280, height: 800, colorScheme: 'light', hash: '#case=iso2d' },
    {
      name: 'laptop-dark',
      width: 1440,
      height: 900,
      colorScheme: 'dark',
      hash: '#case=circle2d&event=70&colour=shape',
    },
    { name: 'tablet-dark', width: 834, height: 1000, colorScheme: 'dark', hash: '#case=iso2d&event=14' },
    { name: 'phone-light', width: 360, height: 740, colorScheme: 'light', hash: '#case=aniso2d&event=10' },
    { name: 'phone-small', width: 320, height: 600, colorScheme: 'dark', hash: '' },
  ] as const;
  for (const { name, width, height, colorScheme, hash } of screens)
    test(`${name}: nothing is wider than the window, the picture has room`, async () => {
      await visit(hash, { viewport: { width, height }, colorScheme });
      if (hash.includes('event')) await expect.poll(counter, eventually).toMatch(/^\d+ \/ \d+$/);
      await page.waitForTimeout(400);
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
      const picture = (await page.locator('.picture').boundingBox())!;
      expect(Math.min(picture.width, picture.height)).toBeGreaterThan(220);
      expect(picture.y + picture.height).toBeLessThanOrEqual(height);
      await page.screenshot({ path: join(screenshots, `${name}.png`) });
    });

  test('the theme follows the system until it is chosen', async () => {
    await visit('', { colorScheme: 'dark' });
    const paper = (): Promise<string> =>
      page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
    const dark = await paper();
    await page.getByRole('button', { name: 'Theme' }).click();
    expect(await paper()).not.toBe(dark);
    await page.reload();
    expect(await paper()).not.toBe(dark);
  });
});
