// Looking into hexahedral meshes in a real browser, control by control; and the paper's figures.
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { drawing, solidFacets } from '../../web/src/inside/facets.ts';
import { facetNeighbours } from '../../web/src/inside/neighbours.ts';
import { outlineOf, reliefOf } from '../../web/src/inside/relief.ts';
import { ReplayMesh } from '../../web/src/replay/replay_mesh.ts';
import { factor } from '../../web/src/viewport/ellipsoids.ts';
import { complaints, eventually, page, part, pictureNow, visit } from './browsing.ts';
import { screenshots } from './site.ts';

const drawn = async (): Promise<string> => (await page.locator('.drawn').textContent()) ?? '';
const kept = async (): Promise<number> => Number((await drawn()).replace(/,/g, '').split(' ')[0]);
const slider = (name: string) => page.locator('.inside').getByRole('slider', { name, exact: true });
const open = () => page.getByRole('button', { name: 'Look inside' }).click();

describe('seeing in space', () => {
  test('an ellipsoid is the image of the unit ball under a matrix that takes its metric to a multiple of unity', () => {
    const [m11, m12, m22, m13, m23, m33] = [4, 1, 9, -0.5, 2, 3];
    const axes = factor([m11, m12, m22, m13, m23, m33]);
    const times = ([x, y, z]: number[]): number[] => [m11 * x + m12 * y + m13 * z, m12 * x + m22 * y + m23 * z, m13 * x + m23 * y + m33 * z];
    axes.forEach((a, i) =>
      axes.forEach((b, j) => expect(times(a).reduce((sum, x, d) => sum + x * b[d], 0)).toBeCloseTo(i === j ? 0.25 : 0, 12)),
    );
  });

  test('corners of a cube stand out, the bottom of a pit is hollow, and outlines have the normals of both sides', () => {
    // 3 x 3 x 2 unit cubes; without the middle one on top there is a pit.
    const points: number[] = [];
    for (let k = 0; k <= 2; ++k) for (let j = 0; j <= 3; ++j) for (let i = 0; i <= 3; ++i) points.push(i, j, k);
    const cells: number[] = [];
    for (let c = 0; c < 18; ++c)
      for (let v = 0; v < 8; ++v)
        cells.push((c % 3) + (v & 1) + 4 * ((Math.floor(c / 3) % 3) + ((v >> 1) & 1)) + 16 * (Math.floor(c / 9) + (v >> 2)));
    const mesh = new ReplayMesh({ dim: 3, points: Float64Array.from(points), cells: Int32Array.from(cells) });
    const pit = solidFacets(mesh, facetNeighbours(mesh), Uint8Array.from({ length: 18 }, (_, c) => (c === 13 ? drawing.hidden : drawing.solid)));
    const relief = reliefOf(mesh, pit);
    const at = (vertex: number): number => relief.hollow[pit.vertices.indexOf(vertex)];
    expect(at(0)).toBeLessThan(-0.5); // a corner of the block
    expect(at(16 + 5)).toBeGreaterThan(0.3); // of the bottom of the pit
    expect(at(1)).toBeLessThanOrEqual(0);
    for (let f = 0; f < pit.cells.length; ++f) {
      const cell = pit.cells[f];
      const middle = [0, 1, 2].map((d) => cells.slice(8 * cell, 8 * cell + 8).reduce((sum, v) => sum + points[3 * v + d] / 8, 0));
      const away = [0, 1, 2].reduce((sum, d) => sum + (points[3 * pit.vertices[4 * f] + d] - middle[d]) * relief.normals[3 * f + d], 0);
      expect(away).toBeGreaterThan(0); // normals point out of their cell
    }
    const { edges, normals } = outlineOf(mesh.vertexCount, pit, relief);
    expect(edges.length / 2).toBe(8 * 3 + 4 * 2 + 12); // of the block: 8 sides of 3 edges, 4 of 2; of the pit: rim, walls, bottom
    expect(normals.length).toBe(3 * edges.length);
  });
});

describe('looking inside', () => {
  test('is offered for hexes alone', async () => {
    await visit('#case=iso2d');
    expect(await page.getByRole('button', { name: 'Look inside' }).isVisible()).toBe(false);
    await page.locator('#case').selectOption('linear3d');
    await page.getByRole('button', { name: 'Look inside' }).waitFor();
    expect(await page.locator('.inside').isVisible()).toBe(false);
    await open();
    expect(await page.locator('.inside').isVisible()).toBe(true);
    expect(await drawn()).toBe('64 of 64 hexes');
    await page.locator('#case').selectOption('iso2d');
    await expect.poll(() => page.locator('.inside').isVisible(), eventually).toBe(false);
    expect(complaints).toEqual([]);
  });

  test('a plane cuts whole cells away, across each axis, from either side, where its slider says', async () => {
    await visit('#case=sphere3d'); // 5 x 5 x 5 cubes: the middle ones' centres lie in a plane at 50 %
    await open();
    const before = await pictureNow();
    await page.getByLabel('Plane').check();
    await expect.poll(drawn).toBe('75 of 125 hexes');
    expect((await pictureNow()).equals(before)).toBe(false);
    for (const [axis, angles] of [['x', '0,0'], ['y', '-90,0'], ['z', '0,90']] as const) {
      await page.getByRole('button', { name: `: cut across ${axis}` }).click();
      await expect.poll(() => part('cut')).toContain(`plane:${angles},`);
      await slider('Position').fill('0.25');
      await expect.poll(drawn).toBe('25 of 125 hexes');
      await page.getByRole('button', { name: 'Flip' }).click();
      await expect.poll(drawn).toBe('100 of 125 hexes');
      await page.getByRole('button', { name: 'Flip' }).click();
      await slider('Position').fill('1');
      await expect.poll(drawn).toBe('125 of 125 hexes');
      await slider('Position').fill('0');
      await expect.poll(drawn).toBe('0 of 125 hexes');
    }
    expect(complaints).toEqual([]);
  });

  test('the plane can have any direction, that of the view, too', async () => {
    await visit('#case=sphere3d');
    await page.keyboard.press('x');
    await expect.poll(() => part('cut')).toBe('plane:0,0,0.5');
    await slider('Turn').fill('45');
    await slider('Tilt').fill('-30');
    await expect.poll(() => part('cut')).toBe('plane:45,-30,0.5');
    const tilted = await kept();
    expect(tilted).toBeGreaterThan(45);
    expect(tilted).toBeLessThan(80);
    await page.getByRole('button', { name: ': cut across the view' }).click();
    await expect.poll(() => part('cut')).toMatch(/^plane:-53,25,/); // where a mesh is looked at from at first
  });

  test('a slab keeps what lies between two planes', async () => {
    await visit('#case=sphere3d');
    await open();
    await page.getByLabel('Slab').check();
    await slider('Position').fill('0.6');
    await slider('Thickness').fill('0.2');
    await expect.poll(drawn).toBe('25 of 125 hexes');
    await slider('Thickness').fill('0.6');
    await expect.poll(drawn).toBe('75 of 125 hexes');
  });

  test('layers are peeled off from the boundary, as many as there are', async () => {
    await visit('#case=sphere3d');
    await open();
    expect(await slider('Peel').getAttribute('max')).toBe('2');
    await slider('Peel').focus();
    await page.keyboard.press('ArrowRight');
    await expect.poll(drawn).toBe('27 of 125 hexes');
    await page.keyboard.press('ArrowRight');
    await expect.poll(drawn).toBe('1 of 125 hexes');
    expect(await page.locator('.counter').innerText()).toBe(''); // the arrow keys were the slider's alone
  });

  test('cells are hidden above and below a quality', async () => {
    await visit('#case=linear3d');
    await open();
    await slider('From').fill('0.9');
    await expect.poll(kept).toBeLessThan(64);
    const good = await kept();
    await slider('From').fill('0');
    await slider('To').fill('0.9');
    await expect.poll(kept).toBe(64 - good);
    await page.getByLabel('Hide cells by').selectOption('jacobian');
    await expect.poll(drawn).toBe('0 of 64 hexes'); // cubes: every scaled Jacobian is 1
    await slider('To').fill('1');
    await slider('From').fill('0.99');
    await expect.poll(drawn).toBe('64 of 64 hexes');
    await expect.poll(() => part('quality')).toBe('jacobian:0.99,1');
  });

  test('irregular edges are counted and drawn', async () => {
    await visit('#case=linear3d&event=last');
    await expect.poll(() => page.locator('.status').innerText(), eventually).toMatch(/ in [\d.]+ s/);
    await open();
    const before = await pictureNow();
    await page.getByLabel('Irregular edges').check();
    const counts = async (): Promise<number[]> =>
      (await page.locator('.valences b').allInnerTexts()).map((text) => Number(text.replace(/,/g, '')));
    await expect.poll(async () => Math.min(...(await counts()))).toBeGreaterThan(0);
    expect((await pictureNow()).equals(before)).toBe(false);
    await page.locator('h1').click();
    await page.keyboard.press('Home'); // the initial grid has none
    await expect.poll(counts).toEqual([0, 0, 0]);
  });

  test('cells become glass around a layer, always or never', async () => {
    await visit('#case=linear3d&event=2&hide=ellipses');
    await expect.poll(() => page.locator('.badge').innerText(), eventually).toBe('Layer');
    await open();
    const auto = await pictureNow();
    await page.getByLabel('Solid', { exact: true }).check();
    const solid = await pictureNow();
    expect(solid.equals(auto)).toBe(false);
    await page.getByLabel('Glass').check();
    expect((await pictureNow()).equals(auto)).toBe(true);
    await page.locator('h1').click();
    await page.keyboard.press('Home');
    await expect.poll(() => page.locator('.badge').innerText()).toBe('Start');
    const glass = await pictureNow();
    await page.getByLabel('Auto', { exact: true }).check();
    expect((await pictureNow()).equals(glass)).toBe(false);
  });

  test('cells are hidden by hand, or left alone with their neighbours; undo and a link know it', async () => {
    await visit('#case=sphere3d');
    await open();
    await page.getByRole('button', { name: 'Hide: Hide the framed cell' }).click();
    await expect.poll(() => page.locator('.inside').innerText()).toContain('First click a cell');
    const box = (await page.locator('.picture canvas').boundingBox())!;
    const click = (x: number): Promise<void> => page.mouse.click(box.x + x * box.width, box.y + 0.35 * box.height); // above the play button
    await click(0.45);
    await page.getByRole('button', { name: 'Hide: Hide the framed cell' }).click();
    await expect.poll(drawn).toBe('124 of 125 hexes');
    await expect.poll(() => part('without')).toMatch(/^\d+$/); // settled: what undo leads back to
    await click(0.45); // the one behind it
    await page.keyboard.press('Delete');
    await expect.poll(drawn).toBe('123 of 125 hexes');
    await expect.poll(() => part('without')).toMatch(/^\d+,\d+$/);
    await page.screenshot({ path: join(screenshots, 'dug.png') });
    await page.getByRole('button', { name: 'Undo' }).click();
    await expect.poll(drawn).toBe('124 of 125 hexes');
    await page.getByRole('button', { name: 'Back: Bring back' }).click();
    await expect.poll(drawn).toBe('125 of 125 hexes');
    await click(0.5);
    await page.keyboard.press('n');
    await expect.poll(kept).toBeLessThan(28); // at a corner 8, on an edge 12, on a side 18, inside 27
    expect([8, 12, 18]).toContain(await kept());
    await expect.poll(() => part('around')).toMatch(/^\d+$/);
    await expect.poll(() => part('view')).not.toBe(null); // flown to
    await page.screenshot({ path: join(screenshots, 'around.png') });
    const [shown, { hash }] = [await kept(), new URL(page.url())];
    await visit(hash);
    await expect.poll(kept).toBe(shown);
    expect(complaints).toEqual([]);
  });

  test('metric ellipsoids stand in the initial mesh, until something else is looked at', async () => {
    await visit('#case=linear3d');
    await page.locator('.start').evaluate((button) => button.remove());
    await expect.poll(() => page.getByRole('button', { name: 'Metric' }).isVisible()).toBe(true);
    const toggle = (): Promise<void> => page.getByRole('button', { name: 'Metric' }).click();
    await toggle();
    const without = await pictureNow();
    await toggle();
    await expect.poll(async () => (await pictureNow()).equals(without), eventually).toBe(false); // once they are sampled
    const with_ = await pictureNow();
    await page.screenshot({ path: join(screenshots, 'ellipsoids.png') });
    await toggle();
    expect((await pictureNow()).equals(without)).toBe(true);
    await toggle();
    expect((await pictureNow()).equals(with_)).toBe(true);
    expect(complaints).toEqual([]);
  });

  test('a link restores all of it, and one button undoes it', async () => {
    const hash =
      '#case=sphere3d&cut=slab:30,20,0.6,0.3&peel=1&quality=jacobian:0.5,1&cells=solid&edges=irregular&colour=shape';
    await visit(hash);
    await expect.poll(kept).toBeLessThan(27);
    expect(await page.locator('.inside').isVisible()).toBe(true);
    expect(await page.getByLabel('Slab').isChecked()).toBe(true);
    const values = await Promise.all(
      ['Position', 'Thickness', 'Turn', 'Tilt', 'Peel', 'From'].map((name) => slider(name).inputValue()),
    );
    expect(values).toEqual(['0.6', '0.3', '30', '20', '1', '0.5']);
    expect(await page.getByLabel('Irregular edges').isChecked()).toBe(true);
    for (const name of ['cut', 'peel', 'quality', 'cells', 'edges'])
      expect(part(name)).toBe(new URLSearchParams(hash.slice(1)).get(name));
    await page.getByRole('button', { name: 'Show all' }).click();
    await expect.poll(drawn).toBe('125 of 125 hexes');
    await expect.poll(() => part('cut')).toBe(null);
  });

  test('a link with nonsense in it shows everything', async () => {
    await visit('#case=sphere3d&cut=plane:abc,0,9&peel=-4&quality=eta:2,3&cells=wood');
    await expect.poll(drawn).toBe('125 of 125 hexes');
  });

  test('what is hidden can change 20 000 hexes at the pace of a slider, and turning them computes nothing', async () => {
    await visit('#mesh=grid:27,27,28:0,1,0,1,0,1&metric=h %3D 0.5&cut=plane:20,30,0.5');
    await expect.poll(drawn, eventually).toMatch(/of 20,412 hexes/);
    for (let i = 0; i < 12; ++i) {
      await slider('Position').fill(String(0.3 + 0.05 * i));
      await page.waitForTimeout(30);
    }
    const times = await page.evaluate(() =>
      performance.getEntriesByName('pillowmesh: facets').map((entry) => entry.duration),
    );
    console.log(`20 412 hexes: facets rebuilt in ${times.map((t) => t.toFixed(1)).join(', ')} ms`);
    expect(times.length).toBeGreaterThan(10);
    const box = (await page.locator('.picture').boundingBox())!;
    await page.mouse.move(box.x + 100, box.y + 200);
    await page.mouse.down();
    await page.mouse.move(box.x + 240, box.y + 260, { steps: 6 });
    await page.mouse.up();
    await expect.poll(() => part('view'), eventually).not.toBe(null);
    const after = await page.evaluate(() => performance.getEntriesByName('pillowmesh: facets').length);
    expect(after).toBe(times.length);
  });
});

describe('the paper’s figures', () => {
  for (const [number, name, cells] of [
    ['5', 'iso2d', 'quads'],
    ['6', 'aniso2d', 'quads'],
    ['7', 'circle2d', 'quads'],
    ['9', 'linear3d', 'hexes'],
    ['10', 'sphere3d-paper', 'hexes'],
  ] as const)
    test(`figure ${number} is one click away`, async () => {
      await visit('');
      await page.getByRole('button', { name: `Fig. ${number}`, exact: true }).click();
      await expect
        .poll(() => page.locator('.status').innerText(), { timeout: 100_000 })
        .toMatch(new RegExp(`^[\\d,]+ ${cells} in [\\d.]+ s`));
      await expect.poll(() => page.locator('.counter').innerText()).toMatch(/^(\d+) \/ \1$/);
      expect(await page.locator('#case').inputValue()).toBe(name);
      if (cells === 'hexes') {
        const [some, all] = (await drawn()).replace(/,/g, '').match(/\d+/g)?.map(Number) ?? [0, 0];
        expect(some).toBeLessThan(all);
      }
      await page.waitForTimeout(600);
      await page.screenshot({ path: join(screenshots, `figure-${number}.png`) });
      expect(complaints).toEqual([]);
    });
});

describe('on every screen', () => {
  const screens = [
    { name: 'inside-laptop', width: 1280, height: 800, colorScheme: 'light' },
    { name: 'inside-dark', width: 1440, height: 900, colorScheme: 'dark' },
    { name: 'inside-tablet', width: 834, height: 1000, colorScheme: 'light' },
    { name: 'inside-phone', width: 360, height: 740, colorScheme: 'dark' },
    { name: 'inside-phone-small', width: 320, height: 600, colorScheme: 'light' },
  ] as const;
  for (const { name, width, height, colorScheme } of screens)
    test(`${name}: nothing is wider than the window, the picture keeps its room`, async () => {
      await visit('#case=linear3d&cut=slab:-90,0,0.6,0.5&edges=irregular&colour=shape&event=last', {
        viewport: { width, height },
        colorScheme,
      });
      await expect.poll(() => page.locator('.status').innerText(), eventually).toMatch(/ in [\d.]+ s/);
      await page.waitForTimeout(500);
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
      const picture = (await page.locator('.picture').boundingBox())!;
      expect(Math.min(picture.width, picture.height)).toBeGreaterThan(220);
      await page.screenshot({ path: join(screenshots, `${name}.png`), fullPage: width < 760 });
    });
});
