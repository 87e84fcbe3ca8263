// The three axes in a corner of the picture, as the camera sees them.
import { Vector3, type Camera } from 'three';
import { svg } from '../ui/dom.ts';

const length = 24;
const axes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];

export class Triad {
  readonly element = svg('svg', { viewBox: '-36 -36 72 72', class: 'triad', 'aria-hidden': 'true' });
  private readonly lines = axes.map(() => svg('line'));
  private readonly names = ['x', 'y', 'z'].map((name) => svg('text', {}, name));

  constructor() {
    this.element.append(...this.lines, ...this.names);
  }

  turn(camera: Camera): void {
    if (!camera.matrixWorldInverse.elements.every(Number.isFinite)) return; // an empty mesh has no middle to look at
    axes.forEach((axis, i) => {
      const seen = axis.clone().transformDirection(camera.matrixWorldInverse);
      this.lines[i].setAttribute('x2', String(length * seen.x));
      this.lines[i].setAttribute('y2', String(-length * seen.y));
      this.lines[i].style.opacity = this.names[i].style.opacity = seen.z < -0.2 ? '0.55' : '1';
      this.names[i].setAttribute('x', String((length + 8) * seen.x));
      this.names[i].setAttribute('y', String(-(length + 8) * seen.y));
    });
  }
}
