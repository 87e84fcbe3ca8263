// The C interface to the makers of metrics: what users give (pictures, sketches, solutions, functions, walls) to the
// bytes that pm_set_nodal takes. A module of its own, so that the modules that adapt only look metrics up. Conventions
// are those of c_api.h.
#pragma once

#include "c_api.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A mesh, metrics for it, which intersect, and operations on them.
typedef struct pm_metrics pm_metrics;

PM_API(pm_metrics_create) pm_metrics* pm_metrics_create(void);
PM_API(pm_metrics_destroy) void pm_metrics_destroy(pm_metrics* metrics);
/// The sentence of the last failure, "" after a call that succeeded.
PM_API(pm_metrics_message) const char* pm_metrics_message(const pm_metrics* metrics);
/// The result of pm_metrics_build, valid until the next call.
PM_API(pm_metrics_bytes) const char* pm_metrics_bytes(const pm_metrics* metrics);
PM_API(pm_metrics_byte_count) uint32_t pm_metrics_byte_count(const pm_metrics* metrics);

/// First: the mesh that is to be adapted, from pm_input. It says the dimension, the box around it and its boundary
/// groups.
PM_API(pm_metrics_mesh) pm_status pm_metrics_mesh(pm_metrics* metrics, const char* bytes, uint32_t size);

// Metrics, as many as wanted. See docs/metrics.md and the headers that are named.
/// metric/field.h
PM_API(pm_metrics_formula) pm_status pm_metrics_formula(pm_metrics* metrics, const char* formula, uint32_t size);
/// The mesh file that the next .sol belongs to, if that is not the mesh itself; triangles and tetrahedra too.
PM_API(pm_metrics_background)
pm_status pm_metrics_background(pm_metrics* metrics, const char* name, uint32_t name_size, const char* bytes,
                                uint32_t size);
/// A metric per vertex: io/sol.h
PM_API(pm_metrics_sol)
pm_status pm_metrics_sol(pm_metrics* metrics, const char* name, uint32_t name_size, const char* bytes, uint32_t size);
/// The Hessian of a solution, a scalar per vertex: metric/hessian.h. Options of Hessians must have been set before.
PM_API(pm_metrics_hessian_sol)
pm_status pm_metrics_hessian_sol(pm_metrics* metrics, const char* name, uint32_t name_size, const char* bytes,
                                 uint32_t size);
/// The Hessian of a function.
PM_API(pm_metrics_hessian_of) pm_status pm_metrics_hessian_of(pm_metrics* metrics, const char* formula, uint32_t size);
/// A picture: `width` x (size / width) bytes of brightness, row by row from the top. metric/image.h
PM_API(pm_metrics_image)
pm_status pm_metrics_image(pm_metrics* metrics, const uint8_t* gray, uint32_t size, uint32_t width);
/// The picture of case riemann: metric/portrait.h
PM_API(pm_metrics_portrait) pm_status pm_metrics_portrait(pm_metrics* metrics);
/// Dabs of a brush, six numbers each: x, y, radius, size, angle (radians), stretch; `paper` is the size where nothing
/// is drawn, 0 for a tenth of the diagonal. metric/sketch.h
PM_API(pm_metrics_sketch)
pm_status pm_metrics_sketch(pm_metrics* metrics, const double* dabs, uint32_t bytes, double paper);
/// "wall:0.001:1.3": metric/walls.h
PM_API(pm_metrics_layer) pm_status pm_metrics_layer(pm_metrics* metrics, const char* layer, uint32_t size);
PM_API(pm_metrics_curvature) pm_status pm_metrics_curvature(pm_metrics* metrics, double per_turn);
/// The metric that a mesh from pm_input has.
PM_API(pm_metrics_implied) pm_status pm_metrics_implied(pm_metrics* metrics, const char* bytes, uint32_t size);

/// target-cells, hmin, hmax, max-anisotropy, gradation (metric/combine.h); norm, error (metric/hessian.h).
PM_API(pm_metrics_option)
pm_status pm_metrics_option(pm_metrics* metrics, const char* name, uint32_t name_size, const char* value,
                            uint32_t size);
/// bytes: the metric, for pm_set_nodal.
PM_API(pm_metrics_build) pm_status pm_metrics_build(pm_metrics* metrics);

#ifdef __cplusplus
}
#endif
