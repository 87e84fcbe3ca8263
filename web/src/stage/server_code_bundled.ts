// In place of server_code.ts where the worker's file may be missing, or there is one file only: the code comes with the rest.
import type { ServerCode } from '../../../wasm/pool.ts';

export const loadServer = (): Promise<ServerCode> => import('../../../wasm/worker.ts');
