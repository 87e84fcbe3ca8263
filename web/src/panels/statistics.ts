// Population statistics of an indicator, as quality/statistics.h.
import type { Row } from '../data/published.ts';

export interface Statistics {
  row: Row;
  /** Share of values in [1/sqrt 2, sqrt 2]. */
  inRange: number;
}

/** NaN values are left out. Null for want of values. */
export function statistics(values: Float64Array): Statistics | null {
  let [count, sum, low, high, inside] = [0, 0, Infinity, -Infinity, 0];
  for (const v of values) {
    if (Number.isNaN(v)) continue;
    ++count;
    sum += v;
    low = Math.min(low, v);
    high = Math.max(high, v);
    if (v >= Math.SQRT1_2 && v <= Math.SQRT2) ++inside;
  }
  if (count === 0) return null;
  const mean = sum / count;
  let squares = 0;
  for (const v of values) if (!Number.isNaN(v)) squares += (v - mean) ** 2;
  return { row: [count, low, mean, high, Math.sqrt(squares / count) / mean], inRange: inside / count };
}
