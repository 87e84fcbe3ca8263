import { beforeAll, describe, expect, test } from 'vitest';
import { decodeEvents, type MeshEvent } from '../../wasm/events.ts';
import type { Core } from '../../wasm/loader.ts';
import type { MeshArrays, Session } from '../../wasm/session.ts';
import { ReplayMesh } from '../../web/src/replay/replay_mesh.ts';
import { load, open, reportOf, runToEnd, write } from './core.ts';

let core: Core;
beforeAll(async () => {
  core = await load();
});

interface Recorded {
  session: Session;
  initial: ReplayMesh;
  events: MeshEvent[];
}

function record(name: string, options: Record<string, string> = {}): Recorded {
  const session = open(core, { kind: 'case', name }, undefined, options);
  const initial = new ReplayMesh(session.mesh());
  runToEnd(session);
  const { ints, doubles } = session.takeEvents();
  return { session, initial, events: decodeEvents(session.dimension(), ints, doubles) };
}

describe('a run', () => {
  test('gives the same mesh, bit for bit, every time and however it is sliced', () => {
    const { session: first } = record('circle2d', { effort: 'fast' });
    const second = open(core, { kind: 'case', name: 'circle2d' }, undefined, { effort: 'fast' });
    second.begin();
    while (!second.step(1)) second.takeEvents();
    expect(second.mesh()).toEqual(first.mesh());
    expect(write(second, 'a.vtu')).toEqual(write(first, 'a.vtu'));
    first.destroy();
    second.destroy();
  });

  test('can begin again from the loaded mesh, with other options', () => {
    const { session } = record('iso2d', { smooth: 'none' });
    const cells = reportOf(session).mesh.cells;
    session.setOption('threshold', '4');
    runToEnd(session);
    expect(reportOf(session).mesh.cells).toBeLessThan(cells);
    session.destroy();
  });

  test('may be left after any step, with a valid mesh', () => {
    const session = open(core, { kind: 'case', name: 'iso2d' });
    session.begin();
    for (let i = 0; i < 60; ++i) {
      expect(session.step()).toBeNull();
      if (i % 10 === 0) expect(reportOf(session).valid).toBe(true);
    }
    session.destroy();
  });

  test('stops before a limit would be passed, and says so', () => {
    const session = open(core, { kind: 'case', name: 'iso2d' }, undefined, { 'max-cells': '300' });
    const outcome = runToEnd(session);
    expect(outcome.status).toBe('limit_not_met');
    expect(outcome.message).toContain('300');
    expect(reportOf(session).mesh.cells).toBeLessThanOrEqual(300);
    session.destroy();
  });

  test('meets the threshold without smoothing', () => {
    const { session } = record('iso2d', { smooth: 'none' });
    expect(reportOf(session).edge_length.max).toBeLessThanOrEqual(2);
    session.destroy();
  });
});

describe('its events', () => {
  const variants: Record<string, string>[] = [{}, { smooth: 'between', thickness: '2' }, { dice: '2' }];
  for (const options of variants)
    test(`rebuild the mesh forwards and the initial mesh backwards, options ${JSON.stringify(options)}`, () => {
      const { session, initial, events } = record('circle2d', options);
      const replay = new ReplayMesh({ dim: 2, ...initial.snapshot() });
      for (const event of events) replay.apply(event.delta, event.iteration);
      const { points, cells } = session.mesh();
      expect(replay.snapshot()).toEqual({ points, cells });
      for (const event of [...events].reverse()) replay.revert(event.delta);
      expect(replay.snapshot()).toEqual(initial.snapshot());
      session.destroy();
    });

  test('tell a layer, its shrinking and its connecting in that order', () => {
    const { session, events } = record('iso2d', { smooth: 'none' });
    const kinds = events.map((e) => e.kind);
    expect(kinds[0]).toBe('tags');
    expect(events[0].edges.length).toBeGreaterThan(0);
    kinds.forEach((kind, i) => {
      if (kind === 'layer') expect(kinds.slice(i, i + 3)).toEqual(['layer', 'shrink', 'connect']);
    });
    for (const [i, event] of events.entries()) {
      if (event.kind !== 'layer') continue;
      // The buffer layer is an extrusion of the hull: one cell per hull facet.
      expect(events[i + 2].cells.length).toBe(event.hull.length / 2);
      expect(event.cells.length).toBeGreaterThan(0);
    }
    session.destroy();
  });
});

/** Where the vertices are that cells have; a run leaves others behind. */
function placesOf({ dim, points, cells }: MeshArrays): Set<string> {
  const live = cells.filter((vertex) => vertex >= 0);
  return new Set(Array.from(live, (vertex) => String(points.subarray(dim * vertex, dim * (vertex + 1)))));
}

describe('files', () => {
  for (const name of ['a.mesh', 'a.msh', 'a.vtk', 'a.vtu'])
    test(`${name} holds the adapted mesh exactly`, () => {
      const { session } = record('aniso2d');
      const bytes = write(session, name);
      const again = open(core, { kind: 'file', name, bytes }, { formula: 'h = 1' });
      expect(again.mesh().cells.length).toBe(reportOf(session).mesh.cells * 4);
      expect(write(again, 'b.vtu')).toEqual(
        write(open(core, { kind: 'file', name: 'b.vtu', bytes: write(again, 'b.vtu') }), 'b.vtu'),
      );
      expect(again.mesh().points.length).toBe(2 * reportOf(session).mesh.vertices);
      expect(placesOf(again.mesh())).toEqual(placesOf(session.mesh()));
      session.destroy();
      again.destroy();
    });
});
