// What a run is asked to do. One struct for command, library and page; each field says unit, default and meaning.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/status.h"

namespace pillowmesh {

/// When the paper's method relocates vertices.
enum class Smoothing : std::uint8_t {
  none,
  end,      ///< once, after the last refinement (the paper's Figure 7 c); as `between` where hexahedra approach in steps
  between,  ///< after every refinement iteration as well (Figure 7 i)
};

/// Which method adapts.
enum class Method : std::uint8_t {
  automatic,  ///< full, unless an option of the paper's method says otherwise: smoothing, dice, ...
  full,   ///< refine, coarsen, reconnect and relocate (quads; hexahedra are refined as by `paper`)
  paper,  ///< refine and smooth, as the paper does
};

/// How long full adaptation searches.
enum class Effort : std::uint8_t { fast, normal, best };

/// What the boundary is between the vertices that the input has there.
enum class BoundaryShape : std::uint8_t {
  linear,  ///< the straight edges and bilinear facets of the input
  smooth,  ///< curves and surfaces through its vertices (mesh/smooth_geometry.h)
};

struct AdaptOptions {
  Method method = Method::automatic;
  /// Full adaptation: fast is for pages that follow a moving metric, best for meshes that are kept.
  Effort effort = Effort::normal;
  /// Full adaptation: how much edges are drawn toward the eigenvectors of the metric where it is anisotropic, 0 to 1.
  double align = 1.0;
  /// Full adaptation: of its random numbers. The same seed gives the same mesh everywhere.
  std::uint64_t seed = 1;
  /// How the boundary of a mesh is divided when it is read: before the run (read_mesh_file, make_mesh).
  BoundaryOptions boundary;
  /// Where new boundary vertices lie.
  BoundaryShape geometry = BoundaryShape::linear;
  /// Metric length above which an edge is tagged. [Paper] section 4 step 1: about 2. In 3D, with
  /// continuation left to choose, sqrt 2 where lengths hide how fast sizes grow (docs/algorithm.md).
  double threshold = 2.0;
  Smoothing smoothing = Smoothing::end;
  /// n > 1: refine to edges n times as long, then split every cell in n^Dim ("coarse refinement and dicing").
  int dice = 1;
  /// Paper's method: the metric is approached in so many steps, from sizes that do not fall below the mean edge of the
  /// input, a floor that is halved from step to step (adapt/continuation.h). 0: at once; -1: at once unless, in 3D, sizes
  /// change fast.
  int continuation = -1;
  /// Cells across a layer at its seed: 1 as in the paper, 2 as Schneiders.
  int thickness = 1;
  /// Rings of cells added at the ends of each layer ("layers are augmented by their immediate neighbours"). -1: one in
  /// 2D, none in 3D, where a ring costs many cells.
  int augment = -1;
  /// Iterations of the paper's loop (steps 1 to 4) at the most.
  int max_iterations = 30;
  /// The run stops with a valid mesh before it would pass this many cells.
  std::int64_t max_cells = 10'000'000;
  /// Sweeps of the smoother at the most, each time that it runs.
  int max_sweeps = 200;
  /// Keep events for replay (adapt/trace.h). Costs memory proportional to what changes.
  bool record = false;
};

/// False in the WebAssembly module that is for the paper's method alone (cmake/Wasm.cmake).
inline constexpr bool kHasFullAdaptation =
#ifdef PILLOWMESH_PAPER_ONLY
    false;
#else
    true;
#endif

/// Whether quads are adapted in full with these options.
inline bool full_adaptation(const AdaptOptions& o) {
  if (o.method != Method::automatic) return o.method == Method::full;
  return o.smoothing == Smoothing::end && o.dice == 1 && o.thickness == 1 && o.continuation <= 0;
}

/// Sets an option by its command-line name without dashes ("threshold", "smooth", "dice", ...).
/// \return usage with the allowed values when name or value is wrong. The one place where names and values are parsed:
/// command, page and permalinks all come here.
Status set_option(AdaptOptions& options, std::string_view name, std::string_view value);

/// Polled between operators.
struct Context {
  /// true: stop at the next safe place.
  std::function<bool()> cancelled;
  /// Share of the work believed done, 0 to 1, and what is being done.
  std::function<void(double share, std::string_view activity)> progress;
};

}  // namespace pillowmesh
