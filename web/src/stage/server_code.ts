// The worker's code for a session in the page itself (a sandboxed frame): the very file that workers are made of.
import type { ServerCode } from '../../../wasm/pool.ts';

export const loadServer = (address: string): Promise<ServerCode> =>
  import(/* @vite-ignore */ address) as Promise<ServerCode>;
