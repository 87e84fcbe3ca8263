// How fast the page is, in Chromium: interactive after, long tasks while a run plays, stroke to adapted mesh, memory over
// many runs. Usage: node scripts/site.mjs && node bench/page.mjs [RUNS]; prints JSON.
import { createServer } from 'node:http';
import { existsSync, readFileSync, statSync } from 'node:fs';
import { extname, join } from 'node:path';
import { chromium } from 'playwright-core';
import { main, root } from '../scripts/run.mjs';

const site = join(root, 'build', 'site');
const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm' };
const runs = Number(process.argv[2] ?? 20);

function serve() {
  const server = createServer((request, response) => {
    const path = new URL(request.url, 'http://x').pathname;
    const file = join(site, path === '/' ? 'index.html' : path);
    if (!file.startsWith(site) || !existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end();
    response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' });
    response.end(readFileSync(file));
  });
  return new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(server)));
}

/** Milliseconds until the page has numbers and a picture to press play on. */
async function interactive(browser, address, throttle) {
  const context = await browser.newContext({ viewport: { width: 1366, height: 768 }, reducedMotion: 'reduce' });
  const page = await context.newPage();
  const session = await context.newCDPSession(page);
  await session.send('Emulation.setCPUThrottlingRate', { rate: throttle });
  await page.goto(`${address}#case=iso2d`);
  await page.waitForFunction(() => /\d/.test(document.querySelector('.facts dd')?.textContent ?? '') && document.querySelector('.picture canvas'));
  const time = await page.evaluate(() => performance.now());
  await context.close();
  return Math.round(time);
}

/** The longest task, in milliseconds, while a run plays for some seconds. */
async function longTasks(browser, address) {
  const context = await browser.newContext({ viewport: { width: 1366, height: 768 } });
  const page = await context.newPage();
  await page.goto(`${address}#case=circle2d&pace=16`);
  await page.waitForFunction(() => /\d/.test(document.querySelector('.facts dd')?.textContent ?? ''));
  await page.evaluate(() => {
    window.tasks = [];
    new PerformanceObserver((list) => list.getEntries().forEach((entry) => window.tasks.push(entry.duration))).observe({ entryTypes: ['longtask'] });
  });
  await page.keyboard.press(' ');
  await page.waitForTimeout(8000);
  const tasks = await page.evaluate(() => window.tasks);
  await context.close();
  return { over50: tasks.length, longest: Math.round(Math.max(0, ...tasks)) };
}

/** Milliseconds from a metric to its adapted mesh, the median of several, and the heap before and after. */
async function strokes(browser, address) {
  const context = await browser.newContext({ viewport: { width: 1366, height: 768 }, reducedMotion: 'reduce' });
  const page = await context.newPage();
  await page.goto(`${address}embed.html#mesh=grid:10,10:0,1,0,1&metric=h = 0.1&controls=none`);
  const result = await page.evaluate(async (runs) => {
    const figure = document.querySelector('pillow-mesh');
    await figure.ready;
    const times = [];
    let cells = 0;
    const heap = () => performance.memory?.usedJSHeapSize ?? 0;
    let first = 0;
    for (let i = 0; i < runs; ++i) {
      const start = performance.now();
      const done = new Promise((resolve) => figure.addEventListener('done', resolve, { once: true }));
      figure.setAttribute('event', 'last');
      figure.setAttribute('sketch', `0.008,1:0.2,0.${2 + (i % 5)},0.5,0.5,0.8,0.6`);
      const { detail } = await done;
      times.push(performance.now() - start);
      cells = detail.report.mesh.cells;
      if (i === Math.min(4, runs - 1)) first = heap();
    }
    times.sort((a, b) => a - b);
    return { cells, median: Math.round(times[times.length >> 1]), heapAfterFive: first, heapAtEnd: heap(), runs };
  }, runs);
  await context.close();
  return result;
}

await main(async () => {
  const server = await serve();
  const address = `http://127.0.0.1:${server.address().port}/`;
  const browser = await chromium.launch({
    executablePath: process.env.PILLOWMESH_CHROMIUM || '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--enable-precise-memory-info'],
  });
  try {
    const report = {
      interactive: await interactive(browser, address, 1),
      interactiveThrottled4: await interactive(browser, address, 4),
      playing: await longTasks(browser, address),
      stroke: await strokes(browser, address),
    };
    console.log(JSON.stringify(report, null, 2));
  } finally {
    await browser.close();
    server.close();
  }
});
