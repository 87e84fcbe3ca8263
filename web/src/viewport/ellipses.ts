// Metric ellipses: each is as wide in every direction as an edge of length 1 would be there.
import { BufferAttribute, Color, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, ShaderMaterial } from 'three';
import { ellipseFragmentShader, ellipseVertexShader } from './shaders.ts';

export class Ellipses {
  readonly object: Mesh<InstancedBufferGeometry, ShaderMaterial>;

  constructor(order: number) {
    this.object = new Mesh(
      square(),
      new ShaderMaterial({
        vertexShader: ellipseVertexShader,
        fragmentShader: ellipseFragmentShader,
        transparent: true,
        depthTest: false,
        depthWrite: false,
        side: 2,
        uniforms: { colour: { value: new Color() }, width: { value: 1 }, strength: { value: 1 } },
      }),
    );
    this.object.frustumCulled = false;
    this.object.renderOrder = order;
    this.object.visible = false;
  }

  setColour(colour: string): void {
    this.object.material.uniforms.colour.value.set(colour);
  }

  /** 1: the subject of the picture; less: behind it. */
  setStrength(strength: number): void {
    this.object.material.uniforms.strength.value = strength;
  }

  setLineWidth(pixels: number): void {
    this.object.material.uniforms.width.value = pixels;
  }

  /** Centres (2 coordinates each) and tensors (m11 m12 m22 each). */
  set(centres: Float64Array, tensors: Float64Array): void {
    const count = centres.length / 2;
    const [centre, axis1, axis2] = [0, 1, 2].map(() => new Float32Array(3 * count));
    for (let i = 0; i < count; ++i) {
      centre.set([centres[2 * i], centres[2 * i + 1]], 3 * i);
      const { sizes, direction } = principal(tensors[3 * i], tensors[3 * i + 1], tensors[3 * i + 2]);
      const [c, s] = direction;
      axis1.set([(c * sizes[0]) / 2, (s * sizes[0]) / 2], 3 * i);
      axis2.set([(-s * sizes[1]) / 2, (c * sizes[1]) / 2], 3 * i);
    }
    this.object.geometry.dispose();
    const geometry = (this.object.geometry = square());
    geometry.setAttribute('centre', new InstancedBufferAttribute(centre, 3));
    geometry.setAttribute('axis1', new InstancedBufferAttribute(axis1, 3));
    geometry.setAttribute('axis2', new InstancedBufferAttribute(axis2, 3));
    geometry.instanceCount = count;
    this.object.visible = count > 0;
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.object.material.dispose();
  }
}

/** Prescribed sizes along the eigenvectors, and the unit vector of the first. */
export function principal(
  m11: number,
  m12: number,
  m22: number,
): { sizes: [number, number]; direction: [number, number] } {
  const mean = (m11 + m22) / 2;
  const half = (m11 - m22) / 2;
  const radius = Math.hypot(half, m12);
  const angle = 0.5 * Math.atan2(m12, half);
  const smaller = (m11 * m22 - m12 * m12) / (mean + radius); // no cancellation
  return {
    sizes: [1 / Math.sqrt(mean + radius), 1 / Math.sqrt(smaller)],
    direction: [Math.cos(angle), Math.sin(angle)],
  };
}

function square(): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0]), 3));
  geometry.setIndex([0, 1, 3, 0, 3, 2]);
  return geometry;
}
