// Calls into a module with text and arrays as arguments: what the C interfaces of all modules have in common.
import { CrashError } from './errors.ts';

/** What every module exports. */
export interface Memory {
  memory: WebAssembly.Memory;
  pm_alloc(bytes: number): number;
  pm_free(memory: number): void;
}

export type Argument = string | Uint8Array | Int32Array | Float64Array;

const encoder = new TextEncoder();
const decoder = new TextDecoder();

export function readText(core: Memory, pointer: number): string {
  const bytes = new Uint8Array(core.memory.buffer);
  return decoder.decode(bytes.subarray(pointer, bytes.indexOf(0, pointer)));
}

/** A copy of bytes that the module holds. */
export function readBytes(core: Memory, pointer: number, count: number): Uint8Array<ArrayBuffer> {
  return new Uint8Array(core.memory.buffer, pointer, count).slice();
}

export function guard<T>(call: () => T): T {
  try {
    return call();
  } catch (error) {
    throw new CrashError(error);
  }
}

/** Copies the arguments into the module's memory, calls with (pointer, bytes) of each, frees. */
export function pass(
  core: Memory,
  args: Argument[],
  call: (p: number, n: number, q: number, m: number) => number,
): number {
  return guard(() => {
    const flat: number[] = [];
    for (const argument of args) {
      const data = typeof argument === 'string' ? encoder.encode(argument) : argument;
      const bytes = new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
      const pointer = core.pm_alloc(Math.max(bytes.length, 1));
      if (pointer === 0) throw new RangeError('out of memory');
      new Uint8Array(core.memory.buffer).set(bytes, pointer);
      flat.push(pointer, bytes.length);
    }
    const status = call(flat[0], flat[1], flat[2] ?? 0, flat[3] ?? 0);
    for (let i = 0; i < flat.length; i += 2) core.pm_free(flat[i]);
    return status;
  });
}
