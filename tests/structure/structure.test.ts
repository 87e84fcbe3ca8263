import { describe, expect, it } from 'vitest';
// @ts-expect-error plain JavaScript without types: it runs before TypeScript is installed
import { cycles, inspect, layerOf, privateLines, violations } from '../../scripts/structure.mjs';

describe('the dependency rule', () => {
  it('places every folder of the core', () => {
    expect(layerOf('core/pillowmesh/refine/layer.h')).toBe('refine');
    expect(layerOf('wasm/c_api.cpp')).toBe('c_api');
    expect(layerOf('wasm/session.ts')).toBe('session');
    expect(layerOf('tests/core/mesh_test.cpp')).toBeNull();
  });

  it('accepts what points down', () => {
    expect(violations('core/pillowmesh/adapt/adapter.cpp', '#include "pillowmesh/refine/layer.h"\n')).toEqual([]);
    expect(violations('web/main.ts', "import { run } from '../wasm/session.ts';\n")).toEqual([]);
  });

  it('refuses what points up, with file and line', () => {
    const text = '#include <vector>\n#include <pillowmesh/adapt/options.h>\n';
    expect(violations('core/pillowmesh/mesh/mesh.cpp', text)).toEqual([
      'core/pillowmesh/mesh/mesh.cpp:2: mesh must not depend on adapt (core/pillowmesh/adapt/options.h)',
    ]);
    expect(violations('wasm/session.ts', "export { page } from '../web/main.ts';")).toHaveLength(1);
    expect(violations('wasm/loader.ts', "const page = await import('../web/main.ts');")).toHaveLength(1);
  });

  it('refuses what points sideways', () => {
    expect(violations('cli/main.cpp', '#include "../wasm/c_api.h"')).toHaveLength(1);
    expect(violations('core/pillowmesh/smooth/relocate.cpp', '#include "pillowmesh/refine/hull.h"')).toHaveLength(1);
  });

  it('keeps fields out of refine', () => {
    expect(violations('core/pillowmesh/refine/layer.h', '#include "pillowmesh/metric/field.h"')).toHaveLength(1);
  });

  it('refuses tests and scripts as a part of the product', () => {
    expect(violations('cli/main.cpp', '#include "../tests/catch.h"')).toHaveLength(1);
  });

  it('refuses a folder that has no place in the order', () => {
    expect(violations('core/pillowmesh/misc/thing.h', '')).toHaveLength(1);
  });

  it('finds headers that include each other in a circle', () => {
    const [a, b] = ['core/pillowmesh/mesh/a.h', 'core/pillowmesh/mesh/b.h'];
    const files = new Map([
      [a, '#include "pillowmesh/mesh/b.h"'],
      [b, '#include "pillowmesh/mesh/a.h"'],
    ]);
    expect(cycles(files)).toEqual([[a, b, a]]);
  });

  it('finds download addresses and machine paths', () => {
    expect(privateLines('a.json', '{\n"resolved": "https://host/x.tgz"\n}')).toHaveLength(1);
    expect(privateLines('a.md', 'see /home/someone/mesh.msh')).toHaveLength(1);
    expect(privateLines('a.md', 'see https://example.org')).toEqual([]);
  });
});

describe('this repository', () => {
  const found = inspect();

  it('has sources with dependencies to look at', () => {
    console.log(`${found.sources} sources, ${found.dependencies} dependencies`);
    for (const { path, lines } of found.long) console.log(`long: ${path}, ${lines} lines`);
    expect(found.sources).toBeGreaterThan(20);
    expect(found.dependencies).toBeGreaterThan(50);
  });

  it('depends one way only', () => expect(found.violations).toEqual([]));
  it('has no circles of includes or imports', () => expect(found.cycles).toEqual([]));
  it('contains no download addresses and no machine paths', () => expect(found.privateLines).toEqual([]));
});
