// The mesh itself: every quadrilateral with its own four corners, so that one that changes is rewritten alone. Grid
// lines are drawn inside the fragment shader from the corner coordinates: crisp at any zoom, no edge list to keep.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DataTexture,
  DynamicDrawUsage,
  LinearFilter,
  type Matrix4,
  Mesh,
  RGBAFormat,
  ShaderMaterial,
  SRGBColorSpace,
} from 'three';
import type { Facets } from '../inside/facets.ts';
import type { Relief } from '../inside/relief.ts';
import type { ReplayMesh } from '../replay/replay_mesh.ts';
import type { Palette } from './palette.ts';
import { faceFragmentShader, faceVertexShader } from './shaders.ts';

/** How a face is marked; the numbers are known to the shader. */
export const faceMarks = { none: 0, layer: 1, buffer: 2, cut: 3, faded: 4, chord: 5, otherChord: 6 } as const;

/** Where a vertex was before the change that is being shown; undefined: where it is. */
export type Origins = (vertex: number) => ArrayLike<number> | undefined;

const cornersPerFace = 4;

export class FaceLayer {
  readonly object: Mesh<BufferGeometry, ShaderMaterial>;
  /** Number of faces drawn. */
  count = 0;
  /** The cell of each face; null: face i is cell i. */
  private faceCells: Int32Array | null = null;
  /** 1 for faces behind which the mesh goes on. */
  private inner: Uint8Array | null = null;
  private capacity = 0;
  /** 1 for faces that are drawn; the others have all corners at the origin. */
  private drawn = new Uint8Array(0);
  private from!: BufferAttribute;
  private to!: BufferAttribute;
  /** Per corner: value to be coloured (-1: none), mark. */
  private paint!: BufferAttribute;
  /** In 3D: the normal of each face, the same at its corners, so that a warped one does not show two triangles; how hollow
   *  the surface is at the corner. */
  private facing!: BufferAttribute;
  private moving: Int32Array | 'all' = new Int32Array(0);
  private readonly texture = new DataTexture(new Uint8Array(256 * 4), 256, 1, RGBAFormat);

  /** `glass`: cells are transparent and hide nothing. */
  constructor(glass = false) {
    this.texture.minFilter = this.texture.magFilter = LinearFilter;
    this.texture.colorSpace = SRGBColorSpace;
    const material = new ShaderMaterial({
      vertexShader: faceVertexShader,
      fragmentShader: faceFragmentShader,
      side: 2,
      transparent: glass,
      depthWrite: !glass,
      uniforms: {
        glass: { value: glass ? 1 : 0 },
        progress: { value: 1 },
        colours: { value: this.texture },
        coloured: { value: 0 },
        lineWidth: { value: 1 },
        lit: { value: 0 },
        cellColour: { value: new Color() },
        lineColour: { value: new Color() },
        layerColour: { value: new Color() },
        bufferColour: { value: new Color() },
        cutColour: { value: new Color() },
        background: { value: new Color() },
        chordColour: { value: new Color() },
        otherChordColour: { value: new Color() },
      },
    });
    this.object = new Mesh(new BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.allocate(256);
  }

  setPalette(palette: Palette): void {
    const { uniforms } = this.object.material;
    uniforms.cellColour.value.set(palette.cell);
    uniforms.lineColour.value.set(palette.line);
    uniforms.layerColour.value.set(palette.layer);
    uniforms.bufferColour.value.set(palette.buffer);
    uniforms.cutColour.value.set(palette.cut);
    uniforms.background.value.set(palette.background);
    uniforms.chordColour.value.set(palette.chord);
    uniforms.otherChordColour.value.set(palette.otherChord);
  }

  /** `colours`: 256 RGBA colours, or null for plain cells. */
  setColours(colours: Uint8Array<ArrayBuffer> | null): void {
    const { uniforms } = this.object.material;
    uniforms.coloured.value = colours ? 1 : 0;
    if (!colours) return;
    this.texture.image.data?.set(colours);
    this.texture.needsUpdate = true;
  }

  setLineWidth(pixels: number): void {
    this.object.material.uniforms.lineWidth.value = pixels;
  }

  /** 0: cells as they were before the last change, 1: as they are. */
  setProgress(progress: number): void {
    this.object.material.uniforms.progress.value = progress;
  }

  /**
   * In 2D: takes over what changed in the mesh, or everything. In between, faces go from where they were to where they
   * are.
   */
  update(mesh: ReplayMesh, changed: Int32Array | 'all', origins?: Origins): void {
    this.settle();
    const before = this.count;
    this.count = mesh.cellCount;
    this.faceCells = this.inner = null;
    this.object.material.uniforms.lit.value = 0;
    if (this.count > this.capacity) {
      this.allocate(Math.ceil(1.5 * this.count));
      changed = 'all';
    }
    const n = changed === 'all' ? this.count : changed.length;
    for (let i = 0; i < n; ++i) {
      const face = changed === 'all' ? i : changed[i];
      const known = face < before && this.drawn[face] === 1;
      this.writeFace(mesh, face, mesh.cells, 4 * face, known, origins);
    }
    this.upload([this.from, this.to], changed, 12);
    this.moving = changed;
    this.object.geometry.setDrawRange(0, 6 * this.count);
  }

  /** In 3D: these faces instead of what was there; they come from where their vertices were. */
  replace(mesh: ReplayMesh, facets: Facets, relief: Relief, origins?: Origins): void {
    this.faceCells = facets.cells;
    this.inner = facets.inner;
    this.count = facets.cells.length;
    this.moving = new Int32Array(0);
    this.object.material.uniforms.lit.value = 1;
    if (this.count > this.capacity) this.allocate(Math.ceil(1.5 * this.count));
    for (let face = 0; face < this.count; ++face) {
      this.writeFace(mesh, face, facets.vertices, 4 * face, false, origins);
      this.writeFacing(face, relief);
    }
    this.upload([this.from, this.to], 'all', 12);
    this.upload([this.facing], 'all', 16);
    this.object.geometry.setDrawRange(0, 6 * this.count);
  }

  /** Colour value per cell: 0 to 1, anything else for none. `mark` says how each cell is marked. */
  paintCells(value: (cell: number) => number, mark: Uint8Array): void {
    const array = this.paint.array;
    for (let face = 0; face < this.count; ++face) {
      const cell = this.faceCells ? this.faceCells[face] : face;
      const v = value(cell);
      const m = mark[cell] || (this.inner?.[face] ? faceMarks.cut : faceMarks.none);
      for (let k = 0, at = 8 * face; k < cornersPerFace; ++k) {
        array[at++] = v >= 0 ? Math.min(v, 1) : -1;
        array[at++] = m;
      }
    }
    this.upload([this.paint], 'all', 8);
  }

  /** The cell drawn at a point in normalised device coordinates, or -1. `matrix`: projection times view. */
  cellAt(x: number, y: number, matrix: Matrix4): number {
    const to = this.to.array;
    const e = matrix.elements;
    const corner = new Float64Array(12);
    let nearest = Infinity;
    let found = -1;
    for (let face = 0; face < this.count; ++face) {
      if (!this.drawn[face]) continue;
      for (let k = 0; k < 4; ++k) {
        const at = 12 * face + 3 * k;
        for (let d = 0; d < 3; ++d)
          corner[3 * k + d] = e[d] * to[at] + e[4 + d] * to[at + 1] + e[8 + d] * to[at + 2] + e[12 + d];
      }
      const depth = (corner[2] + corner[5] + corner[8] + corner[11]) / 4;
      if (depth < nearest && (holds(corner, 0, 1, 3, x, y) || holds(corner, 0, 3, 2, x, y))) {
        nearest = depth;
        found = this.faceCells ? this.faceCells[face] : face;
      }
    }
    return found;
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.object.material.dispose();
    this.texture.dispose();
  }

  private writeFace(
    mesh: ReplayMesh,
    face: number,
    vertices: Int32Array,
    first: number,
    known: boolean,
    origins?: Origins,
  ): void {
    const { dim, points } = mesh;
    const from = this.from.array;
    const to = this.to.array;
    const alive = vertices[first] >= 0;
    this.drawn[face] = alive ? 1 : 0;
    known &&= alive; // a dead face vanishes at once
    for (let k = 0; k < cornersPerFace; ++k) {
      const v = vertices[first + k];
      const at = 12 * face + 3 * k;
      const origin = known ? undefined : origins?.(v);
      for (let d = 0; d < 3; ++d) {
        const now = v >= 0 && d < dim ? points[v * dim + d] : 0;
        from[at + d] = known ? to[at + d] : origin && d < dim ? origin[d] : now;
        to[at + d] = now;
      }
    }
  }

  private writeFacing(face: number, { normals, hollow }: Relief): void {
    const out = this.facing.array;
    for (let k = 0, at = 16 * face; k < cornersPerFace; ++k) {
      for (let i = 0; i < 3; ++i) out[at++] = normals[3 * face + i];
      out[at++] = hollow[4 * face + k];
    }
  }

  /** Ends the last change: every face is where it is. */
  private settle(): void {
    const { moving } = this;
    if (moving === 'all') {
      this.from.array.set(this.to.array);
    } else {
      for (const face of moving) for (let i = 12 * face; i < 12 * face + 12; ++i) this.from.array[i] = this.to.array[i];
    }
    if (moving === 'all' || moving.length > 0) this.upload([this.from], moving, 12);
    this.moving = new Int32Array(0);
  }

  /** Marks attributes for upload: few faces piecewise, many as a whole. three.js joins neighbouring ranges. */
  private upload(attributes: BufferAttribute[], faces: Int32Array | 'all', size: number): void {
    for (const attribute of attributes) {
      if (faces !== 'all' && faces.length < 512) for (const face of faces) attribute.addUpdateRange(size * face, size);
      else attribute.addUpdateRange(0, size * this.count);
      attribute.needsUpdate = true;
    }
  }

  private allocate(capacity: number): void {
    const before = this.capacity > 0 ? [this.from, this.to, this.paint, this.facing] : [];
    const attributes = [12, 12, 8, 16].map((size, i) => {
      const array = new Float32Array(size * capacity);
      if (before[i]) array.set(before[i].array as Float32Array);
      return new BufferAttribute(array, size / cornersPerFace).setUsage(DynamicDrawUsage);
    });
    [this.from, this.to, this.paint, this.facing] = attributes;
    this.capacity = capacity;
    const drawn = new Uint8Array(capacity);
    drawn.set(this.drawn);
    this.drawn = drawn;

    const index = new Uint32Array(6 * capacity);
    const triangles = [0, 1, 3, 0, 3, 2];
    for (let i = 0; i < index.length; ++i) index[i] = 4 * Math.floor(i / 6) + triangles[i % 6];
    this.object.geometry.dispose();
    const geometry = new BufferGeometry();
    geometry.setIndex(new BufferAttribute(index, 1));
    geometry.setAttribute('from', this.from);
    geometry.setAttribute('to', this.to);
    geometry.setAttribute('paint', this.paint);
    geometry.setAttribute('facing', this.facing);
    this.object.geometry = geometry;
  }
}

/** Whether the triangle of three corners holds a point, from either side. */
function holds(corner: Float64Array, a: number, b: number, c: number, x: number, y: number): boolean {
  const side = (p: number, q: number): number =>
    (corner[3 * q] - corner[3 * p]) * (y - corner[3 * p + 1]) - (corner[3 * q + 1] - corner[3 * p + 1]) * (x - corner[3 * p]);
  const [u, v, w] = [side(a, b), side(b, c), side(c, a)];
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}
