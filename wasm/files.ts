// Mesh files to and from the bytes in which a mesh crosses between modules.
import { CoreError, statusNames } from './errors.ts';
import type { FilesModule } from './loader.ts';
import { guard, pass, readBytes, readText } from './memory.ts';

/** A mesh as a file tells it, for Session.load. */
export interface Input {
  dim: 2 | 3;
  bytes: Uint8Array<ArrayBuffer>;
}

/** Reads a file; the ending of `name` chooses the format. */
export function readFile(files: FilesModule, name: string, bytes: Uint8Array): Input {
  return converted(files, (core, handle) => {
    const status = pass(core, [name, bytes], (p, n, q, m) => core.pm_files_read(handle, p, n, q, m));
    return { status, dim: core.pm_files_dimension(handle) === 3 ? 3 : 2 };
  });
}

/** The file of what Session.input gave; the ending of `name` chooses the format. */
export function writeFile(files: FilesModule, name: string, input: Uint8Array): Uint8Array<ArrayBuffer> {
  return converted(files, (core, handle) => ({
    status: pass(core, [name, input], (p, n, q, m) => core.pm_files_write(handle, p, n, q, m)),
    dim: 2,
  })).bytes;
}

function converted(
  { exports }: FilesModule,
  convert: (core: FilesModule['exports'], handle: number) => { status: number; dim: 2 | 3 },
): Input {
  const handle = guard(() => exports.pm_files_create());
  const { status, dim } = convert(exports, handle);
  const message = readText(exports, exports.pm_files_message(handle));
  const bytes = readBytes(exports, exports.pm_files_bytes(handle), exports.pm_files_byte_count(handle));
  exports.pm_files_destroy(handle);
  if (status !== 0) throw new CoreError(statusNames[status] ?? 'illegal', message);
  return { dim, bytes };
}
