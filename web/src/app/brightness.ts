// The brightness of a picture, for a metric.
import type { GrayImage } from '../../../wasm/metrics.ts';

/** The larger side of a picture, in pixels: more would not be seen in a mesh. */
const most = 512;

/** One byte of brightness per pixel, from the top; by the weights of Rec. 709. */
export async function brightnessOf(file: Blob): Promise<GrayImage> {
  const bitmap = await createImageBitmap(file);
  const scale = Math.min(1, most / Math.max(bitmap.width, bitmap.height));
  const [width, height] = [bitmap.width, bitmap.height].map((side) => Math.max(1, Math.round(side * scale)));
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d')!;
  context.drawImage(bitmap, 0, 0, width, height);
  const { data } = context.getImageData(0, 0, width, height);
  const gray = Uint8Array.from({ length: width * height }, (_, i) =>
    Math.round(0.2126 * data[4 * i] + 0.7152 * data[4 * i + 1] + 0.0722 * data[4 * i + 2]),
  );
  return { width, height, gray };
}
