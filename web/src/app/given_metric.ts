// A picture, or a Medit .sol, as the metric of the open mesh.
import type { MetricRequest } from '../../../wasm/metrics.ts';
import type { Messages } from '../panels/messages.ts';
import type { Stage } from '../stage/stage.ts';

const isSolution = (file: File): boolean => /\.sol$/i.test(file.name);

/** Whether a file is a metric rather than a mesh. */
export const isMetric = (file: File): boolean => file.type.startsWith('image/') || isSolution(file);

/** About so many cells a picture asks for: cells are fine where brightness changes. */
const cells = '2000';

/** Rejects with a sentence when the file cannot be used. */
export async function takeAsMetric(stage: Stage, file: File, messages: Messages): Promise<void> {
  await stage.setMadeMetric(await requestOf(file));
  messages.show({ kind: 'note', text: `The metric is made from ${file.name} now. A link does not hold it.` });
}

async function requestOf(file: File): Promise<MetricRequest> {
  if (isSolution(file)) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    return { sol: { name: file.name, bytes } };
  }
  const { brightnessOf } = await import('./brightness.ts');
  return { image: await brightnessOf(file), operations: { 'target-cells': cells } };
}
