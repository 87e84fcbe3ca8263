// Thick lines with round ends: tags, hull, outline.
import {
  BufferAttribute,
  Color,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  Mesh,
  ShaderMaterial,
  Vector2,
} from 'three';
import { strokeFragmentShader, strokeVertexShader } from './shaders.ts';

export interface StrokeStyle {
  /** In CSS pixels. */
  width: number;
  /** Share of the length left out at each end. */
  trim?: number;
  /** Length of a dash with its gap in CSS pixels; 0: continuous. */
  dash?: number;
  opacity?: number;
  /** Hidden by what is nearer than this, in normalised depth; undefined: drawn over everything. */
  lift?: number;
  /** Drawn only where one of the two facets at the segment faces the eye. */
  outline?: boolean;
}

export class Strokes {
  readonly object: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  private readonly style: StrokeStyle;
  private strength = 1;
  private ratio = 1;

  constructor(style: StrokeStyle, order: number) {
    this.style = style;
    const material = new ShaderMaterial({
      vertexShader: strokeVertexShader,
      fragmentShader: strokeFragmentShader,
      transparent: true,
      depthTest: style.lift !== undefined,
      depthWrite: false,
      uniforms: {
        width: { value: style.width },
        trim: { value: style.trim ?? 0 },
        dash: { value: style.dash ?? 0 },
        lift: { value: style.lift ?? 0 },
        outline: { value: style.outline ?? false },
        opacity: { value: style.opacity ?? 1 },
        colour: { value: new Color() },
        resolution: { value: new Vector2(1, 1) },
      },
    });
    this.object = new Mesh(unitQuad(), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = order;
    this.object.visible = false;
  }

  setColour(colour: string): void {
    this.object.material.uniforms.colour.value.set(colour);
  }

  /** Share of the width, and opacity, for strokes that stand back behind others. */
  setStrength(width: number, opacity: number): void {
    this.strength = width;
    this.object.material.uniforms.opacity.value = opacity;
    this.object.material.uniforms.width.value = this.style.width * this.ratio * width;
  }

  /** Size of the picture in device pixels, and device pixels per CSS pixel. */
  setResolution(width: number, height: number, ratio: number): void {
    const { uniforms } = this.object.material;
    uniforms.resolution.value.set(width, height);
    this.ratio = ratio;
    uniforms.width.value = this.style.width * ratio * this.strength;
    uniforms.dash.value = (this.style.dash ?? 0) * ratio;
  }

  /** Segments as 6 coordinates each; for outlines as many of the two normals. */
  setSegments(coordinates: Float32Array, normals?: Float32Array): void {
    const { object } = this;
    object.geometry.dispose();
    object.geometry = unitQuad();
    const put = (names: [string, string], pairs: Float32Array): void => {
      const buffer = new InstancedInterleavedBuffer(pairs, 6);
      names.forEach((name, i) => object.geometry.setAttribute(name, new InterleavedBufferAttribute(buffer, 3, 3 * i)));
    };
    put(['start', 'finish'], coordinates);
    if (normals) put(['facing1', 'facing2'], normals);
    object.geometry.instanceCount = coordinates.length / 6;
    object.visible = coordinates.length > 0;
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.object.material.dispose();
  }
}

/** Two triangles over [0, 1] x [-1, 1]. */
function unitQuad(): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array([0, -1, 0, 1, -1, 0, 0, 1, 0, 1, 1, 0]), 3));
  geometry.setIndex([0, 1, 3, 0, 3, 2]);
  return geometry;
}
