// What went wrong, for the visitor.
import { CrashError, LoadError } from '../../../wasm/errors.ts';
import type { Message } from '../panels/messages.ts';

/** When the core is lost or could not be had, it can be asked for again. */
export function messageOf(error: unknown, restart: () => void): Message {
  const text = error instanceof Error ? error.message : String(error);
  const lost = error instanceof LoadError || error instanceof CrashError;
  return { kind: 'error', text, ...(lost ? { action: { label: 'Start again', run: restart } } : {}) };
}
