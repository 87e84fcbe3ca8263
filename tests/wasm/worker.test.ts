import { describe, expect, test } from 'vitest';
import { decodeEvents } from '../../wasm/events.ts';
import type { CallName, Calls, Reply, Request } from '../../wasm/protocol.ts';
import { Server } from '../../wasm/worker.ts';
import { modulesFrom, type Modules } from '../../wasm/loader.ts';
import { moduleBytes } from './core.ts';

const all = { 2: moduleBytes(2), full: moduleBytes('full'), 3: moduleBytes(3), files: moduleBytes('files'), metrics: moduleBytes('metrics') };

/** The worker's server in this thread: calls as promises, events collected. */
class Bench {
  events = 0;
  dim = 2;
  onEvents: () => void = () => undefined;
  private next = 1;
  private readonly waiting = new Map<number, { resolve(value: unknown): void; reject(error: unknown): void }>();
  private readonly server: Server;

  constructor(modules: Modules = modulesFrom(all)) {
    this.server = new Server({ postMessage: (reply: Reply) => this.receive(reply) }, modules);
  }

  call<N extends CallName>(name: N, args: Calls[N]['args']): Promise<Calls[N]['result']> {
    const id = this.next++;
    const promise = new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
    void this.server.handle({ id, name, args } as Request);
    return promise as Promise<Calls[N]['result']>;
  }

  private receive(reply: Reply): void {
    if (reply.type === 'events') {
      this.events += decodeEvents(this.dim, reply.ints, reply.doubles).length;
      this.onEvents();
    } else if (reply.type === 'answer') this.waiting.get(reply.id)?.resolve(reply.result);
    else this.waiting.get(reply.id)?.reject(reply.failure);
  }
}

const iso2d = { source: { kind: 'case', name: 'iso2d' } } as const;
const pause = (milliseconds: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, milliseconds));

describe('the worker', () => {
  test('streams events while it runs and answers with outcome and report', async () => {
    const bench = new Bench();
    await bench.call('open', iso2d);
    const result = await bench.call('run', { options: { smooth: 'none' } });
    expect(result.outcome.status).toBe('ok');
    expect(result.events).toBe(bench.events);
    expect(JSON.parse(result.report).mesh.cells).toBeGreaterThan(500);
  });

  test('meets a number of cells: full adaptation by the sizes alone, layers by trying other sizes', async () => {
    const bench = new Bench();
    await bench.call('open', { ...iso2d, cells: 900 });
    expect(JSON.parse(await bench.call('report', {})).complexity).toBeCloseTo(900, 0);
    const cells = async (options: Record<string, string>): Promise<number> =>
      JSON.parse((await bench.call('run', { options })).report).mesh.cells;
    expect(Math.abs((await cells({ method: 'full', effort: 'fast' })) / 900 - 1)).toBeLessThan(0.15);
    bench.events = 0;
    const layers = await bench.call('run', { options: { method: 'paper' } });
    expect(Math.abs(JSON.parse(layers.report).mesh.cells / 900 - 1)).toBeLessThan(0.05);
    expect(layers.events).toBe(bench.events); // of the run that counts, not of those before it
    const file = new TextDecoder().decode(await bench.call('write', { name: 'a.mesh', events: layers.events }));
    expect(Number(/Quadrilaterals\s+(\d+)/.exec(file)?.[1])).toBe(JSON.parse(layers.report).mesh.cells);
    expect(await cells({ method: 'paper' })).toBe(JSON.parse(layers.report).mesh.cells); // whatever was run before
    await bench.call('open', { source: { kind: 'case', name: 'circle2d' }, cells: 600 }); // its layers come in large numbers: the nearest
    expect(Math.abs((await cells({ method: 'paper' })) / 600 - 1)).toBeLessThan(0.1);
    await bench.call('metric', { formula: 'h = 1' });
    expect(JSON.parse(await bench.call('report', {})).complexity).toBeCloseTo(4, 6);
  });

  test('stops when told to, with what it had', async () => {
    const bench = new Bench();
    await bench.call('open', iso2d);
    const run = bench.call('run', { options: {} });
    bench.onEvents = () => void bench.call('cancel', {});
    const { outcome, report } = await run;
    expect(outcome.status).toBe('cancelled');
    expect(JSON.parse(report).valid).toBe(true);
  });

  test('pauses, answers meanwhile, and goes on to the same end', async () => {
    const bench = new Bench();
    await bench.call('open', iso2d);
    const straight = await bench.call('run', { options: { effort: 'fast' } });
    const run = bench.call('run', { options: { effort: 'fast' } });
    const before = bench.events;
    await new Promise<void>((resolve) => (bench.onEvents = resolve));
    await bench.call('pause', {});
    await pause(30);
    const held = bench.events;
    await pause(60);
    expect(bench.events).toBe(held);
    expect((await bench.call('tensors', { points: Float64Array.of(0, 0) })).length).toBe(3);
    await bench.call('resume', {});
    const result = await run;
    expect(result.events).toBe(straight.events);
    expect(bench.events - before).toBe(straight.events);
  });

  test('keeps mesh and metric when it refuses others', async () => {
    const bench = new Bench();
    const mesh = await bench.call('open', iso2d);
    await expect(
      bench.call('open', { source: { kind: 'grid', spec: 'grid:2,2:0,1,0,1' }, metric: { formula: 'h = ' } }),
    ).rejects.toMatchObject({ kind: 'refused' });
    await expect(bench.call('metric', { formula: 'h = q' })).rejects.toMatchObject({
      kind: 'refused',
      status: 'usage',
    });
    const shapes = await bench.call('measure', { points: mesh.points, cells: mesh.cells, lengths: true });
    expect(shapes.shapes.length).toBe(63);
    expect(shapes.lengths.length).toBe(142);
  });

  test('fetches the module for hexahedra when a mesh of them is opened, and no sooner', async () => {
    const asked: (number | string)[] = [];
    const { core, files, metrics } = modulesFrom(all);
    const bench = new Bench({
      core: (dim) => (asked.push(dim), core(dim)),
      files: () => (asked.push('files'), files()),
      metrics,
    });
    await bench.call('about', {});
    await bench.call('open', iso2d);
    await bench.call('run', { options: { smooth: 'none' } });
    expect(new Set(asked)).toEqual(new Set([2]));
    const mesh = await bench.call('open', { source: { kind: 'case', name: 'linear3d' } });
    expect(mesh.dim).toBe(3);
    bench.dim = mesh.dim;
    const { outcome, report } = await bench.call('run', { options: { smooth: 'none' } });
    expect(outcome.status).toBe('ok');
    expect(JSON.parse(report).mesh.dim).toBe(3);
    expect((await bench.call('open', iso2d)).dim).toBe(2);
    expect(asked).not.toContain('files');
    expect((await bench.call('write', { name: 'a.vtu' })).length).toBeGreaterThan(1000);
    expect(asked).toContain('files');
  });

  test('opens riemann with the metric of its picture, and adapts to it', async () => {
    const bench = new Bench();
    const mesh = await bench.call('open', { source: { kind: 'case', name: 'riemann' } });
    expect(mesh.cells.length).toBe(4 * 16 * 20);
    expect(JSON.parse(await bench.call('report', {})).complexity).toBeCloseTo(6000, -2);
    const { outcome, report } = await bench.call('run', { options: { smooth: 'none', 'max-cells': '2000' } });
    expect(outcome.status).toBe('limit_not_met');
    expect(JSON.parse(report).mesh.cells).toBeGreaterThan(1000);
    const given = await bench.call('open', { source: { kind: 'case', name: 'riemann' }, metric: { formula: 'h = 0.1' } });
    expect(given.cells.length).toBe(mesh.cells.length);
    expect(JSON.parse(await bench.call('report', {})).complexity).toBeCloseTo(80, 6);
  }, 300_000); // the portrait's metric takes seconds, on a busy machine many

  test('makes a metric from dabs for the mesh that was opened, and adapts to it', async () => {
    const bench = new Bench();
    await bench.call('open', { source: { kind: 'grid', spec: 'grid:4,4:0,1,0,1' }, metric: { formula: 'h = 0.3' } });
    await bench.call('run', { options: { smooth: 'none' } });
    const dabs = [{ x: 0.3, y: 0.3, radius: 0.1, size: 0.02 }];
    const nodal = await bench.call('makeMetric', { dabs, paper: 0.2 });
    await bench.call('metric', { nodal });
    const { outcome, report } = await bench.call('run', { options: { smooth: 'none' } });
    expect(outcome.status).toBe('ok');
    expect(JSON.parse(report).mesh.cells).toBeGreaterThan(100);
    expect(await bench.call('makeMetric', { dabs, paper: 0.2 })).toEqual(nodal); // not for what the run has made
    await expect(bench.call('makeMetric', { dabs: [{ x: 0, y: 0, radius: 0, size: 1 }] })).rejects.toThrow('dab 1');
  });

  test('fetches the module with full adaptation when a run asks for that, and goes on with the same mesh', async () => {
    const asked: (number | string)[] = [];
    const { core, files, metrics } = modulesFrom(all);
    const bench = new Bench({ core: (name) => (asked.push(name), core(name)), files, metrics });
    await bench.call('open', { source: { kind: 'grid', spec: 'grid:4,4:0,1,0,1' } });
    await bench.call('metric', { formula: 'h = 0.03 + 0.1*x' });
    const paper = JSON.parse((await bench.call('run', { options: { method: 'paper' } })).report);
    expect(new Set(asked)).toEqual(new Set([2]));
    const { report } = await bench.call('run', { options: { method: 'full', effort: 'fast' } });
    expect(asked).toContain('full');
    expect(JSON.parse(report).shape.mean).toBeGreaterThan(paper.shape.mean);
    expect((await bench.call('run', { options: { method: 'paper' } })).outcome.status).toBe('ok');
  });

  test('cancels a run that waits for its module', async () => {
    const { core, files, metrics } = modulesFrom(all);
    const slow: Modules['core'] = async (name) => {
      if (name === 'full') await pause(50);
      return core(name);
    };
    const bench = new Bench({ core: slow, files, metrics });
    await bench.call('open', iso2d);
    const run = bench.call('run', { options: { method: 'full' } });
    await bench.call('cancel', {});
    expect((await run).outcome.status).toBe('cancelled');
  });

  test('answers in order what is asked while a mesh waits for its module', async () => {
    const { core, files, metrics } = modulesFrom(all);
    const slow: Modules['core'] = async (dim) => {
      if (dim === 3) await pause(50);
      return core(dim);
    };
    const bench = new Bench({ core: slow, files, metrics });
    const grid = (spec: string) => bench.call('open', { source: { kind: 'grid', spec } });
    const solid = grid('grid:1,1,1:0,1,0,1,0,1');
    const metric = bench.call('metric', { formula: 'h = 1' });
    const tensors = bench.call('tensors', { points: new Float64Array(3) });
    const plane = grid('grid:1,1:0,1,0,1');
    expect((await solid).dim).toBe(3);
    expect(await metric).toBeNull();
    expect((await tensors).length).toBe(6);
    expect((await plane).dim).toBe(2);
  });

  test('a module that cannot be had fails the mesh that wants it, and no other', async () => {
    const bench = new Bench(modulesFrom({ ...all, 3: moduleBytes(3).subarray(0, 100) }));
    const solid = bench.call('open', { source: { kind: 'case', name: 'sphere3d' } });
    await expect(solid).rejects.toMatchObject({ kind: 'load', reason: 'broken' });
    expect((await bench.call('open', iso2d)).dim).toBe(2);
  });

  test('options of one run are not those of the next', async () => {
    const bench = new Bench();
    await bench.call('open', iso2d);
    const coarse = await bench.call('run', { options: { threshold: '5', smooth: 'none' } });
    const normal = await bench.call('run', { options: { smooth: 'none' } });
    expect(normal.events).toBeGreaterThan(coarse.events);
  });

  test('writes the mesh of an earlier event, made again', async () => {
    const bench = new Bench();
    await bench.call('open', iso2d);
    const initial = await bench.call('write', { name: 'a.mesh' });
    await bench.call('run', { options: { smooth: 'none' } });
    expect(await bench.call('write', { name: 'a.mesh', events: 0 })).toEqual(initial);
    const text = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);
    const quads = (bytes: Uint8Array): number => Number(/Quadrilaterals\s+(\d+)/.exec(text(bytes))?.[1]);
    const early = quads(await bench.call('write', { name: 'a.mesh', events: 4 }));
    const last = quads(await bench.call('write', { name: 'a.mesh' }));
    expect(early).toBeGreaterThan(63);
    expect(early).toBeLessThan(last);
    expect(JSON.parse(text(await bench.call('write', { name: 'a.json', events: 4 }))).mesh.cells).toBe(early);
  });
});
