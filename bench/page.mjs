// How fast the page is, in Chromium: interactive after, long tasks while a run plays, stroke to adapted mesh, processor time
// of a frame of a large mesh, memory over many runs. Usage: node scripts/site.mjs && node bench/page.mjs [RUNS [PART]];
// prints JSON. Parts: interactive playing stroke frames memory.
import { createServer } from 'node:http';
import { existsSync, readFileSync, statSync } from 'node:fs';
import { extname, join } from 'node:path';
import { chromium } from 'playwright-core';
import { gzipSync } from 'node:zlib';
import { main, root } from '../scripts/run.mjs';
import { chromium as browserProgram } from '../scripts/setup.mjs';

const site = join(root, 'build', 'site');
const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm' };
const runs = Number(process.argv[2] ?? 20);
const wanted = process.argv[3];
/** What was fetched since this was emptied: path and bytes, as hosts send them, compressed. */
let fetched = [];

function serve() {
  const server = createServer((request, response) => {
    const path = new URL(request.url, 'http://x').pathname;
    const file = join(site, path === '/' ? 'index.html' : path);
    if (!file.startsWith(site) || !existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end();
    const body = compressed(file);
    fetched.push({ path, bytes: body.length });
    response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream', 'content-encoding': 'gzip' });
    response.end(body);
  });
  return new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(server)));
}

const bodies = new Map();
function compressed(file) {
  const body = bodies.get(file) ?? gzipSync(readFileSync(file), { level: 9 });
  bodies.set(file, body);
  return body;
}

/**
 * Milliseconds until the page has numbers and a picture to press play on: by the clock, and, when `traced`, of processor
 * time of its threads (which tracing makes longer), with what was fetched until then.
 */
async function interactive(browser, address, throttle, traced = false) {
  const context = await browser.newContext({ viewport: { width: 1366, height: 768 }, reducedMotion: 'reduce' });
  const page = await context.newPage();
  const session = await context.newCDPSession(page);
  await session.send('Emulation.setCPUThrottlingRate', { rate: throttle });
  fetched = [];
  const start = async () => {
    await page.goto(`${address}#case=iso2d`);
    await page.waitForFunction(() => /\d/.test(document.querySelector('.facts dd')?.textContent ?? '') && document.querySelector('.picture canvas'));
  };
  const processor = traced ? await processorTime(browser, page, start) : await start();
  const time = Math.round(await page.evaluate(() => performance.now()));
  const bytes = fetched.reduce((all, one) => all + one.bytes, 0);
  await context.close();
  return traced ? { processor, requests: fetched.length, bytes } : time;
}

/**
 * Tasks of the page's main thread while a run plays for some seconds, in milliseconds: the longest by the clock, which
 * counts what other programs and a graphics card made of software take as well, and the longest by processor time.
 */
async function longTasks(browser, address) {
  const context = await browser.newContext({ viewport: { width: 1366, height: 768 } });
  const page = await context.newPage();
  await page.goto(`${address}#case=circle2d&pace=16`);
  await page.waitForFunction(() => /\d/.test(document.querySelector('.facts dd')?.textContent ?? ''));
  await page.waitForTimeout(1000);
  await browser.startTracing(page, { categories: ['toplevel', '__metadata'] });
  await page.keyboard.press(' ');
  await page.waitForTimeout(8000);
  const { traceEvents } = JSON.parse((await browser.stopTracing()).toString());
  await context.close();
  const threads = traceEvents.filter(({ name, args }) => name === 'thread_name' && args.name === 'CrRendererMain');
  const of = ({ pid, tid }) => traceEvents.filter((e) => e.ph === 'X' && e.pid === pid && e.tid === tid && /RunTask$/.test(e.name));
  const busiest = threads.map(of).sort((a, b) => sum(b) - sum(a))[0];
  const longest = (key) => Math.round(Math.max(...busiest.map((e) => (e[key] ?? 0) / 1000)));
  return { tasks: busiest.length, over50: busiest.filter(({ tdur }) => tdur > 50_000).length, longestClock: longest('dur'), longestProcessor: longest('tdur') };
}
const sum = (events) => events.reduce((all, { tdur = 0 }) => all + tdur, 0);

/** Milliseconds of processor time that the workers and the main threads of all pages take for something. */
async function processorTime(browser, page, action) {
  await browser.startTracing(page, { categories: ['toplevel', '__metadata'] });
  await action();
  const { traceEvents } = JSON.parse((await browser.stopTracing()).toString());
  const ofOne = ({ pid, tid }) => {
    const tasks = traceEvents.filter((e) => e.ph === 'X' && e.pid === pid && e.tid === tid).sort((a, b) => a.ts - b.ts || b.dur - a.dur);
    let [end, total] = [0, 0];
    for (const { ts, dur, tdur = 0 } of tasks) if (ts >= end) [end, total] = [ts + dur, total + tdur]; // outermost ones
    return Math.round(total / 1000);
  };
  const of = (name) => Math.max(0, ...traceEvents.filter((e) => e.name === 'thread_name' && e.args.name.startsWith(name)).map(ofOne));
  return { worker: of('DedicatedWorker'), page: of('CrRendererMain') };
}

/** An element on an empty page, without controls. */
async function figure(browser, address, state) {
  const context = await browser.newContext({ viewport: { width: 1366, height: 768 }, reducedMotion: 'reduce' });
  const page = await context.newPage();
  await page.goto(`${address}embed.html#${state}&controls=none`);
  await page.evaluate(() => document.querySelector('pillow-mesh').ready);
  return { context, page };
}

/** Milliseconds from each of some strokes to its mesh, adapted by a method: least and median by the clock; processor time of one. */
async function strokes(browser, address, options, size) {
  const { context, page } = await figure(browser, address, 'mesh=grid:10,10:0,1,0,1&metric=h = 0.1');
  const result = await page.evaluate(
    async ([options, size, runs]) => {
      const element = document.querySelector('pillow-mesh');
      for (const [name, value] of Object.entries(options)) element.setAttribute(name, value);
      const times = [];
      let report = null;
      for (let i = 0; i <= runs; ++i) {
        const start = performance.now();
        const done = new Promise((resolve) => element.addEventListener('done', resolve, { once: true }));
        element.setAttribute('event', 'last');
        element.setAttribute('sketch', `${size},1:0.2,0.${2 + (i % 5)}${i % 10},0.5,0.5,0.8,0.6`);
        const { detail } = await done;
        if (i > 0) times.push(performance.now() - start); // the first waits for its module
        report = detail.report;
      }
      times.sort((a, b) => a - b);
      const { mesh, edge_length, shape, seconds } = report;
      return { cells: mesh.cells, cv: edge_length.cv, eta: shape.mean, least: Math.round(times[0]), median: Math.round(times[times.length >> 1]), core: seconds };
    },
    [options, size, 9],
  );
  const processor = await processorTime(browser, page, () =>
    page.evaluate(async (size) => {
      const element = document.querySelector('pillow-mesh');
      const done = new Promise((resolve) => element.addEventListener('done', resolve, { once: true }));
      element.setAttribute('sketch', `${size},1:0.2,0.25,0.5,0.5,0.8,0.6`);
      await done;
    }, size),
  );
  await context.close();
  return { ...result, processor };
}

/** Milliseconds of the page's main thread for each frame while the camera moves: what is drawn takes no part in it. */
async function frames(browser, address, mesh) {
  const { context, page } = await figure(browser, address, `mesh=${mesh}&metric=h = 1&hide=ellipses`);
  await page.locator('pillow-mesh .picture canvas').waitFor();
  await page.locator('pillow-mesh').focus();
  const session = await context.newCDPSession(page);
  await session.send('Performance.enable');
  const times = async () => Object.fromEntries((await session.send('Performance.getMetrics')).metrics.map(({ name, value }) => [name, 1000 * value]));
  const turn = (count) =>
    page.evaluate(async (count) => {
      const keys = document.querySelector('pillow-mesh').shadowRoot;
      for (let i = 0; i < count; ++i) {
        const target = keys.querySelector('.transport button') ?? keys.firstElementChild;
        target.dispatchEvent(new KeyboardEvent('keydown', { key: i % 8 < 4 ? 'ArrowLeft' : 'ArrowRight', ctrlKey: true, bubbles: true, composed: true }));
        await new Promise((resolve) => requestAnimationFrame(resolve));
      }
    }, count);
  await turn(5);
  const before = await times();
  await turn(40);
  const after = await times();
  await context.close();
  const each = (name) => Number(((after[name] - before[name]) / 40).toFixed(2));
  return { task: each('TaskDuration'), script: each('ScriptDuration'), whole: each('Timestamp') };
}

/** Bytes after collecting garbage, at the start and after each tenth of the runs. */
async function memory(browser, address) {
  const { context, page } = await figure(browser, address, 'case=circle2d&method=full&effort=fast');
  const session = await context.newCDPSession(page);
  const bytes = [];
  for (let i = 0; i < runs; ++i) {
    await page.evaluate(async (i) => {
      const element = document.querySelector('pillow-mesh');
      const done = new Promise((resolve) => element.addEventListener('done', resolve, { once: true }));
      element.setAttribute('align', String((i % 10) / 10)); // another run each time
      await new Promise((resolve) => setTimeout(resolve)); // attributes are taken together
      await element.run();
      await done;
    }, i);
    if (i % Math.ceil(runs / 10)) continue;
    await session.send('HeapProfiler.collectGarbage');
    const { usedSize, embedderHeapUsedSize = 0, backingStorageSize = 0 } = await session.send('Runtime.getHeapUsage');
    const { processInfo } = await (await browser.newBrowserCDPSession()).send('SystemInfo.getProcessInfo');
    const resident = processInfo.filter(({ type }) => type === 'renderer').map(({ id }) => residentOf(id));
    bytes.push({ run: i + 1, heap: usedSize, embedder: embedderHeapUsedSize, buffers: backingStorageSize, renderers: Math.max(0, ...resident) });
  }
  await context.close();
  return bytes;
}

/** Bytes of a process in memory, where the system tells (Linux): the worker with its modules is a part of it. */
function residentOf(process) {
  try {
    return 1024 * Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${process}/status`, 'utf8'))?.[1] ?? 0);
  } catch {
    return 0;
  }
}

async function several(times, measure) {
  const found = [];
  for (let i = 0; i < times; ++i) found.push(await measure());
  return found;
}

await main(async () => {
  const server = await serve();
  const address = `http://127.0.0.1:${server.address().port}/`;
  const browser = await chromium.launch({
    executablePath: browserProgram(),
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--enable-precise-memory-info'],
  });
  try {
    const full = { method: 'full', effort: 'fast' };
    const parts = {
      interactive: async () => ({
        plain: await several(5, () => interactive(browser, address, 1)),
        throttled4: await several(3, () => interactive(browser, address, 4)),
        ...(await interactive(browser, address, 1, true)),
      }),
      playing: () => longTasks(browser, address),
      stroke: async () => ({
        paper: await strokes(browser, address, { method: 'paper' }, 0.0058),
        full: await strokes(browser, address, full, 0.005),
      }),
      frames: async () => ({
        quads100000: await frames(browser, address, 'grid:400,250:0,1.6,0,1'),
        hexes50653: await frames(browser, address, 'grid:37,37,37:0,1,0,1,0,1'),
      }),
      memory: () => memory(browser, address),
    };
    const report = {};
    for (const [name, measure] of Object.entries(parts)) if (!wanted || wanted === name) report[name] = await measure();
    console.log(JSON.stringify(report, null, 2));
  } finally {
    await browser.close();
    server.close();
  }
});
