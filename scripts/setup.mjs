// Installs what is missing: Debian/Ubuntu packages, and the npm packages of package-lock.json. Does nothing when all is
// there. Usage: node scripts/setup.mjs [start|test]
import { createHash } from 'node:crypto';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { Failure, isMain, main, root, run, which } from './run.mjs';

/** Each apt package, with a command or file that shows that the machine has the thing from elsewhere. */
const forStart = [
  { apt: 'cmake', has: ['cmake'] },
  { apt: 'ninja-build', has: ['ninja'] },
  { apt: 'g++', has: ['c++'] },
  { apt: 'emscripten', has: ['emcc'] },
  { apt: 'libeigen3-dev', has: ['/usr/include/eigen3/Eigen/Core', '/usr/local/include/eigen3/Eigen/Core'] },
];
const forTest = [
  ...forStart,
  { apt: 'catch2', has: ['/usr/include/catch2/catch.hpp', '/usr/include/catch2/catch_all.hpp'] },
  { apt: 'libcli11-dev', has: ['/usr/include/CLI/CLI.hpp'] },
  { apt: 'libstb-dev', has: ['/usr/include/stb/stb_image.h'] },
  { apt: 'pkg-config', has: ['pkg-config'] },
  { apt: 'python3-meshio', has: ['/usr/lib/python3/dist-packages/meshio/__init__.py'] },
  browser(),
];

/**
 * Chromium without windows draws the same pages in a third of the time, so it is preferred where the system has it as a
 * package; any other Chromium does where that cannot be installed. Ubuntu has Chromium under another name.
 */
function browser() {
  const release = existsSync('/etc/os-release') ? readFileSync('/etc/os-release', 'utf8') : '';
  const any = ['chromium', 'google-chrome', 'google-chrome-stable', 'chromium-browser'];
  if (/^ID=ubuntu$/m.test(release)) return { apt: 'chromium-browser', has: any };
  return { apt: 'chromium-headless-shell', has: ['chromium-headless-shell'], orElse: { apt: 'chromium', has: any } };
}

const present = (thing) => (thing.startsWith('/') ? existsSync(thing) : which(thing) !== null);
const missingFrom = (list) => list.filter(({ has }) => !has.some(present));
/** Of what is missing, what nothing that is there can stand in for. */
const neededFrom = (missing) => missing.filter(({ orElse }) => !orElse?.has.some(present));
const namesOf = (list) => list.map(({ apt }) => apt);

function installPackages(list) {
  const missing = missingFrom(list);
  if (missing.length === 0) return;

  const line = `apt-get update && apt-get install -y --no-install-recommends ${namesOf(missing).join(' ')}`;
  const isRoot = process.getuid?.() === 0;
  const hasApt = which('apt-get') !== null;
  const prefix = isRoot ? [] : ['sudo', '-n'];
  if (!hasApt || !(isRoot || (which('sudo') && run('sudo', ['-n', 'true'], { quiet: true })))) {
    if (neededFrom(missing).length === 0) return;
    const names = namesOf(missing);
    const shown = hasApt ? `sudo sh -c '${line}'` : `install (Debian's names): ${names.join(' ')}`;
    throw new Failure(`Missing: ${names.join(', ')}. Run this line, then try again:\n\n  ${shown}\n`);
  }
  const apt = (...args) => {
    const words = [...prefix, 'env', 'DEBIAN_FRONTEND=noninteractive', 'apt-get', '-q', ...args];
    return run(words[0], words.slice(1));
  };
  const install = (some) => {
    console.log(`Installing ${namesOf(some).join(', ')}`);
    return apt('install', '-y', '--no-install-recommends', ...namesOf(some));
  };
  apt('update');
  if (!install(missing) && missing.some(({ orElse }) => orElse)) {
    // One package that is not to be had must not keep the others away.
    const instead = missingFrom(missing.map(({ orElse, ...wanted }) => orElse ?? wanted));
    if (instead.length > 0) install(instead);
  }
  const left = neededFrom(missingFrom(missing));
  if (left.length > 0) throw new Failure(`apt-get could not install: ${namesOf(left).join(', ')} (see above)`);
}

/** `npm ci`, only when package-lock.json is not the one that node_modules was made from. */
function installNodeModules() {
  const lock = createHash('sha256').update(readFileSync(join(root, 'package-lock.json'))).digest('hex');
  const stamp = join(root, 'node_modules', '.pillowmesh-lock');
  if (existsSync(stamp) && readFileSync(stamp, 'utf8') === lock) return;
  console.log('Installing npm packages');
  const installed = run('npm', ['ci', '--no-audit', '--no-fund', '--loglevel=error'], {
    env: { PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD: '1' },
  });
  if (!installed) throw new Failure('npm ci failed (see above)');
  writeFileSync(stamp, lock);
}

/** Makes the machine ready for `npm start` or `npm test`. */
export function setup(purpose) {
  installPackages(purpose === 'test' ? forTest : forStart);
  installNodeModules();
}

/** The browser that tests and pictures drive: $PILLOWMESH_CHROMIUM, or the first of the usual names. */
export function chromium() {
  const { has, orElse } = browser();
  return process.env.PILLOWMESH_CHROMIUM || ([...has, ...(orElse?.has ?? [])].map(which).find(Boolean) ?? '/usr/bin/chromium');
}

if (isMain(import.meta)) await main(() => setup(process.argv[2] ?? 'test'));
