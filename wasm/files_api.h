// The C interface to file formats: files to the bytes that pm_load_input takes, and what pm_input gives to files. A
// module of its own, so that only those who open or save files download it. Conventions are those of c_api.h.
#pragma once

#include "c_api.h"

#ifdef __cplusplus
extern "C" {
#endif

/// One conversion at a time, with its result.
typedef struct pm_files pm_files;

PM_API(pm_files_create) pm_files* pm_files_create(void);
PM_API(pm_files_destroy) void pm_files_destroy(pm_files* files);
/// The sentence of the last failure, "" after a call that succeeded.
PM_API(pm_files_message) const char* pm_files_message(const pm_files* files);
/// The last result, valid until the next call.
PM_API(pm_files_bytes) const char* pm_files_bytes(const pm_files* files);
PM_API(pm_files_byte_count) uint32_t pm_files_byte_count(const pm_files* files);
/// 2 or 3: of the mesh read last.
PM_API(pm_files_dimension) int32_t pm_files_dimension(const pm_files* files);

/// A mesh file in memory; the ending of `name` chooses the format.
PM_API(pm_files_read)
pm_status pm_files_read(pm_files* files, const char* name, uint32_t name_size, const char* bytes, uint32_t size);
/// What pm_input gave as a file; the ending of `name` chooses the format.
PM_API(pm_files_write)
pm_status pm_files_write(pm_files* files, const char* name, uint32_t name_size, const char* bytes, uint32_t size);

#ifdef __cplusplus
}
#endif
