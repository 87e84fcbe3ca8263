// The named cases: an initial mesh and a metric, both as text that a user could have typed.
#pragma once

#include <span>
#include <string_view>

namespace pillowmesh {

struct Case {
  std::string_view name;
  int dim;
  std::string_view title;    ///< one line for lists
  std::string_view mesh;     ///< grid:..., quarter:... (mesh/primitives.h)
  std::string_view formula;  ///< metric formula (metric/expression.h)
  std::string_view source;   ///< where it comes from, e.g. "[Paper] Eqs. (2), (3)"
};

/// All cases, in the order of the documentation.
std::span<const Case> gallery();
/// riemann: a metric from an image, metric/portrait.h, and so without a formula; not among gallery(). [Paper] Figure 11
const Case& portrait_case();
/// The case of that name in the gallery, or nullptr.
const Case* find_case(std::string_view name);

}  // namespace pillowmesh
