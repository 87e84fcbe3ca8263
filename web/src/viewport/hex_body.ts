// A hexahedral mesh as it is looked into: solid cells, cells of glass, irregular edges. Rebuilt when the mesh or what
// is hidden changes, never while the camera moves.
import { Group, type Matrix4 } from 'three';
import { Anatomy } from '../inside/anatomy.ts';
import { drawing, glassFacets, solidFacets } from '../inside/facets.ts';
import { irregularKinds } from '../inside/irregular_edges.ts';
import { keptCells, type Inside } from '../inside/look_inside.ts';
import { outlineOf, reliefOf } from '../inside/relief.ts';
import type { ReplayMesh } from '../replay/replay_mesh.ts';
import type { Scene } from '../replay/scene.ts';
import type { Mark } from '../state/settings.ts';
import { FaceLayer, type Origins } from './face_layer.ts';
import type { Palette } from './palette.ts';
import { segmentsOf } from './segments.ts';
import { Strokes } from './strokes.ts';

/** What came of it. */
export interface InsideReport {
  /** Cells that are left, of how many. */
  kept: number;
  total: number;
  /** How many layers can be peeled off before nothing is left. */
  deepest: number;
  /** Irregular edges of the whole mesh in the order of irregularKinds; null: not looked for. */
  irregular: readonly number[] | null;
}

/** How it is to be drawn. */
export interface Wishes {
  inside: Inside;
  shown: Record<Mark, boolean>;
  /** Cells that are filtered out. */
  faded: (cell: number) => boolean;
  /** Where vertices were before the change that is being shown. */
  origins?: Origins | undefined;
  /** There are metric ellipsoids to be seen inside. */
  glyphs: boolean;
}

export class HexBody {
  readonly object = new Group();
  private readonly glass = new FaceLayer(true);
  /** Each kind twice: what is hidden shines through faintly. */
  private readonly edges = irregularKinds.map((_, kind) => [
    new Strokes({ width: 2.6, opacity: 0.3 }, 2),
    new Strokes({ width: 3.6, lift: 4e-4 }, 3 + 0.1 * kind),
  ]);
  private readonly outline = new Strokes({ width: 2, lift: 3e-4, outline: true }, 1);
  private anatomy: Anatomy | null = null;

  constructor() {
    this.glass.object.renderOrder = 1;
    this.object.add(this.glass.object, ...this.strokes.map((strokes) => strokes.object));
  }

  get strokes(): Strokes[] {
    return [this.outline, ...this.edges.flat()];
  }

  setPalette(palette: Palette): void {
    this.glass.setPalette(palette);
    this.outline.setColour(palette.outline);
    this.edges.forEach((pair, kind) => pair.forEach((strokes) => strokes.setColour(palette.irregular[kind])));
  }

  setColours(colours: Uint8Array<ArrayBuffer> | null): void {
    this.glass.setColours(colours);
  }

  setLineWidth(pixels: number): void {
    this.glass.setLineWidth(pixels);
  }

  setProgress(progress: number): void {
    this.glass.setProgress(progress);
    this.outline.object.visible = progress === 1; // it is that of the mesh as it will be
  }

  /** Nothing is drawn any more, e.g. because a mesh of quadrilaterals came. */
  clear(): void {
    this.anatomy = null;
    this.object.visible = false;
  }

  /** Facets and edges anew, solid ones into `solid`. Cost: linear in the mesh; what its shape gives is kept. */
  rebuild(
    solid: FaceLayer,
    mesh: ReplayMesh,
    scene: Scene,
    wishes: Wishes,
  ): InsideReport {
    const { inside, faded, origins } = wishes;
    const start = performance.now();
    if (this.anatomy?.mesh !== mesh) this.anatomy = new Anatomy(mesh);
    const { anatomy } = this;
    this.object.visible = true;
    const kept = keptCells(mesh, inside, () => anatomy.depths.depths, faded);
    const report: InsideReport = {
      kept: kept.reduce((sum, k) => sum + k, 0),
      total: mesh.liveCellCount(),
      deepest: anatomy.depths.deepest,
      irregular: inside.irregular ? anatomy.irregular.map((edges) => edges.length / 2) : null,
    };
    const draw = this.drawingOf(kept, scene, inside, wishes);
    const seen = solidFacets(mesh, anatomy.neighbours, draw);
    const relief = reliefOf(mesh, seen);
    const { edges, normals } = outlineOf(mesh.vertexCount, seen, relief);
    solid.replace(mesh, seen, relief, origins);
    this.outline.setSegments(segmentsOf(mesh, edges), normals);
    const glass = glassFacets(mesh, anatomy.neighbours, draw);
    this.glass.replace(mesh, glass, reliefOf(mesh, glass), origins);
    this.setEdges(mesh, kept, inside.irregular);
    performance.measure('pillowmesh: facets', { start });
    return report;
  }

  /** As FaceLayer.paintCells. */
  paintCells(value: (cell: number) => number, mark: Uint8Array): void {
    this.glass.paintCells(value, mark);
  }

  /** See FaceLayer.cellAt. */
  cellAt(x: number, y: number, matrix: Matrix4): number {
    return this.glass.cellAt(x, y, matrix);
  }

  dispose(): void {
    this.glass.dispose();
    for (const strokes of this.strokes) strokes.dispose();
  }

  private drawingOf(kept: Uint8Array, scene: Scene, { body, around }: Inside, { shown, glyphs }: Wishes): Uint8Array {
    const layer = shown.layer ? scene.layer : [];
    const buffer = shown.buffer ? scene.buffer : [];
    const tags = shown.tags ? scene.tags : [];
    const inner = layer.length + buffer.length + tags.length + around.length > 0 || glyphs;
    const glass = body === 'glass' || (body === 'auto' && inner);
    const draw = kept.map((k) => (k ? (glass ? drawing.glass : drawing.solid) : drawing.hidden));
    if (!glass) return draw;
    for (const c of [...layer, ...around]) if (kept[c]) draw[c] = drawing.solid;
    for (const c of buffer) if (kept[c]) draw[c] = drawing.tinted;
    return draw;
  }

  /** The edges among the vertices of kept cells. */
  private setEdges(mesh: ReplayMesh, kept: Uint8Array, wanted: boolean): void {
    const seen = new Uint8Array(wanted ? mesh.vertexCount : 0);
    if (wanted)
      for (let c = 0; c < mesh.cellCount; ++c)
        if (kept[c]) for (let k = 0; k < 8; ++k) seen[mesh.cells[8 * c + k]] = 1;
    this.edges.forEach((pair, kind) => {
      const all = wanted ? this.anatomy!.irregular[kind] : new Int32Array(0);
      const left = all.filter((v, i) => seen[v] && seen[all[i ^ 1]]);
      const segments = segmentsOf(mesh, left);
      for (const strokes of pair) strokes.setSegments(segments);
    });
  }
}
