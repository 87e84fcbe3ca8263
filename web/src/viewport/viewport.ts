// The picture: layers seen by a camera, drawn only when something has changed.
import { Color, Scene as ThreeScene, WebGLRenderer } from 'three';
import { defaultInside, looksInside, type Inside } from '../inside/look_inside.ts';
import type { ReplayMesh } from '../replay/replay_mesh.ts';
import { emptyScene, type Scene } from '../replay/scene.ts';
import { defaultMarks, type Mark } from '../state/settings.ts';
import { Ellipses } from './ellipses.ts';
import { Ellipsoids } from './ellipsoids.ts';
import { FaceLayer, faceMarks, type Origins } from './face_layer.ts';
import { HexBody, type InsideReport } from './hex_body.ts';
import type { Palette } from './palette.ts';
import { boundaryEdges, dotsAt, facetEdges, segmentsOf } from './segments.ts';
import { Strokes } from './strokes.ts';
import { Triad } from './triad.ts';
import { View } from './view.ts';

const nothing = [new Float64Array(0), new Float64Array(0)] as const;

export class Viewport {
  /** Called while the camera moves. */
  onMove: () => void = () => undefined;
  /** Called when the graphics context is lost (true) and restored (false). */
  onContext: (lost: boolean) => void = () => undefined;

  readonly canvas: HTMLCanvasElement;
  readonly view: View;
  private readonly renderer: WebGLRenderer;
  private readonly three = new ThreeScene();
  private readonly faces = new FaceLayer();
  private readonly hexes = new HexBody();
  private readonly triad = new Triad();
  private readonly outline = new Strokes({ width: 2.2 }, 1);
  private readonly ellipses = new Ellipses(2);
  private readonly ellipsoids = new Ellipsoids();
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
  private inside: Inside = defaultInside();
  private origins: Origins | undefined;
  private frame = 0;
  private size = '';
  /** Nothing is drawn before the shaders are there. */
  private ready = false;
  private animation: { start: number; duration: number } | null = null;
  private shown: Record<Mark, boolean> = { ...defaultMarks };

  /** Throws when the browser gives no WebGL 2. */
  constructor(host: HTMLElement) {
    this.host = host;
    this.renderer = new WebGLRenderer({ antialias: true, powerPreference: 'low-power' });
    this.renderer.debug.checkShaderErrors = false; // each look would wait for the driver
    this.canvas = this.renderer.domElement;
    host.append(this.canvas, this.triad.element);
    for (const layer of this.layers) this.three.add(layer.object);

    this.view = new View(this.canvas, () => this.resize());
    this.view.onMove = () => {
      this.requestRender();
      this.onMove();
    };
    this.canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.onContext(true);
    });
    this.canvas.addEventListener('webglcontextrestored', () => {
      this.onContext(false);
      this.requestRender();
    });
    void this.compile();
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(host);
  }

  private get layers() {
    return [this.faces, this.hexes, this.ellipses, this.ellipsoids, ...this.strokes];
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
    this.ellipsoids.setColour(palette.ellipse);
    this.isolines.setColour(palette.ellipse);
    this.pin.setColour(palette.outline);
    this.fewer.setColour(palette.irregular[0]);
    this.more[0].setColour(palette.irregular[2]);
    this.more[1].setColour(palette.cell);
    this.requestRender();
  }

  /** A new mesh: everything is drawn anew and, if wished, the camera shows all of it. */
  setMesh(mesh: ReplayMesh, fit: boolean): void {
    const { low, high } = mesh.bounds();
    this.view.setSubject(mesh.dim, low, high);
    this.origins = undefined;
    this.triad.element.toggleAttribute('hidden', mesh.dim === 2);
    if (mesh.dim === 2) {
      this.hexes.clear();
      this.faces.update(mesh, 'all');
    }
    this.outline.setSegments(mesh.dim === 2 ? segmentsOf(mesh, boundaryEdges(mesh)) : new Float32Array(0));
    if (fit) this.view.fit();
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
    // Ellipsoids are the subject before the run; in it, and where one looks inside, they are seen in glass alone.
    const subject = scene === emptyScene && !looksInside(inside);
    const glyphs = shown.ellipses && this.ellipsoids.count > 0 && (subject || inside.body === 'glass');
    const report =
      mesh.dim === 3 ? this.hexes.rebuild(this.faces, mesh, scene, { inside, shown, faded, origins, glyphs }) : null;
    this.ellipsoids.object.visible = mesh.dim === 3 && glyphs;
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

  /** Centres and metric tensors; ellipsoids are drawn with the next scene. */
  setEllipses(centres: Float64Array, tensors: Float64Array): void {
    const solid = this.view.dim === 3;
    this.ellipses.set(...(solid ? nothing : ([centres, tensors] as const)));
    this.ellipsoids.set(...(solid ? ([centres, tensors] as const) : nothing));
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

  /** The cell that is drawn at a point of the window, a solid one rather than one of glass; -1 for none. */
  cellAt(clientX: number, clientY: number): number {
    const place = [...this.view.windowAt(clientX, clientY), this.view.matrix()] as const;
    const solid = this.faces.cellAt(...place);
    return solid < 0 && this.view.dim === 3 ? this.hexes.cellAt(...place) : solid;
  }

  /** A PNG of the picture as it is, at a multiple of its size. */
  capture(scale: number): Promise<Blob> {
    const ratio = this.renderer.getPixelRatio();
    this.setPixelRatio(ratio * scale);
    this.renderer.render(this.three, this.view.camera);
    return new Promise((resolve, reject) => {
      this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('The picture could not be made.'))));
      this.setPixelRatio(ratio);
      this.requestRender();
    });
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.observer.disconnect();
    this.view.dispose();
    for (const layer of this.layers) layer.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss(); // browsers allow few contexts, and collect them late
    this.canvas.remove();
    this.triad.element.remove();
  }

  /** Has the shaders made, and waits for that without standing in the way of the page: to draw with them would. */
  private async compile(): Promise<void> {
    this.renderer.compile(this.three, this.view.camera);
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    const programs = this.renderer.info.programs ?? [];
    for (const { program } of programs) gl.useProgram(program as WebGLProgram); // links it
    this.renderer.resetState();
    const made = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    while (made && gl.clientWaitSync(made, 0, 0) === gl.TIMEOUT_EXPIRED)
      await new Promise((resolve) => setTimeout(resolve, 8));
    gl.deleteSync(made);
    for (const program of programs) program.getUniforms(); // asks the driver: at once, not behind the first picture
    this.ready = true;
    this.requestRender();
  }

  /** The frustum anew; the canvas, which costs, only when its size has changed. */
  private resize(): void {
    const width = Math.max(1, this.host.clientWidth);
    const height = Math.max(1, this.host.clientHeight);
    const ratio = Math.min(devicePixelRatio, 2);
    const size = `${width} ${height} ${ratio}`;
    this.view.setFrustum(width, height);
    if (size === this.size) return this.requestRender();
    this.size = size;
    this.renderer.setSize(width, height);
    this.setPixelRatio(ratio);
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
    if (!this.ready) return;
    if (this.animation) {
      const { start, duration } = this.animation;
      const t = Math.min(1, Math.max(0, (now - start) / duration));
      this.setProgress(t * t * (3 - 2 * t));
      if (t === 1) this.animation = null;
      else this.requestRender();
    }
    this.renderer.render(this.three, this.view.camera);
    if (this.view.dim === 3) this.triad.turn(this.view.camera);
  }
}
