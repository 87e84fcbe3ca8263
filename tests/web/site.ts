// The built page, served from memory-less static files, and a real browser to look at it with.
import { createServer, type Server } from 'node:http';
import { existsSync, readFileSync, statSync } from 'node:fs';
import type { AddressInfo } from 'node:net';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium, type Browser } from 'playwright-core';
import { build } from 'vite';

export const root = fileURLToPath(new URL('../..', import.meta.url));
export const screenshots = join(root, 'build', 'screenshots');
const site = join(root, 'build', 'site');

const types: Record<string, string> = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
};

/** Builds the page into build/site. */
export async function buildSite(): Promise<void> {
  await build({
    configFile: join(root, 'web', 'vite.config.ts'),
    logLevel: 'error',
    build: { outDir: site, emptyOutDir: true },
  });
}

export interface Serving {
  address: string;
  close(): Promise<void>;
}

/** Serves the built page below a folder, as any static host does. Paths for which `hide` is true are answered with 404. */
export function serveSite(hide?: (path: string) => boolean): Promise<Serving> {
  const server: Server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url ?? '/', 'http://localhost').pathname).replace(/^\/mesh\//, '/');
    const file = normalize(join(site, path.endsWith('/') ? `${path}index.html` : path));
    if (!file.startsWith(site) || hide?.(path) || !existsSync(file) || !statSync(file).isFile()) {
      response.writeHead(404).end('not found');
      return;
    }
    response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' });
    response.end(readFileSync(file));
  });
  return new Promise((resolve) =>
    server.listen(0, '127.0.0.1', () =>
      resolve({
        address: `http://127.0.0.1:${(server.address() as AddressInfo).port}/mesh/`,
        close: () => new Promise((done) => server.close(() => done())),
      }),
    ),
  );
}

/** Headless Chromium with software WebGL 2. */
export function openBrowser(): Promise<Browser> {
  return chromium.launch({
    executablePath: process.env.PILLOWMESH_CHROMIUM || '/usr/bin/chromium',
    args: [
      '--no-sandbox',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
      '--ignore-gpu-blocklist',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
      '--disable-quic',
      '--no-first-run',
    ],
  });
}
