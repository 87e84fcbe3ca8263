// What every test file in a browser begins with: a browser, the built site served, one page at a time, and what that page
// complains of. The bindings are live: they are what was opened last.
import { mkdirSync } from 'node:fs';
import type { Browser, BrowserContextOptions, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, expect } from 'vitest';
import { openBrowser, screenshots, serveSite, type Serving } from './site.ts';

export let browser: Browser;
export let serving: Serving;
export let page: Page;
/** Errors that the page threw, and errors and warnings on its console. */
export let complaints: string[] = [];
/** Said of this browser, not of the page: without GPU compositing each picture is read back from the software renderer. */
const ofTheBrowser = /GPU stall due to ReadPixels/;
/** For what has to be computed first. */
export const eventually = { timeout: 60_000 };

beforeAll(async () => {
  mkdirSync(screenshots, { recursive: true });
  [browser, serving] = await Promise.all([openBrowser(), serveSite()]);
});
afterEach(async ({ task }) => {
  if (page !== kept || task.result?.state === 'fail') await leave();
});
afterAll(async () => {
  await browser?.close();
  await serving?.close();
});

/** A page that has been visited in the usual way, for the next visit: a new one's processes are a third of its time. */
let kept: Page | null = null;

async function leave(): Promise<void> {
  kept = null;
  await page?.context().close();
}

/** The kept page as a new visitor has it: nothing stored, nothing allowed, the mouse away, no complaints. */
async function cleared(): Promise<boolean> {
  if (!kept || kept.isClosed() || !kept.url().startsWith(serving.address)) return false;
  await kept.evaluate(() => localStorage.clear());
  await kept.goto('about:blank');
  await kept.context().clearPermissions();
  await kept.emulateMedia({ media: null, colorScheme: 'light', reducedMotion: 'reduce' });
  await kept.mouse.move(0, 0);
  complaints = [];
  return true;
}

/** A new visitor, on an empty page. */
export async function newPage(options: BrowserContextOptions = {}): Promise<Page> {
  await leave();
  const context = await browser.newContext({
    viewport: { width: 1280, height: 800 },
    reducedMotion: 'reduce',
    ...options,
  });
  page = await context.newPage();
  complaints = [];
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('console', (message) => {
    const bad = message.type() === 'error' || message.type() === 'warning';
    if (bad && !ofTheBrowser.test(message.text())) complaints.push(message.text());
  });
  return page;
}

/** A new visitor at the front page, when its mesh is shown. `hash`: its state, as in a link. */
export async function visit(hash = '', options?: BrowserContextOptions): Promise<Page> {
  if (options || !(await cleared())) await newPage(options);
  if (!options) kept = page;
  await page.goto(serving.address + hash);
  await page.locator('.picture canvas').waitFor();
  await expect.poll(() => page.locator('.facts dd').first().innerText(), eventually).toMatch(/\d/);
  return page;
}

/** A part of the state that the address holds. */
export const part = (name: string): string | null => new URLSearchParams(new URL(page.url()).hash.slice(1)).get(name);

/** The picture, when it has come to rest: twice the same. */
export async function pictureNow(): Promise<Buffer> {
  const picture = page.locator('.picture canvas');
  for (let last = await picture.screenshot(); ; ) {
    await page.waitForTimeout(150);
    const now = await picture.screenshot();
    if (now.equals(last)) return now;
    last = now;
  }
}
