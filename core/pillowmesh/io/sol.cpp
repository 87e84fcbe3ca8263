#include "pillowmesh/io/sol.h"

#include <cmath>

#include "pillowmesh/io/sink.h"
#include "pillowmesh/io/source.h"
#include "pillowmesh/metric/spectrum.h"

namespace pillowmesh {
namespace {

constexpr int kSolAtVertices = 62;  // libmeshb's keyword numbers
constexpr int kSolEnd = 54;

bool is_binary(std::string_view name) {
  return name.size() >= 5 && (name.ends_with(".solb") || name.ends_with(".SOLB"));
}

/// The section after its keyword.
template <class Id, class Real>
void read_section(Source& in, SolFile& sol) {
  if (sol.dim == 0) return in.fail("the Dimension should come before SolAtVertices");
  if (!sol.fields.empty()) return in.fail("SolAtVertices is listed twice");
  const auto unit = static_cast<std::int64_t>(in.binary() ? sizeof(Real) : 1);
  sol.vertices = in.count<Id>("values", unit);
  const std::int64_t fields = in.integer("the number of fields");
  if (!in.failed() && (fields < 1 || fields > 100))
    in.fail("there should be 1 to 100 fields at the vertices, not " + std::to_string(fields));
  std::int64_t numbers = 0;
  for (std::int64_t i = 0; i < fields && !in.failed(); ++i) {
    const std::int64_t kind = in.integer("a field's type");
    if (in.failed()) return;
    if (kind < 1 || kind > 3)
      return in.fail("a field's type should be 1 (scalar), 2 (vector) or 3 (symmetric tensor), not " +
                     std::to_string(kind));
    sol.fields.push_back({static_cast<SolField::Kind>(kind), {}});
    numbers += SolField::components(sol.fields.back().kind, sol.dim);
  }
  in.checked_count(sol.vertices, "vertices with values", numbers * unit);
  if (in.failed()) return;
  for (SolField& field : sol.fields)
    field.values.reserve(static_cast<std::size_t>(sol.vertices * SolField::components(field.kind, sol.dim)));
  for (std::int64_t i = 0; i < sol.vertices && !in.failed(); ++i) {
    bool first = true;
    for (SolField& field : sol.fields) {
      for (int k = 0; k < SolField::components(field.kind, sol.dim); ++k) {
        field.values.push_back(in.real<Real>("a value"));
        if (first && !in.binary()) sol.lines.push_back(in.line());
        first = false;
      }
    }
  }
}

void set_dimension(Source& in, SolFile& sol) {
  sol.dim = static_cast<int>(in.integer("the dimension"));
  if (!in.failed() && sol.dim != 2 && sol.dim != 3)
    in.fail("the dimension " + std::to_string(sol.dim) + " is neither 2 nor 3");
}

void read_ascii(Source& in, SolFile& sol) {
  if (in.word() != "MeshVersionFormatted") return in.fail("a .sol file should begin with MeshVersionFormatted");
  in.integer("the version");
  bool after_values = false;
  while (!in.failed()) {
    const std::string_view keyword = in.word();
    if (keyword.empty() || keyword == "End") return;
    if (keyword == "Dimension") set_dimension(in, sol);
    if (keyword == "SolAtVertices") read_section<std::int32_t, double>(in, sol);
    const bool letter = (keyword[0] >= 'A' && keyword[0] <= 'Z') || (keyword[0] >= 'a' && keyword[0] <= 'z');
    // The numbers of sections that do not matter are passed over.
    if (!letter && after_values)
      return in.fail("expected a keyword, found " + quoted(keyword) +
                     "; SolAtVertices holds more numbers than its count says");
    after_values = keyword == "SolAtVertices";
  }
}

template <class Id, class Real, class Offset>
void read_sections(Source& in, SolFile& sol) {
  while (in.remaining() > 0 && !in.failed()) {
    const std::size_t start = in.position();
    const std::int64_t code = in.integer<std::int32_t>("a keyword");
    if (code == kSolEnd) return;
    const auto next = static_cast<std::int64_t>(in.value<Offset>("a section's end"));
    if (in.failed()) return;
    if (code == 3) {
      set_dimension(in, sol);
    } else if (code == kSolAtVertices) {
      read_section<Id, Real>(in, sol);
    } else {
      if (next <= static_cast<std::int64_t>(start) || next > static_cast<std::int64_t>(in.position() + in.remaining()))
        return in.fail("section " + std::to_string(code) + " ends outside of the file; it is truncated");
      in.seek(static_cast<std::size_t>(next));
    }
  }
}

void read_binary(Source& in, SolFile& sol) {
  in.set_binary(false);
  const auto mark = in.value<std::int32_t>("Medit's byte-order mark");
  if (mark == 0x01000000)
    in.set_binary(true);
  else if (mark != 1)
    in.fail_whole("not a binary .solb file: it does not begin with Medit's byte-order mark");
  const auto version = in.value<std::int32_t>("the version");
  if (in.failed()) return;
  if (version == 1) return read_sections<std::int32_t, float, std::int32_t>(in, sol);
  if (version == 2) return read_sections<std::int32_t, double, std::int32_t>(in, sol);
  if (version == 3) return read_sections<std::int32_t, double, std::int64_t>(in, sol);
  if (version == 4) return read_sections<std::int64_t, double, std::int64_t>(in, sol);
  in.fail_whole("Medit version " + std::to_string(version) + " is not supported");
}

}  // namespace

Expected<SolFile> read_sol(std::string_view name, std::span<const char> bytes) {
  if (bytes.empty()) return Status::bad_input(std::string(name) + ": the file is empty");
  SolFile sol;
  Source in(name, bytes, is_binary(name) ? '\0' : '#');
  if (is_binary(name))
    read_binary(in, sol);
  else
    read_ascii(in, sol);
  if (!in.failed() && sol.fields.empty()) in.fail_whole("there are no values at vertices (SolAtVertices)");
  if (in.failed()) return in.status();
  return sol;
}

std::string write_sol(const SolFile& sol, std::string_view name) {
  Sink sink;
  const auto for_each_value = [&](auto&& put) {
    for (std::int64_t i = 0; i < sol.vertices; ++i) {
      for (std::size_t f = 0; f < sol.fields.size(); ++f) {
        const int n = SolField::components(sol.fields[f].kind, sol.dim);
        for (int k = 0; k < n; ++k) put(sol.fields[f].values[static_cast<std::size_t>(i * n + k)], f == 0 && k == 0);
      }
    }
  };
  if (is_binary(name)) {  // version 3: 32-bit numbers, 64-bit positions
    std::int64_t numbers = 0;
    for (const SolField& f : sol.fields) numbers += SolField::components(f.kind, sol.dim);
    const std::int64_t dimension_end = 8 + 16;
    const std::int64_t end =
        dimension_end + 20 + 4 * static_cast<std::int64_t>(sol.fields.size()) + 8 * numbers * sol.vertices;
    for (const std::int32_t v : {1, 3, 3}) sink.raw(v);
    sink.raw(dimension_end);
    for (const std::int32_t v : {sol.dim, kSolAtVertices}) sink.raw(v);
    sink.raw(end);
    sink.raw(static_cast<std::int32_t>(sol.vertices));
    sink.raw(static_cast<std::int32_t>(sol.fields.size()));
    for (const SolField& f : sol.fields) sink.raw(static_cast<std::int32_t>(f.kind));
    for_each_value([&](double v, bool) { sink.raw(v); });
    sink.raw(std::int32_t{kSolEnd});
    sink.raw(std::int64_t{0});
    return sink.take();
  }
  sink << "MeshVersionFormatted 2\n\nDimension " << sol.dim << "\n\nSolAtVertices\n"
       << sol.vertices << '\n'
       << sol.fields.size();
  for (const SolField& f : sol.fields) sink << ' ' << static_cast<std::int32_t>(f.kind);
  bool begun = false;
  for_each_value([&](double v, bool first) {
    if (begun || first) sink << (first ? '\n' : ' ');
    begun = true;
    sink << v;
  });
  sink << "\n\nEnd\n";
  return sink.take();
}

namespace {

/// Whether the file can belong to a mesh.
Status check_fits(const SolFile& sol, const std::string& file, int dim, std::size_t vertices) {
  if (sol.dim != dim)
    return Status::bad_input(file + " is " + std::to_string(sol.dim) + "-dimensional, but the mesh is " +
                             std::to_string(dim) + "-dimensional");
  if (static_cast<std::size_t>(sol.vertices) != vertices)
    return Status::bad_input(file + " has values for " + std::to_string(sol.vertices) + " vertices, but its mesh has " +
                             std::to_string(vertices) + "; give the mesh that it belongs to with --background");
  return {};
}

}  // namespace

Expected<std::vector<double>> scalar_of_sol(const SolFile& sol, std::string_view name, int dim, std::size_t vertices) {
  const std::string file(name);
  if (Status s = check_fits(sol, file, dim, vertices); !s.ok()) return s;
  for (const SolField& f : sol.fields) {
    if (f.kind != SolField::Kind::scalar) continue;
    for (std::size_t i = 0; i < vertices; ++i)
      if (!std::isfinite(f.values[i]))
        return Status::bad_input(file + (sol.lines.empty() ? "" : ", line " + std::to_string(sol.lines[i])) +
                                 ": the value of vertex " + std::to_string(i + 1) + " is not a finite number");
    return f.values;
  }
  return Status::bad_input(file + " has no scalar field");
}

template <int Dim>
Expected<std::vector<SymTensor<Dim>>> metric_of_sol(const SolFile& sol, std::string_view name, std::size_t vertices) {
  const std::string file(name);
  if (Status s = check_fits(sol, file, Dim, vertices); !s.ok()) return s;
  const SolField* chosen = nullptr;
  for (const SolField& f : sol.fields)
    if (f.kind == SolField::Kind::tensor && (chosen == nullptr || chosen->kind != f.kind)) chosen = &f;
  for (const SolField& f : sol.fields)
    if (f.kind == SolField::Kind::scalar && chosen == nullptr) chosen = &f;
  if (chosen == nullptr) return Status::bad_input(file + " has only vectors: a metric is a scalar (size) or a tensor");

  std::vector<SymTensor<Dim>> tensors(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    const auto refuse = [&](const std::string& reason) {
      return Status::bad_input(file + (sol.lines.empty() ? "" : ", line " + std::to_string(sol.lines[i])) +
                               ": vertex " + std::to_string(i + 1) + ": " + reason);
    };
    if (chosen->kind == SolField::Kind::scalar) {
      const double h = chosen->values[i];
      if (!std::isfinite(h) || !(h > 0.0))
        return refuse("the size " +
                      (std::isfinite(h) ? number_text(h)
                       : std::isnan(h)  ? "nan"
                                        : "infinity") +
                      " is not a positive finite number");
      tensors[i] = SymTensor<Dim>::isotropic(h);
    } else {
      for (int k = 0; k < SymTensor<Dim>::size; ++k)
        tensors[i].m[k] = chosen->values[i * SymTensor<Dim>::size + static_cast<std::size_t>(k)];
      if (positive_definite(tensors[i])) continue;
      std::string entries;
      for (const double m : tensors[i].m)
        entries += (entries.empty() ? "" : ", ") + (std::isfinite(m) ? rounded_text(m, 6) : std::string("not finite"));
      return refuse("the tensor (" + entries + ") is not positive definite; its sizes must be positive and finite");
    }
  }
  return tensors;
}

template <int Dim>
SolFile sol_of_metric(std::span<const SymTensor<Dim>> tensors) {
  SolFile sol{Dim, static_cast<std::int64_t>(tensors.size()), {{SolField::Kind::tensor, {}}}, {}};
  for (const SymTensor<Dim>& M : tensors)
    sol.fields[0].values.insert(sol.fields[0].values.end(), M.m.begin(), M.m.end());
  return sol;
}

#define PILLOWMESH_INSTANTIATE(D)                                                                               \
  template Expected<std::vector<SymTensor<D>>> metric_of_sol<D>(const SolFile&, std::string_view, std::size_t); \
  template SolFile sol_of_metric<D>(std::span<const SymTensor<D>>);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
