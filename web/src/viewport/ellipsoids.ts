// Metric ellipsoids: each is as wide in every direction as an edge of length 1 would be there.
import { Color, IcosahedronGeometry, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, ShaderMaterial } from 'three';
import { ellipsoidFragmentShader, ellipsoidVertexShader } from './shaders.ts';

export class Ellipsoids {
  readonly object: Mesh<InstancedBufferGeometry, ShaderMaterial>;

  constructor() {
    const uniforms = { colour: { value: new Color() } };
    const shaders = { vertexShader: ellipsoidVertexShader, fragmentShader: ellipsoidFragmentShader };
    this.object = new Mesh(new InstancedBufferGeometry(), new ShaderMaterial({ ...shaders, uniforms }));
    this.object.frustumCulled = false;
    this.object.visible = false;
  }

  get count(): number {
    const { instanceCount } = this.object.geometry;
    return Number.isFinite(instanceCount) ? instanceCount : 0;
  }

  setColour(colour: string): void {
    this.object.material.uniforms.colour.value.set(colour);
  }

  /** Centres (3 coordinates each) and tensors (m11 m12 m22 m13 m23 m33 each). */
  set(centres: Float64Array, tensors: Float64Array): void {
    const count = centres.length / 3;
    const axes = [0, 1, 2].map(() => new Float32Array(3 * count));
    for (let i = 0; i < count; ++i) factor(tensors.subarray(6 * i, 6 * i + 6)).forEach((axis, d) => axes[d].set(axis, 3 * i));
    this.object.geometry.dispose();
    const ball = new IcosahedronGeometry(1, 2);
    const geometry = (this.object.geometry = new InstancedBufferGeometry());
    geometry.setAttribute('position', ball.getAttribute('position'));
    geometry.setAttribute('centre', new InstancedBufferAttribute(Float32Array.from(centres), 3));
    axes.forEach((axis, d) => geometry.setAttribute(`axis${d + 1}`, new InstancedBufferAttribute(axis, 3)));
    geometry.instanceCount = count;
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.object.material.dispose();
  }
}

/**
 * Columns of a matrix that takes the unit ball to the ellipsoid of diameter 1 in the metric M: half the inverse of the
 * transpose of L, with M = L L' by Cholesky. No eigenvectors are needed.
 */
export function factor([m11, m12, m22, m13, m23, m33]: ArrayLike<number> & Iterable<number>): number[][] {
  const a = Math.sqrt(m11);
  const [b, d] = [m12 / a, m13 / a];
  const c = Math.sqrt(m22 - b * b);
  const e = (m23 - b * d) / c;
  const f = Math.sqrt(m33 - d * d - e * e);
  return [
    [0.5 / a, 0, 0],
    [(-0.5 * b) / (a * c), 0.5 / c, 0],
    [(0.5 * (b * e - c * d)) / (a * c * f), (-0.5 * e) / (c * f), 0.5 / f],
  ];
}
