#include "pillowmesh/adapt/options.h"

#include <string>

#include "pillowmesh/mesh/number.h"
#include "pillowmesh/mesh/portable_math.h"

namespace pillowmesh {
namespace {

/// Reads a whole number between two bounds, both allowed.
template <class T>
Status read_whole(std::string_view name, std::string_view value, long long low, long long high, T& out) {
  std::int64_t number = 0;
  if (!parse_integer(value, number) || number < low || number > high)
    return Status::usage("--" + std::string(name) + " takes a whole number from " + std::to_string(low) + " to " +
                         std::to_string(high) + ", not '" + std::string(value) + "'");
  out = static_cast<T>(number);
  return {};
}

Status read_real(std::string_view name, std::string_view value, double above, double most, const char* range,
                 double& out) {
  double number = 0.0;
  if (!parse_double(value, number) || !(number > above) || !(number <= most))
    return Status::usage("--" + std::string(name) + " takes a number " + range + ", not '" + std::string(value) + "'");
  out = number;
  return {};
}

}  // namespace

Status set_option(AdaptOptions& options, std::string_view name, std::string_view value) {
  if (name == "threshold") return read_real(name, value, 1.0, 1e6, "above 1", options.threshold);
  if (name == "dice") return read_whole(name, value, 1, 16, options.dice);
  if (name == "continuation" && value == "auto") return options.continuation = -1, Status{};
  if (name == "continuation") return read_whole(name, value, 0, 40, options.continuation);
  if (name == "thickness") return read_whole(name, value, 1, 16, options.thickness);
  if (name == "augment" && value == "auto") return options.augment = -1, Status{};
  if (name == "augment") return read_whole(name, value, 0, 16, options.augment);
  if (name == "max-iterations") return read_whole(name, value, 1, 1000, options.max_iterations);
  if (name == "max-cells") return read_whole(name, value, 1, 500'000'000, options.max_cells);
  if (name == "max-sweeps") return read_whole(name, value, 0, 1'000'000, options.max_sweeps);
  if (name == "smooth") {
    if (value == "none") return options.smoothing = Smoothing::none, Status{};
    if (value == "end") return options.smoothing = Smoothing::end, Status{};
    if (value == "between") return options.smoothing = Smoothing::between, Status{};
    return Status::usage("--smooth is one of none, end, between, not '" + std::string(value) + "'");
  }
  if (name == "method") {
    if (value == "auto") return options.method = Method::automatic, Status{};
    if (value == "full") return options.method = Method::full, Status{};
    if (value == "paper") return options.method = Method::paper, Status{};
    return Status::usage("--method is one of auto, full, paper, not '" + std::string(value) + "'");
  }
  if (name == "corner-angle") {
    double degrees = 0.0;
    if (Status s = read_real(name, value, 0.0, 180.0, "of degrees above 0 and up to 180", degrees); !s.ok()) return s;
    options.boundary.corner_cosine = portable::cos(degrees * 0.017453292519943295);
    return {};
  }
  if (name == "freeze") {
    if (value.empty())
      options.boundary.freeze.clear();
    else
      options.boundary.freeze.emplace_back(value);
    return {};
  }
  if (name == "geometry") {
    if (value == "linear") return options.geometry = BoundaryShape::linear, Status{};
    if (value == "smooth") return options.geometry = BoundaryShape::smooth, Status{};
    return Status::usage("--geometry is one of linear, smooth, not '" + std::string(value) + "'");
  }
  if (name == "effort") {
    if (value == "fast") return options.effort = Effort::fast, Status{};
    if (value == "normal") return options.effort = Effort::normal, Status{};
    if (value == "best") return options.effort = Effort::best, Status{};
    return Status::usage("--effort is one of fast, normal, best, not '" + std::string(value) + "'");
  }
  if (name == "align") return read_real(name, value, -1e-300, 1.0, "from 0 to 1", options.align);
  if (name == "seed") return read_whole(name, value, 0, 1'000'000'000, options.seed);
  return Status::usage("there is no option --" + std::string(name));
}

}  // namespace pillowmesh
