#include <algorithm>
#include <string>
#include <vector>

#include "pillowmesh/mesh/number.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/sections.h"

namespace pillowmesh {
namespace {

constexpr double kMostCells = 1e8;

/// A primitive's name, how it is written, and how many sizes it has in 2D (all have two counts). In 3D there are one
/// count and two sizes more.
struct Form {
  const char* name;
  const char* usage;
  std::size_t sizes;
};
constexpr Form kForms[] = {
    {"grid", "grid:NX,NY[,NZ]:X0,X1,Y0,Y1[,Z0,Z1]", 4}, {"ogrid", "ogrid:N,M[,NZ]:R[,Z0,Z1]", 1},
    {"ring", "ring:N,M[,NZ]:R0,R1[,Z0,Z1]", 2},         {"quarter", "quarter:N,M[,NZ]:R,S[,Z0,Z1]", 2},
    {"lprism", "lprism:N,M[,NZ]:S,A[,Z0,Z1]", 2},
};

const Form* find_form(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return nullptr;
  for (const Form& form : kForms)
    if (text.substr(0, colon) == form.name) return &form;
  return nullptr;
}

Status mistake(const Form& form, const std::string& what) {
  return Status::usage(what + ": a" + (form.name[0] == 'o' ? "n " : " ") + form.name + " is written " + form.usage);
}

/// Splits at commas; each part must be a number as a whole.
Expected<std::vector<double>> parse_numbers(const Form& form, const std::string& text) {
  std::vector<double> numbers;
  std::size_t at = 0;
  while (at <= text.size()) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string part = text.substr(at, end - at);
    double value = 0.0;
    if (!parse_double(part, value) || !(value - value == 0.0)) return mistake(form, "'" + part + "' is not a number");
    numbers.push_back(value);
    at = end + 1;
  }
  return numbers;
}

/// Checked numbers: counts that are whole and at least 1.
struct Numbers {
  std::vector<int> counts;
  std::vector<double> sizes;
  [[nodiscard]] bool solid() const { return counts.size() == 3; }
};

Expected<Numbers> parse(const Form& form, const std::string& text) {
  const std::size_t start = text.find(':') + 1, colon = text.find(':', start);
  const std::string lacking = std::string(form.name) == "grid" ? "bounds" : "sizes";
  if (colon == std::string::npos) return mistake(form, "'" + text + "' lacks its " + lacking);
  const auto counts = parse_numbers(form, text.substr(start, colon - start));
  if (!counts) return counts.status();
  const auto sizes = parse_numbers(form, text.substr(colon + 1));
  if (!sizes) return sizes.status();
  const std::size_t dim = counts->size();
  if ((dim != 2 && dim != 3) || sizes->size() != form.sizes + (dim == 3 ? 2 : 0))
    return mistake(form, "'" + text + "' has " + std::to_string(dim) + " counts and " + std::to_string(sizes->size()) +
                             " " + lacking);
  Numbers numbers;
  for (const double n : *counts) {
    if (n < 1 || n > kMostCells || n != static_cast<double>(static_cast<long>(n)))
      return mistake(form, "the counts of '" + text + "' must be whole numbers of at least 1");
    numbers.counts.push_back(static_cast<int>(n));
  }
  numbers.sizes = *sizes;
  return numbers;
}

template <int Dim>
Expected<AnyMesh> grid_from(const Form& form, const Numbers& numbers) {
  std::array<int, Dim> n{};
  Point<Dim> low, high;
  for (int d = 0; d < Dim; ++d) {
    n[d] = numbers.counts[d];
    low[d] = numbers.sizes[2 * d];
    high[d] = numbers.sizes[2 * d + 1];
    if (!(low[d] < high[d])) return mistake(form, "bounds come in pairs low,high with low < high");
  }
  if constexpr (kHasDimension<Dim>) {
    return AnyMesh(make_grid<Dim>(n, low, high));
  } else {
    return other_dimension<Dim>();
  }
}

/// The condition on the sizes of a section, or "" where it holds.
std::string broken_condition(const std::string& name, int n, int m, double a, double b) {
  if (name == "ogrid") return a > 0 ? "" : "the radius R must be above 0";
  if (name == "ring")
    return n < 3 ? "a ring needs at least 3 cells around" : (0 < a && a < b ? "" : "0 < R0 < R1 must hold");
  if (name == "quarter") return 0 < a && a < b ? "" : "0 < R < S must hold";
  return m >= n ? "M < N must hold" : (0 < b && b < a ? "" : "0 < A < S must hold");
}

MeshInput<2> section_of(const std::string& name, int n, int m, double a, double b) {
  if (name == "ogrid") return disk_section(n, m, a);
  if (name == "ring") return ring_section(n, m, a, b);
  if (name == "quarter") return quarter_section(n, m, a, b);
  return ell_section(n, m, a, b);
}

template <int Dim>
Expected<AnyMesh> finish(MeshInput<Dim> input) {
  if constexpr (kHasDimension<Dim>) {
    auto mesh = make_section(std::move(input));
    if (!mesh) return Status::usage("the sizes are out of proportion: " + mesh.status().message);
    return AnyMesh(std::move(*mesh));
  } else {
    return other_dimension<Dim>();
  }
}

Expected<AnyMesh> make_primitive(std::string_view spec) {
  const Form* form = find_form(spec);
  if (form == nullptr) {
    std::string forms;
    for (const Form& f : kForms) forms += (forms.empty() ? "" : ", ") + std::string(f.usage);
    return Status::usage("'" + std::string(spec) + "' is not a mesh that can be made; there are " + forms);
  }
  const auto numbers = parse(*form, std::string(spec));
  if (!numbers) return numbers.status();
  const int n = numbers->counts[0], m = numbers->counts[1];
  const bool solid = numbers->solid(), box = std::string(form->name) == "grid";
  // Each section has at most (n + 2 m)^2 cells but for a ring, and the quarter's n is half of its cells along the arc.
  const double across =
      box || std::string(form->name) == "ring" ? static_cast<double>(n) * m : (n + 2.0 * m) * (n + 2.0 * m);
  if (across * (solid ? numbers->counts[2] : 1) > kMostCells)
    return mistake(*form, "'" + std::string(spec) + "' has more than 100 million cells");
  if (box) return solid ? grid_from<3>(*form, *numbers) : grid_from<2>(*form, *numbers);

  const double a = numbers->sizes[0], b = form->sizes > 1 ? numbers->sizes[1] : 0.0;
  if (const std::string broken = broken_condition(form->name, n, m, a, b); !broken.empty())
    return mistake(*form, broken);
  const MeshInput<2> section = section_of(form->name, n, m, a, b);
  if (!solid) return finish<2>(section);
  const double low = numbers->sizes[form->sizes], high = numbers->sizes[form->sizes + 1];
  if (!(low < high)) return mistake(*form, "Z0 < Z1 must hold");
  return finish<3>(extrude(section, numbers->counts[2], low, high));
}

}  // namespace

bool is_primitive(std::string_view text) { return find_form(text) != nullptr; }

Expected<AnyMesh> parse_primitive(std::string_view spec, const std::vector<std::string>& freeze) {
  auto mesh = make_primitive(spec);
  if (!mesh || freeze.empty()) return mesh;
  // Made again, with the patches and corners that it has.
  BoundaryOptions options;
  options.corner_cosine = -2.0;
  options.freeze = freeze;
  return std::visit([&](const auto& m) { return make_any_mesh(to_input(m), spec, options); }, *mesh);
}

}  // namespace pillowmesh
