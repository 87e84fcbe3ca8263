// <pillow-mesh> on pages of other people: strict policies, sandboxes, folders without a server, other hosts.
import { copyFileSync, mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { BrowserContextOptions } from 'playwright-core';
import { afterEach, describe, expect, test } from 'vitest';
import type { PillowMeshElement } from '../../web/src/element/pillow_mesh.ts';
import { complaints, eventually, newPage, page } from './browsing.ts';
import { root, screenshots, serveSite, site, type ServeOptions, type Serving } from './site.ts';

/** The host of the page under test. */
let serving: Serving | null = null;
afterEach(async () => {
  await serving?.close();
  serving = null;
});

const document_ = (body: string, head = `<script type="module" src="../pillow-mesh.js"></script>`): string =>
  `<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Course</title><link rel="icon" href="../icon.svg">${head}</head><body>${body}</body></html>`;

async function open(address: string, options: BrowserContextOptions = {}): Promise<void> {
  await newPage({ viewport: { width: 900, height: 700 }, ...options });
  await page.goto(address);
}

/** A page of somebody's beside the site, at /mesh/course/page.html. */
async function visit(body: string, options: ServeOptions = {}, head?: string): Promise<void> {
  serving = await serveSite({ ...options, pages: { 'course/page.html': document_(body, head), ...options.pages } });
  await open(`${serving.address}course/page.html`);
}

const figure = (id = 'figure') => page.locator(`#${id}`);
const caption = (id?: string): Promise<string> => figure(id).locator('.caption .text').innerText();
const position = (id = 'figure'): Promise<number> =>
  figure(id).evaluate((element) => (element as PillowMeshElement).position);

describe('the element', () => {
  test('shows what its attributes say, and follows them when they change', async () => {
    await visit('<pillow-mesh id="figure" case="iso2d" event="2" hide="ellipses"></pillow-mesh>');
    await expect.poll(() => position(), eventually).toBe(2);
    expect(await caption()).toMatch(/quads joined/);
    await figure().evaluate((element) => element.setAttribute('event', '4'));
    await expect.poll(() => position(), eventually).toBe(4);
    await figure().evaluate((element) => {
      element.removeAttribute('event');
      element.setAttribute('case', 'linear3d');
    });
    await expect.poll(() => caption(), eventually).toContain('64 hexes');
    expect(complaints).toEqual([]);
  });

  test('is driven by its buttons, keys and methods, and says what happens', async () => {
    await visit('<pillow-mesh id="figure" case="aniso2d" style="height: 460px"></pillow-mesh>');
    await expect.poll(() => caption(), eventually).toContain('63 quads');
    expect((await figure().boundingBox())!.height).toBe(460);
    await page.evaluate(() => {
      const log: string[] = ((window as never as { log: string[] }).log = []);
      for (const name of ['step', 'done', 'play', 'pause'] as const)
        document.querySelector('pillow-mesh')!.addEventListener(name, ({ detail }) =>
          log.push(`${name} ${JSON.stringify(detail)}`),
        );
    });
    await figure().getByRole('button', { name: 'Step forward' }).click();
    await expect.poll(() => position(), eventually).toBe(1);
    await page.keyboard.press('ArrowRight');
    await expect.poll(() => position(), eventually).toBe(2);
    const result = await figure().evaluate(async (element) => {
      const mesh = element as PillowMeshElement;
      await mesh.seek('last');
      const bytes = await mesh.save('a.json');
      return { position: mesh.position, length: mesh.length, cells: mesh.mesh.cells.length, link: mesh.link, bytes: bytes.length };
    });
    expect(result.position).toBe(result.length);
    expect(result.link).toMatch(/^case=aniso2d&event=\d+$/);
    expect(result.cells).toBeGreaterThan(4 * 300);
    expect(result.bytes).toBeGreaterThan(300);
    const log = await page.evaluate(() => (window as never as { log: string[] }).log);
    expect(log[0]).toMatch(/^step \{"position":1,.*"kind":"tags"/);
    expect(log.some((line) => /^done .*"valid":true/.test(line))).toBe(true);
    await figure().getByRole('button', { name: 'Play', exact: true }).first().click();
    await expect.poll(() => figure().evaluate((e) => (e as PillowMeshElement).playing), eventually).toBe(true);
    await page.keyboard.press(' ');
    await expect.poll(() => figure().evaluate((e) => (e as PillowMeshElement).playing)).toBe(false);
  });

  test('opens a mesh file from an address, and says when it cannot', async () => {
    const square = 'MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n1 0 0\n0 1 0\n1 1 0\nQuadrilaterals\n1\n1 2 4 3 1\nEnd\n';
    await visit(
      '<pillow-mesh id="figure" src="square.mesh" metric="h = 0.3"></pillow-mesh><pillow-mesh id="lost" src="none.mesh"></pillow-mesh>',
      { pages: { 'course/square.mesh': square } },
    );
    await expect.poll(() => caption(), eventually).toContain('1 quad.');
    await expect.poll(() => figure('lost').locator('.problem').innerText(), eventually).toMatch(/none\.mesh/);
  });

  test('shows its own content until it is loaded, and can be styled by parts and properties', async () => {
    await visit(
      '<p style="height: 3000px">A long text.</p><pillow-mesh id="figure" controls="none" caption="off"><img alt="A mesh" src="icon.svg"></pillow-mesh>',
      {},
      '<script type="module" src="../pillow-mesh.js"></script><style>pillow-mesh::part(whole) { border: 7px solid red }</style>',
    );
    await expect.poll(() => figure().locator('.whole').count()).toBe(1);
    expect(await figure().locator('canvas').count()).toBe(1); // the timeline's: nothing is drawn yet
    expect(await figure().getByAltText('A mesh').isVisible()).toBe(true);
    expect(await figure().locator('.whole').evaluate((e) => getComputedStyle(e).borderTopWidth)).toBe('7px');
    await figure().scrollIntoViewIfNeeded();
    await figure().locator('.picture canvas').waitFor();
    await expect.poll(() => figure().getByAltText('A mesh').isVisible()).toBe(false);
    expect(await figure().locator('.transport').isVisible()).toBe(false);
  });

  test('plays by itself when asked to, unless the visitor prefers reduced motion', async () => {
    const body = '<pillow-mesh id="figure" case="iso2d" autoplay pace="4"></pillow-mesh>';
    serving = await serveSite({ pages: { 'course/page.html': document_(body) } });
    await open(`${serving.address}course/page.html`, { reducedMotion: 'no-preference' });
    await expect.poll(() => position(), eventually).toBeGreaterThan(2);
    await page.context().close();
    await open(`${serving.address}course/page.html`);
    await expect.poll(() => caption(), eventually).toContain('63 quads');
    await page.waitForTimeout(500);
    expect(await position()).toBe(0);
  });
});

describe('several on one page', () => {
  const many = Array.from({ length: 6 }, (_, i) => `<pillow-mesh id="f${i}" case="iso2d" event="${i}" controls="step"></pillow-mesh>`);

  test('share few workers and one download, and give back what is out of sight', async () => {
    let modules = 0;
    serving = await serveSite({ pages: { 'course/page.html': document_(many.join('')) } });
    await newPage({ viewport: { width: 700, height: 600 } });
    page.on('request', (request) => (modules += /pillowmesh-[^/]*\.wasm$/.test(request.url()) ? 1 : 0));
    await page.goto(`${serving.address}course/page.html`);
    await expect.poll(() => position('f1'), eventually).toBe(1);
    expect(await figure('f5').locator('.picture').count()).toBe(0); // far below: not even begun
    await figure('f5').scrollIntoViewIfNeeded();
    await expect.poll(() => position('f5'), eventually).toBe(5);
    await figure('f5').locator('.picture canvas').waitFor();
    expect(page.workers().length).toBeLessThanOrEqual(3);
    expect(modules).toBeLessThanOrEqual(page.workers().length);
    await expect.poll(() => figure('f0').locator('.picture canvas').count()).toBe(0);
    await figure('f0').scrollIntoViewIfNeeded();
    await figure('f0').locator('.picture canvas').waitFor();
  });
});

const strict = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'";

describe('works', () => {
  test('under a strict content security policy', async () => {
    await visit('<pillow-mesh id="figure" case="iso2d" event="3"></pillow-mesh>', {
      headers: { 'content-security-policy': strict },
    });
    await expect.poll(() => position(), eventually).toBe(3);
    await figure().locator('.picture canvas').waitFor();
    expect(page.workers().length).toBe(1);
    expect(complaints).toEqual([]);
    await page.screenshot({ path: join(screenshots, 'element-csp.png') });
  });

  for (const [host, headers] of [
    ['that lets others load its files', { 'access-control-allow-origin': '*' }],
    ['that does not', {}],
  ] as const)
    test(`in a sandboxed frame on a host ${host}`, async () => {
      await visit(
        '<iframe sandbox="allow-scripts" src="../embed.html#case=iso2d&event=3" width="600" height="560" title="Mesh"></iframe>',
        { headers },
        '',
      );
      const frame = page.frameLocator('iframe');
      await expect.poll(() => frame.locator('pillow-mesh .counter').innerText(), eventually).toMatch(/^3 \/ \d+$/);
      await frame.locator('.picture canvas').waitFor();
      await frame.getByRole('button', { name: 'Step forward' }).click();
      await expect.poll(() => frame.locator('pillow-mesh .counter').innerText(), eventually).toMatch(/^4 \//);
      await page.screenshot({ path: join(screenshots, 'element-sandbox.png') });
    });

  test('from a folder without a server', async () => {
    const folder = join(root, 'build', 'offline');
    mkdirSync(folder, { recursive: true });
    copyFileSync(join(site, 'pillow-mesh.standalone.js'), join(folder, 'pillow-mesh.standalone.js'));
    const script = '<script src="pillow-mesh.standalone.js" defer></script>';
    writeFileSync(join(folder, 'page.html'), document_('<pillow-mesh id="figure" case="linear3d" event="2"></pillow-mesh>', script));
    copyFileSync(join(site, 'icon.svg'), join(folder, '..', 'icon.svg'));
    await open(`file://${join(folder, 'page.html')}`);
    await expect.poll(() => position(), eventually).toBe(2);
    await figure().locator('.picture canvas').waitFor();
    expect(complaints).toEqual([]);
  });

  test('from any subpath, and with a script from another host', async () => {
    serving = await serveSite({ below: '/~someone/a/b/', headers: { 'access-control-allow-origin': '*' } });
    const course = await serveSite({
      pages: {
        'page.html': document_(
          '<pillow-mesh id="figure" case="iso2d" event="2"></pillow-mesh>',
          `<script type="module" src="${serving.address}pillow-mesh.js"></script>`,
        ),
      },
    });
    await open(`${serving.address}embed.html#case=iso2d&event=2`);
    await expect.poll(() => page.locator('.counter').innerText(), eventually).toMatch(/^2 \//);
    await page.context().close();
    await open(`${course.address}page.html`);
    await expect.poll(() => position(), eventually).toBe(2);
    expect(page.workers().length).toBe(1);
    await course.close();
  });
});

describe('the embed page', () => {
  test('tells the page around it how high it is, as course systems and iframe-resizer expect', async () => {
    const listener = `window.said = []; addEventListener('message', ({ data }) => said.push(data));
      document.addEventListener('DOMContentLoaded', () => {
        const frame = document.querySelector('iframe');
        frame.addEventListener('load', () => frame.contentWindow.postMessage('[iFrameSizer]mesh:8:false:false', '*'));
      });`;
    await visit('<iframe src="../embed.html#case=iso2d&theme=dark" width="620" title="Mesh"></iframe>', {}, `<script>${listener}</script>`);
    const said = (): Promise<(string | { subject: string; height: number })[]> =>
      page.evaluate(() => (window as never as { said: string[] }).said);
    await expect.poll(async () => (await said()).length, eventually).toBeGreaterThan(2);
    const height = page.frameLocator('iframe').locator('body');
    await expect
      .poll(async () => {
        const wanted = Math.ceil((await height.boundingBox())!.height);
        const all = await said();
        const last = all.filter((m) => typeof m === 'object' && m.subject === 'lti.frameResize').at(-1);
        const sized = all.some((m) => typeof m === 'string' && m.startsWith(`[iFrameSizer]mesh:${wanted}:`));
        return typeof last === 'object' && last.height === wanted && wanted > 400 && sized;
      }, eventually)
      .toBe(true);
  });
});
