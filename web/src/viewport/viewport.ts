// The picture: a camera over the layers, drawn only when something has changed.
import { Color, MOUSE, OrthographicCamera, Scene as ThreeScene, TOUCH, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { defaultInside, type Inside } from '../inside/look_inside.ts';
import type { ReplayMesh } from '../replay/replay_mesh.ts';
import type { Scene } from '../replay/scene.ts';
import { defaultMarks, type CameraPose, type Mark } from '../state/settings.ts';
import { Ellipses } from './ellipses.ts';
import { FaceLayer, faceMarks, type Origins } from './face_layer.ts';
import { HexBody, type InsideReport } from './hex_body.ts';
import type { Palette } from './palette.ts';
import { boundaryEdges, dotsAt, facetEdges, segmentsOf } from './segments.ts';
import { Strokes } from './strokes.ts';
import { Triad } from './triad.ts';

const margin = 1.08;
/** Where a 3D mesh is looked at from at first. */
const firstDirection = new Vector3(0.55, -0.72, 0.42);

export class Viewport {
  /** Called when the visitor has moved the camera. */
  onPose: () => void = () => undefined;
  /** Called while the camera moves. */
  onMove: () => void = () => undefined;
  /** Called when the graphics context is lost (true) and restored (false). */
  onContext: (lost: boolean) => void = () => undefined;

  readonly canvas: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer;
  private readonly three = new ThreeScene();
  private readonly camera = new OrthographicCamera();
  private readonly controls: OrbitControls;
  private readonly faces = new FaceLayer();
  private readonly hexes = new HexBody();
  private readonly triad = new Triad();
  private readonly outline = new Strokes({ width: 2.2 }, 1);
  private readonly ellipses = new Ellipses(2);
  private readonly tags = new Strokes({ width: 4.2, trim: 0.16 }, 4);
  private readonly hull = new Strokes({ width: 2.6, dash: 9 }, 5);
  private readonly layerEdges = new Strokes({ width: 5.4, trim: 0.08 }, 6);
  private readonly isolines = new Strokes({ width: 1.6, opacity: 0.85 }, 3);
  /** Irregular vertices: dots where there are too few cells, rings where there are too many. */
  private readonly fewer = new Strokes({ width: 5.5 }, 7);
  private readonly more = [new Strokes({ width: 7 }, 7), new Strokes({ width: 3.4 }, 8)] as const;
  private readonly pin = new Strokes({ width: 3.4 }, 9);
  private readonly host: HTMLElement;
  private readonly observer: ResizeObserver;
  private bounds = { low: [0, 0, 0], high: [1, 1, 1] };
  private dim = 2;
  private inside: Inside = defaultInside();
  private origins: Origins | undefined;
  private moved = false;
  /** The visitor's hand is on the camera. */
  private touched = false;
  private frame = 0;
  private animation: { start: number; duration: number } | null = null;
  private shown: Record<Mark, boolean> = { ...defaultMarks };

  /** Throws when the browser gives no WebGL 2. */
  constructor(host: HTMLElement) {
    this.host = host;
    this.renderer = new WebGLRenderer({ antialias: true, powerPreference: 'low-power' });
    this.canvas = this.renderer.domElement;
    host.append(this.canvas, this.triad.element);
    for (const layer of this.layers) this.three.add(layer.object);

    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.zoomToCursor = true;
    this.controls.zoomSpeed = 1.4;
    this.controls.addEventListener('change', () => {
      this.moved ||= this.touched;
      this.requestRender();
      this.onMove();
    });
    this.controls.addEventListener('start', () => (this.touched = true));
    this.controls.addEventListener('end', () => {
      this.touched = false;
      this.poseChanged();
    });
    this.canvas.addEventListener('wheel', () => this.poseChanged(), { passive: true });
    this.canvas.addEventListener('dblclick', () => this.fit());
    this.canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.onContext(true);
    });
    this.canvas.addEventListener('webglcontextrestored', () => {
      this.onContext(false);
      this.requestRender();
    });
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(host);
  }

  private get layers() {
    return [this.faces, this.hexes, this.ellipses, ...this.strokes];
  }

  private get strokes() {
    const { outline, tags, hull, layerEdges, isolines, fewer, more, pin } = this;
    return [outline, tags, hull, layerEdges, isolines, fewer, ...more, pin];
  }

  setPalette(palette: Palette): void {
    this.three.background = new Color(palette.background);
    this.faces.setPalette(palette);
    this.hexes.setPalette(palette);
    this.outline.setColour(palette.outline);
    this.tags.setColour(palette.tag);
    this.layerEdges.setColour(palette.tag);
    this.hull.setColour(palette.hull);
    this.ellipses.setColour(palette.ellipse);
    this.isolines.setColour(palette.ellipse);
    this.pin.setColour(palette.outline);
    this.fewer.setColour(palette.irregular[0]);
    this.more[0].setColour(palette.irregular[2]);
    this.more[1].setColour(palette.cell);
    this.requestRender();
  }

  /** A new mesh: everything is drawn anew and, if wished, the camera shows all of it. */
  setMesh(mesh: ReplayMesh, fit: boolean): void {
    this.dim = mesh.dim;
    const { low, high } = mesh.bounds();
    this.bounds = { low: [...low, 0].slice(0, 3), high: [...high, 0].slice(0, 3) };
    this.origins = undefined;
    this.triad.element.toggleAttribute('hidden', mesh.dim === 2);
    if (mesh.dim === 2) {
      this.hexes.clear();
      this.faces.update(mesh, 'all');
    }
    this.outline.setSegments(mesh.dim === 2 ? segmentsOf(mesh, boundaryEdges(mesh)) : new Float32Array(0));
    this.controls.enableRotate = mesh.dim === 3;
    this.controls.mouseButtons = {
      LEFT: mesh.dim === 3 ? MOUSE.ROTATE : MOUSE.PAN,
      MIDDLE: MOUSE.DOLLY,
      RIGHT: MOUSE.PAN,
    };
    this.controls.touches = { ONE: mesh.dim === 3 ? TOUCH.ROTATE : TOUCH.PAN, TWO: TOUCH.DOLLY_PAN };
    this.camera.up.set(0, mesh.dim === 3 ? 0 : 1, mesh.dim === 3 ? 1 : 0);
    if (fit) this.fit();
    this.requestRender();
  }

  /** Shows the mesh after a change, over so many milliseconds; a hexahedral one with the scene that follows. */
  showMesh(mesh: ReplayMesh, changed: Int32Array | 'all', milliseconds: number, origins?: Origins): void {
    this.origins = origins;
    if (mesh.dim === 2) this.faces.update(mesh, changed, origins);
    this.animation = milliseconds > 0 ? { start: performance.now(), duration: milliseconds } : null;
    this.setProgress(this.animation ? 0 : 1);
    this.requestRender();
  }

  /**
   * Colours and marks of the faces, and the strokes of what stands out. In 3D: which faces there are, too. Cells that
   * are `faded` are hardly seen, in 3D not at all.
   */
  setScene(
    mesh: ReplayMesh,
    scene: Scene,
    value: (cell: number) => number,
    faded: (cell: number) => boolean,
    chords: readonly Int32Array[],
  ): InsideReport | null {
    const { inside, shown, origins } = this;
    const report =
      mesh.dim === 3 ? this.hexes.rebuild(this.faces, mesh, scene, { inside, shown, faded, origins }) : null;
    this.repaint(mesh, scene, value, faded, chords);
    const none = new Int32Array(0);
    // Through glass all tags are seen at once: they stand back when there is a layer to look at.
    const crowded = mesh.dim === 3 && scene.layer.length > 0;
    this.tags.setStrength(mesh.dim === 2 ? 1 : 0.7, crowded ? 0.35 : 1);
    this.tags.setSegments(segmentsOf(mesh, this.shown.tags ? scene.tags : none));
    this.layerEdges.setSegments(segmentsOf(mesh, this.shown.tags ? scene.layerEdges : none));
    this.hull.setSegments(segmentsOf(mesh, this.shown.hull ? facetEdges(mesh.dim, scene.hull) : none));
    this.requestRender();
    return report;
  }

  /** Colours and marks of the faces there are. */
  repaint(
    mesh: ReplayMesh,
    scene: Scene,
    value: (cell: number) => number,
    faded: (cell: number) => boolean,
    chords: readonly Int32Array[],
  ): void {
    const mark = new Uint8Array(mesh.cellCount);
    if (this.shown.layer) for (const c of scene.layer) mark[c] = faceMarks.layer;
    if (this.shown.buffer) for (const c of scene.buffer) mark[c] = faceMarks.buffer;
    chords.forEach((cells, i) => {
      for (const c of cells) mark[c] = i === 0 ? faceMarks.chord : faceMarks.otherChord;
    });
    if (mesh.dim === 2) for (let c = 0; c < mesh.cellCount; ++c) if (faded(c)) mark[c] = faceMarks.faded;
    this.faces.paintCells(value, mark);
    if (mesh.dim === 3) this.hexes.paintCells(value, mark);
    this.requestRender();
  }

  /** Takes effect with the next scene. */
  setInside(inside: Inside): void {
    this.inside = inside;
  }

  /** From the mesh to the eye. */
  get direction(): number[] {
    return this.camera.position.clone().sub(this.controls.target).normalize().toArray();
  }

  setMarks(shown: Record<Mark, boolean>): void {
    this.shown = { ...shown };
    this.ellipses.object.visible = shown.ellipses && this.ellipses.object.geometry.instanceCount > 0;
    this.requestRender();
  }

  setColours(colours: Uint8Array<ArrayBuffer> | null): void {
    this.faces.setColours(colours);
    this.hexes.setColours(colours);
    this.requestRender();
  }

  /** Ellipses are the subject before the run and stay behind the mesh during it. */
  setEllipseStrength(strength: number): void {
    this.ellipses.setStrength(strength);
    this.requestRender();
  }

  /** Centres and metric tensors of 2D ellipses. */
  setEllipses(centres: Float64Array, tensors: Float64Array): void {
    this.ellipses.set(centres, tensors);
    this.setMarks(this.shown);
  }

  setIsolines(segments: Float32Array): void {
    this.isolines.setSegments(segments);
    this.requestRender();
  }

  /** Points of irregular vertices, three coordinates each. */
  setIrregular(fewer: Float32Array, more: Float32Array): void {
    this.fewer.setSegments(dotsAt(fewer));
    for (const strokes of this.more) strokes.setSegments(dotsAt(more));
    this.requestRender();
  }

  /** Draws around one cell, e.g. the worst; six coordinates per edge. */
  setPin(segments: Float32Array): void {
    this.pin.setSegments(segments);
    this.requestRender();
  }

  /** In 2D: the place in the mesh's coordinates at a point of the window, and back. */
  placeAt(clientX: number, clientY: number): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    const at = new Vector3((2 * (clientX - box.left)) / box.width - 1, 1 - (2 * (clientY - box.top)) / box.height, 0);
    const { x, y } = at.unproject(this.camera);
    return [x, y];
  }

  screenOf(x: number, y: number): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    const at = new Vector3(x, y, 0).project(this.camera);
    return [box.left + ((at.x + 1) / 2) * box.width, box.top + ((1 - at.y) / 2) * box.height];
  }

  /** The cell that is drawn at a point of the window; -1 for none. */
  cellAt(clientX: number, clientY: number): number {
    const box = this.canvas.getBoundingClientRect();
    const x = (2 * (clientX - box.left)) / box.width - 1;
    const y = 1 - (2 * (clientY - box.top)) / box.height;
    this.camera.updateMatrixWorld();
    const matrix = this.camera.projectionMatrix.clone().multiply(this.camera.matrixWorldInverse);
    return this.faces.cellAt(x, y, matrix);
  }

  /** Moves the picture, in 3D turns it, by shares of its height; zooms by a factor. */
  nudge(right: number, up: number, zoom: number): void {
    const { target } = this.controls;
    const eye = this.camera.position.clone().sub(target);
    const height = (this.camera.top - this.camera.bottom) / this.camera.zoom;
    if (this.dim === 2) {
      target.x += right * height;
      target.y += up * height;
    } else {
      const turn = Math.atan2(eye.y, eye.x) + 2 * right;
      const tilt = Math.atan2(eye.z, Math.hypot(eye.x, eye.y)) + 2 * up;
      const flat = Math.cos(Math.min(1.55, Math.max(-1.55, tilt)));
      eye.set(flat * Math.cos(turn), flat * Math.sin(turn), Math.sin(Math.min(1.55, Math.max(-1.55, tilt))));
    }
    this.moved = true;
    this.pose({ target: target.toArray(), zoom: this.camera.zoom * zoom, direction: eye.normalize().toArray() });
    this.onPose();
  }

  /** Looks at a mesh of hexahedra along a direction, from the mesh to the eye. */
  lookFrom(direction: number[]): void {
    this.moved = true;
    this.pose({ target: this.controls.target.toArray(), zoom: this.camera.zoom, direction });
    this.onPose();
  }

  /** Shows the whole mesh. */
  fit(): void {
    this.moved = false;
    this.pose({ target: this.centre().toArray(), zoom: 1 });
    this.onPose();
  }

  /** Null when the whole mesh is shown as at first. */
  currentPose(): CameraPose | null {
    if (!this.moved) return null;
    const { target } = this.controls;
    const pose: CameraPose = { target: target.toArray().slice(0, this.dim), zoom: this.camera.zoom };
    if (this.dim === 3) pose.direction = this.camera.position.clone().sub(target).normalize().toArray();
    return pose;
  }

  setPose(pose: CameraPose): void {
    this.moved = true;
    this.pose(pose);
  }

  /** A PNG of the picture as it is, at a multiple of its size. */
  capture(scale: number): Promise<Blob> {
    const ratio = this.renderer.getPixelRatio();
    this.setPixelRatio(ratio * scale);
    this.renderer.render(this.three, this.camera);
    return new Promise((resolve, reject) => {
      this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('The picture could not be made.'))));
      this.setPixelRatio(ratio);
      this.requestRender();
    });
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.observer.disconnect();
    this.controls.dispose();
    for (const layer of this.layers) layer.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss(); // browsers allow few contexts, and collect them late
    this.canvas.remove();
    this.triad.element.remove();
  }

  private poseChanged(): void {
    this.moved = true;
    this.onPose();
  }

  private centre(): Vector3 {
    const { low, high } = this.bounds;
    return new Vector3(...low.map((x, i) => (x + high[i]) / 2));
  }

  private pose({ target, zoom, direction }: CameraPose): void {
    const { low, high } = this.bounds;
    const size = Math.hypot(...low.map((x, i) => high[i] - x)) || 1;
    this.controls.target.set(target[0] ?? 0, target[1] ?? 0, target[2] ?? 0);
    const from = this.dim === 2 ? new Vector3(0, 0, 1) : direction ? new Vector3(...direction) : firstDirection;
    this.camera.position.copy(this.controls.target).addScaledVector(from.clone().normalize(), 4 * size);
    this.camera.near = 0.01 * size;
    this.camera.far = 20 * size;
    this.camera.zoom = zoom;
    this.resize();
    this.controls.update();
  }

  /** At zoom 1 the frustum holds the mesh with a margin. */
  private resize(): void {
    const width = Math.max(1, this.host.clientWidth);
    const height = Math.max(1, this.host.clientHeight);
    const { low, high } = this.bounds;
    const extent = low.map((x, i) => high[i] - x);
    // A box is narrower than its diagonal from almost everywhere.
    const [w, h] = this.dim === 2 ? [extent[0], extent[1]] : Array<number>(2).fill(0.9 * Math.hypot(...extent));
    const half = (margin * Math.max(h, (w * height) / width)) / 2 || 1;
    this.camera.top = half;
    this.camera.bottom = -half;
    this.camera.right = (half * width) / height;
    this.camera.left = -this.camera.right;
    this.camera.updateProjectionMatrix();
    this.renderer.setSize(width, height);
    this.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.draw(performance.now()); // at once: resizing has emptied the canvas
  }

  private setPixelRatio(ratio: number): void {
    this.renderer.setPixelRatio(ratio);
    const { width, height } = this.canvas;
    for (const strokes of [...this.strokes, ...this.hexes.strokes])
      strokes.setResolution(width, height, ratio);
    this.faces.setLineWidth(1.15 * ratio);
    this.hexes.setLineWidth(1.15 * ratio);
    this.ellipses.setLineWidth(1.3 * ratio);
  }

  private setProgress(progress: number): void {
    this.faces.setProgress(progress);
    this.hexes.setProgress(progress);
  }

  private requestRender(): void {
    this.frame ||= requestAnimationFrame((now) => this.draw(now));
  }

  private draw(now: number): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    if (this.animation) {
      const { start, duration } = this.animation;
      const t = Math.min(1, Math.max(0, (now - start) / duration));
      this.setProgress(t * t * (3 - 2 * t));
      if (t === 1) this.animation = null;
      else this.requestRender();
    }
    this.renderer.render(this.three, this.camera);
    if (this.dim === 3) this.triad.turn(this.camera);
  }
}
