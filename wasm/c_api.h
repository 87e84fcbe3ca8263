// The C interface of pillowmesh: one opaque session, status codes, flat arrays. Compiled to WebAssembly it is the whole
// boundary between the core and JavaScript; compiled natively it serves any language with a C foreign-function
// interface.
//
// Text goes in as UTF-8 pointer and length, and comes out NUL-terminated. Calls that return arrays leave them in the
// session's three result buffers (ints, doubles, bytes), valid until the next call with the same session.
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__wasm__)
#define PM_API(name) __attribute__((used, visibility("default"), export_name(#name)))
#else
#define PM_API(name) __attribute__((visibility("default")))
#endif

/// 0 to 6 are StatusCode of mesh/status.h. A call that fails leaves its sentence in pm_message.
enum {
  PM_OK = 0,
  PM_LIMIT_NOT_MET = 1,
  PM_USAGE = 2,
  PM_BAD_INPUT = 3,
  PM_CANCELLED = 4,
  PM_ILLEGAL = 5,
  PM_OTHER_BUILD = 6,  ///< not a mistake, but for another module: pm_load_*: that of the other dimension, pm_begin:
                       ///< that with full adaptation
  PM_MORE = 100        ///< pm_step: the run is not over
};
typedef int32_t pm_status;

/// A mesh, a metric, options, and the run made of them.
typedef struct pm_session pm_session;

/// Memory for arguments. \return NULL for want of memory
PM_API(pm_alloc) void* pm_alloc(uint32_t bytes);
PM_API(pm_free) void pm_free(void* memory);

/// The library's version, e.g. "0.1.0".
PM_API(pm_version) const char* pm_version(void);
/// The cases as a JSON array of {name, dim, title, mesh, formula, source}. One without a formula, riemann, has its metric
/// from pm_metrics_portrait (metrics_api.h).
PM_API(pm_cases) const char* pm_cases(void);

PM_API(pm_create) pm_session* pm_create(void);
PM_API(pm_destroy) void pm_destroy(pm_session* session);
/// The sentence of the last failure, "" after a call that succeeded.
PM_API(pm_message) const char* pm_message(const pm_session* session);

// The result buffers.
PM_API(pm_ints) const int32_t* pm_ints(const pm_session* session);
PM_API(pm_int_count) uint32_t pm_int_count(const pm_session* session);
PM_API(pm_doubles) const double* pm_doubles(const pm_session* session);
PM_API(pm_double_count) uint32_t pm_double_count(const pm_session* session);
PM_API(pm_bytes) const char* pm_bytes(const pm_session* session);
PM_API(pm_byte_count) uint32_t pm_byte_count(const pm_session* session);

// What to adapt. Loading a mesh ends a run; a metric of the same dimension is kept.
/// A mesh that pm_files_read (files_api.h) gave the bytes of; `name` is the file's, for messages.
PM_API(pm_load_input)
pm_status pm_load_input(pm_session* session, const char* name, uint32_t name_size, const char* bytes, uint32_t size);
/// "grid:7,9:0,7,0,9", "ogrid:4,2:1", ...: see parse_primitive in mesh/primitives.h.
PM_API(pm_load_grid) pm_status pm_load_grid(pm_session* session, const char* spec, uint32_t size);
/// A case: its mesh, and its metric where that is a formula.
PM_API(pm_load_case) pm_status pm_load_case(pm_session* session, const char* name, uint32_t size);
/// The metric from a formula, its sizes multiplied by `scale`. A mesh must be loaded: it says the dimension. The metric
/// is checked at the mesh's vertices.
PM_API(pm_set_metric) pm_status pm_set_metric(pm_session* session, const char* formula, uint32_t size, double scale);
/// The metric from the bytes of pm_metrics_build (metrics_api.h), its sizes multiplied by `scale`. A mesh must be
/// loaded.
PM_API(pm_set_nodal) pm_status pm_set_nodal(pm_session* session, const char* bytes, uint32_t size, double scale);
/// An option by its command-line name, see adapt/options.h. Those of the boundary (corner-angle, freeze) are for meshes that are
/// loaded afterwards.
PM_API(pm_set_option)
pm_status pm_set_option(pm_session* session, const char* name, uint32_t name_size, const char* value, uint32_t size);

// The run.
/// Starts from the loaded mesh, again if need be. PM_OTHER_BUILD: the options ask for a method that is left out here.
PM_API(pm_begin) pm_status pm_begin(pm_session* session);
/// At most `steps` steps of the adapter. \return PM_MORE, or the run's outcome
PM_API(pm_step) pm_status pm_step(pm_session* session, uint32_t steps);
/// Events since the last call, one after the other.
/// ints, per event: kind, iteration, edges, cells, hull facets, vertices before, after, cells before, after, vertices
/// changed, cells changed (11 numbers), then the edges (2 each), cells, hull facets (2^(dim-1) each), changed vertices,
/// changed cells, their old corners, their new corners (2^dim each, corner-bit order).
/// doubles, per event: value, old points, new points (dim each).
PM_API(pm_take_events) pm_status pm_take_events(pm_session* session);

// What there is now: the run's mesh, before a run the loaded one.
/// 2 or 3; 0 before a mesh is loaded.
PM_API(pm_dimension) int32_t pm_dimension(const pm_session* session);
/// doubles: points; ints: cells, dead ones included (all corners -1), as events number them.
PM_API(pm_mesh) pm_status pm_mesh(pm_session* session);
/// bytes: the report (quality/report.h) as JSON text.
PM_API(pm_report) pm_status pm_report(pm_session* session);
/// bytes: the mesh, for pm_load_input and pm_files_write.
PM_API(pm_input) pm_status pm_input(pm_session* session);

// Measures of any points and cells in the session's metric, e.g. of a viewer's copy at an earlier event.
/// doubles: the metric tensor at each point, m11 m12 m22 [m13 m23 m33].
PM_API(pm_tensors) pm_status pm_tensors(pm_session* session, const double* points, uint32_t point_count);
/// doubles: the shape eta of each cell, by lengths to 1e-5 where five samples tell of all that is between them; NaN for a
/// dead one.
PM_API(pm_cell_shapes)
pm_status pm_cell_shapes(pm_session* session, const double* points, uint32_t point_count, const int32_t* cells,
                         uint32_t cell_count);
/// ints: the edges of the cells, each once, as pairs of points, sorted; doubles: their metric lengths,
/// to 1e-8.
PM_API(pm_edge_lengths)
pm_status pm_edge_lengths(pm_session* session, const double* points, uint32_t point_count, const int32_t* cells,
                          uint32_t cell_count);

#ifdef __cplusplus
}
#endif
