// The built page, served from memory-less static files, and a real browser to look at it with.
import { createServer, type Server } from 'node:http';
import { existsSync, readFileSync, readdirSync, statSync } from 'node:fs';
import type { AddressInfo } from 'node:net';
import { extname, join, normalize, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium, type Browser } from 'playwright-core';
// @ts-expect-error a plain script without types
import { chromium as browserProgram } from '../../scripts/setup.mjs';
// @ts-expect-error a plain script without types
import { buildSite as build } from '../../scripts/site.mjs';

export const root = fileURLToPath(new URL('../..', import.meta.url));
export const screenshots = join(root, 'build', 'screenshots');
export const site = join(root, 'build', 'site');

const types: Record<string, string> = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
};

/** Builds the site into build/site; done once for the suite (build_site.ts). */
export const buildSite = (): Promise<void> => build(site);

export interface Serving {
  address: string;
  close(): Promise<void>;
}

export interface ServeOptions {
  /** Paths below the site that are answered with 404. */
  hide?: (path: string) => boolean;
  /** Sent with every answer. */
  headers?: Record<string, string>;
  /** More pages, by their path below the site. */
  pages?: Record<string, string | Buffer>;
  /** Where the site is on its host. */
  below?: string;
}

/** Serves the built site below a folder, as any static host does. */
export function serveSite({ hide, headers = {}, pages = {}, below = '/mesh/' }: ServeOptions = {}): Promise<Serving> {
  const server: Server = createServer((request, response) => {
    const asked = decodeURIComponent(new URL(request.url ?? '/', 'http://localhost').pathname);
    const path = asked.startsWith(below) ? asked.slice(below.length) : '..';
    const type = types[extname(path) || '.html'] ?? 'application/octet-stream';
    const file = normalize(join(site, path === '' || path.endsWith('/') ? `${path}index.html` : path));
    if (path in pages) {
      response.writeHead(200, { 'content-type': type, ...headers }).end(pages[path]);
    } else if (!file.startsWith(site) || hide?.(path) || !existsSync(file) || !statSync(file).isFile()) {
      response.writeHead(404).end('not found');
    } else {
      response.writeHead(200, { 'content-type': type, ...headers }).end(readFileSync(file));
    }
  });
  return new Promise((resolve) =>
    server.listen(0, '127.0.0.1', () =>
      resolve({
        address: `http://127.0.0.1:${(server.address() as AddressInfo).port}${below}`,
        close: () =>
          new Promise((done) => {
            server.close(() => done());
            server.closeAllConnections();
          }),
      }),
    ),
  );
}

/** Serves a folder's files at the root of a host. */
export function serveFolder(folder: string): Promise<Serving> {
  const pages = Object.fromEntries(
    readdirSync(folder, { recursive: true, withFileTypes: true })
      .filter((entry) => entry.isFile())
      .map((entry) => join(entry.parentPath, entry.name))
      .map((path) => [relative(folder, path), readFileSync(path)]),
  );
  return serveSite({ below: '/', pages });
}

/** Headless Chromium with software WebGL 2. */
export function openBrowser(): Promise<Browser> {
  return chromium.launch({
    executablePath: (browserProgram as () => string)(),
    args: [
      '--no-sandbox',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
      '--ignore-gpu-blocklist',
      // A software renderer is for the picture; text and boxes are drawn faster without it.
      '--disable-gpu-compositing',
      '--disable-gpu-rasterization',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
      '--disable-quic',
      '--no-first-run',
    ],
  });
}
