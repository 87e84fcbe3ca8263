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
/** For what has to be computed first. */
export const eventually = { timeout: 60_000 };

beforeAll(async () => {
  mkdirSync(screenshots, { recursive: true });
  [browser, serving] = await Promise.all([openBrowser(), serveSite()]);
});
afterEach(() => page?.context().close());
afterAll(async () => {
  await browser?.close();
  await serving?.close();
});

/** A new visitor, on an empty page. */
export async function newPage(options: BrowserContextOptions = {}): Promise<Page> {
  await page?.context().close();
  const context = await browser.newContext({
    viewport: { width: 1280, height: 800 },
    reducedMotion: 'reduce',
    ...options,
  });
  page = await context.newPage();
  complaints = [];
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('console', (message) => {
    if (message.type() === 'error' || message.type() === 'warning') complaints.push(message.text());
  });
  return page;
}

/** A new visitor at the front page, when its mesh is shown. `hash`: its state, as in a link. */
export async function visit(hash = '', options: BrowserContextOptions = {}): Promise<Page> {
  await newPage(options);
  await page.goto(serving.address + hash);
  await page.locator('.picture canvas').waitFor();
  await expect.poll(() => page.locator('.facts dd').first().innerText(), eventually).toMatch(/\d/);
  return page;
}

/** A part of the state that the address holds. */
export const part = (name: string): string | null => new URLSearchParams(new URL(page.url()).hash.slice(1)).get(name);

/** The picture, when it has come to rest. */
export async function pictureNow(): Promise<Buffer> {
  await page.waitForTimeout(250);
  return page.locator('.picture canvas').screenshot();
}
