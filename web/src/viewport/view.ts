// From where the mesh is seen: the camera, moved by pointer, wheel, touch and keys.
import { type Matrix4, MOUSE, OrthographicCamera, TOUCH, Vector3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { CameraPose } from '../state/settings.ts';

const margin = 1.08;
/** Where a 3D mesh is looked at from at first. */
const firstDirection = new Vector3(0.55, -0.72, 0.42);

export class View {
  /** Called when the visitor has moved the camera. */
  onPose: () => void = () => undefined;
  /** Called while the camera moves. */
  onMove: () => void = () => undefined;

  readonly camera = new OrthographicCamera();
  dim = 2;
  private readonly canvas: HTMLCanvasElement;
  private readonly controls: OrbitControls;
  private readonly resize: () => void;
  private low = [0, 0, 0];
  private high = [1, 1, 1];
  private moved = false;
  /** The visitor's hand is on the camera. */
  private touched = false;

  /** `resize` is to call `setFrustum` and draw at once. */
  constructor(canvas: HTMLCanvasElement, resize: () => void) {
    this.canvas = canvas;
    this.resize = resize;
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.zoomSpeed = 1.4;
    this.controls.addEventListener('change', () => {
      this.moved ||= this.touched;
      this.onMove();
    });
    this.controls.addEventListener('start', () => (this.touched = true));
    this.controls.addEventListener('end', () => {
      this.touched = false;
      this.poseChanged();
    });
    canvas.addEventListener('wheel', () => this.poseChanged(), { passive: true });
    canvas.addEventListener('dblclick', () => this.fit());
  }

  /** What there is to see. 2D meshes are moved by the pointer, 3D meshes turned. */
  setSubject(dim: number, low: number[], high: number[]): void {
    this.dim = dim;
    this.low = [...low, 0].slice(0, 3);
    this.high = [...high, 0].slice(0, 3);
    const solid = dim === 3;
    this.controls.enableRotate = solid;
    this.controls.mouseButtons = { LEFT: solid ? MOUSE.ROTATE : MOUSE.PAN, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
    this.controls.touches = { ONE: solid ? TOUCH.ROTATE : TOUCH.PAN, TWO: TOUCH.DOLLY_PAN };
    this.camera.up.set(0, solid ? 0 : 1, solid ? 1 : 0);
  }

  /** From the mesh to the eye. */
  get direction(): number[] {
    return this.camera.position.clone().sub(this.controls.target).normalize().toArray();
  }

  /** From the mesh's coordinates to the window's, -1 to 1. */
  matrix(): Matrix4 {
    this.camera.updateMatrixWorld();
    return this.camera.projectionMatrix.clone().multiply(this.camera.matrixWorldInverse);
  }

  /** A point of the window in its coordinates from -1 to 1. */
  windowAt(clientX: number, clientY: number): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    return [(2 * (clientX - box.left)) / box.width - 1, 1 - (2 * (clientY - box.top)) / box.height];
  }

  /** In 2D: the place in the mesh's coordinates at a point of the window, and back. */
  placeAt(clientX: number, clientY: number): [number, number] {
    const { x, y } = new Vector3(...this.windowAt(clientX, clientY), 0).unproject(this.camera);
    return [x, y];
  }

  screenOf(x: number, y: number): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    const at = new Vector3(x, y, 0).project(this.camera);
    return [box.left + ((at.x + 1) / 2) * box.width, box.top + ((1 - at.y) / 2) * box.height];
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
      const steepest = 1.55; // short of a right angle, where left and right would change places
      const tilt = Math.atan2(eye.z, Math.hypot(eye.x, eye.y)) + 2 * up;
      const held = Math.min(steepest, Math.max(-steepest, tilt));
      eye.set(Math.cos(held) * Math.cos(turn), Math.cos(held) * Math.sin(turn), Math.sin(held));
    }
    this.moved = true;
    this.place({ target: target.toArray(), zoom: this.camera.zoom * zoom, direction: eye.normalize().toArray() });
    this.onPose();
  }

  /** Looks at a mesh of hexahedra along a direction, from the mesh to the eye. */
  lookFrom(direction: number[]): void {
    this.moved = true;
    this.place({ target: this.controls.target.toArray(), zoom: this.camera.zoom, direction });
    this.onPose();
  }

  /** Shows the whole mesh. */
  fit(): void {
    this.moved = false;
    this.place({ target: this.low.map((x, i) => (x + this.high[i]) / 2), zoom: 1 });
    this.onPose();
  }

  /** Null when the whole mesh is shown as at first. */
  pose(): CameraPose | null {
    if (!this.moved) return null;
    const pose: CameraPose = { target: this.controls.target.toArray().slice(0, this.dim), zoom: this.camera.zoom };
    if (this.dim === 3) pose.direction = this.direction;
    return pose;
  }

  setPose(pose: CameraPose): void {
    this.moved = true;
    this.place(pose);
  }

  /** At zoom 1 the frustum holds the mesh with a margin. */
  setFrustum(width: number, height: number): void {
    const extent = this.low.map((x, i) => this.high[i] - x);
    // A box is narrower than its diagonal from almost everywhere.
    const [w, h] = this.dim === 2 ? [extent[0], extent[1]] : Array<number>(2).fill(0.9 * Math.hypot(...extent));
    const half = (margin * Math.max(h, (w * height) / width)) / 2 || 1;
    this.camera.top = half;
    this.camera.bottom = -half;
    this.camera.right = (half * width) / height;
    this.camera.left = -this.camera.right;
    this.camera.updateProjectionMatrix();
  }

  dispose(): void {
    this.controls.dispose();
  }

  private poseChanged(): void {
    this.moved = true;
    this.onPose();
  }

  private place({ target, zoom, direction }: CameraPose): void {
    const size = Math.hypot(...this.low.map((x, i) => this.high[i] - x)) || 1;
    this.controls.target.set(target[0] ?? 0, target[1] ?? 0, target[2] ?? 0);
    const from = this.dim === 2 ? new Vector3(0, 0, 1) : direction ? new Vector3(...direction) : firstDirection;
    this.camera.position.copy(this.controls.target).addScaledVector(from.clone().normalize(), 4 * size);
    this.camera.near = 0.01 * size;
    this.camera.far = 20 * size;
    this.camera.zoom = zoom;
    this.resize();
    this.controls.update();
  }
}
