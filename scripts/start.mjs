// npm start: installs what is missing, builds the core to WebAssembly, serves the page. Arguments go to vite:
// npm start -- --port 8080 --host
import { spawn } from 'node:child_process';
import { join } from 'node:path';
import { build } from './build.mjs';
import { main, root } from './run.mjs';
import { setup } from './setup.mjs';

await main(async () => {
  setup('start');
  await build('wasm');
  const vite = join(root, 'node_modules', 'vite', 'bin', 'vite.js');
  const server = spawn(process.execPath, [vite, 'web', ...process.argv.slice(2)], { cwd: root, stdio: 'inherit' });
  server.on('exit', (status) => process.exit(status ?? 1));
  for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => server.kill(signal));
});
