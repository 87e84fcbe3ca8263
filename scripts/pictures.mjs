// Renders the pictures of README and docs from the real program: opens the built page in headless Chromium, lets it
// compute, and takes what it shows. Usage: node scripts/pictures.mjs [NAME...]; needs build/wasm (npm run build).
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { chromium } from 'playwright-core';
import { build, preview } from 'vite';
import { main, root } from './run.mjs';
import { chromium as browserProgram } from './setup.mjs';

/** What each picture shows: the state as a link, the size in CSS pixels, and which part of the page. */
const pictures = [
  {
    name: 'hex',
    hash: 'case=linear3d&event=last&edges=irregular&cut=plane:-90,0,0.5&view=0.5,0.6,0.5;1.1;0.5,-0.75,0.4',
    width: 1280,
    height: 800,
    scheme: 'light',
    scale: 1,
  },
  { name: 'page', hash: 'case=circle2d&event=44', width: 1360, height: 850, scheme: 'light', scale: 1 },
  { name: 'page-dark', hash: 'case=circle2d&event=70&hide=ellipses', width: 1360, height: 850, scheme: 'dark', scale: 1 },
  ...['tags', 'layer', 'shrink', 'connect'].map((name, i) => ({
    name: `step-${i + 1}-${name}`,
    hash: `case=iso2d&event=${[1, 14, 15, 16][i]}&hide=ellipses`,
    width: 1180,
    height: 620,
    scheme: 'light',
    part: '.picture',
  })),
  ...['iso2d', 'aniso2d', 'circle2d'].map((name) => ({
    name,
    hash: `case=${name}&event=last&hide=ellipses`,
    width: 1180,
    height: 820,
    scheme: 'light',
    part: '.picture',
  })),
];

const browserArguments = [
  '--no-sandbox',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  '--ignore-gpu-blocklist',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
  '--disable-quic',
  '--no-first-run',
];

/** Waits until the page has computed and measured what its link asks for. */
async function settle(page) {
  await page.waitForFunction(() => / in [\d.]+ s/.test(document.querySelector('.status')?.textContent ?? ''), null, {
    timeout: 120_000,
  });
  const cells = () => page.locator('.facts dd').first().innerText();
  for (let before = ''; before !== (await cells());) {
    before = await cells();
    await page.waitForTimeout(900);
  }
}

async function take(browser, address, { name, hash, width, height, scheme, part, scale = 1.5 }) {
  const page = await browser.newPage({
    viewport: { width, height },
    colorScheme: scheme,
    reducedMotion: 'reduce',
    deviceScaleFactor: scale,
  });
  await page.goto(`${address}#${hash}`);
  await settle(page);
  const target = part ? page.locator(part) : page;
  writeFileSync(join(root, 'docs', 'images', `${name}.png`), await target.screenshot());
  console.log(`docs/images/${name}.png: ${(await page.locator('#caption .text').innerText()).trim()}`);
  await page.close();
}

await main(async () => {
  const wanted = process.argv.slice(2);
  const site = {
    configFile: join(root, 'web', 'vite.config.ts'),
    logLevel: 'error',
    build: { outDir: join(root, 'build', 'site'), emptyOutDir: true },
  };
  mkdirSync(join(root, 'docs', 'images'), { recursive: true });
  await build(site);
  const server = await preview({ ...site, preview: { port: 0, host: '127.0.0.1' } });
  const browser = await chromium.launch({
    executablePath: browserProgram(),
    args: browserArguments,
  });
  try {
    for (const picture of pictures)
      if (wanted.length === 0 || wanted.includes(picture.name))
        await take(browser, server.resolvedUrls.local[0], picture);
  } finally {
    await browser.close();
    await server.close();
  }
});
