// A picture, or a Medit .sol, as the metric of the open mesh.
import type { Stage } from '../stage/stage.ts';

const isSolution = (file: File): boolean => /\.sol$/i.test(file.name);

/** Whether a file is a metric rather than a mesh. */
export const isMetric = (file: File): boolean => file.type.startsWith('image/') || isSolution(file);

/** About so many cells a picture asks for: cells are fine where brightness changes. */
const cells = '2000';

/** Rejects with a sentence when the file cannot be used. */
export async function takeAsMetric(stage: Stage, file: File): Promise<void> {
  if (isSolution(file)) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    return stage.setMadeMetric({ sol: { name: file.name, bytes } });
  }
  const { brightnessOf } = await import('./brightness.ts');
  return stage.setMadeMetric({ image: await brightnessOf(file), operations: { 'target-cells': cells } });
}
