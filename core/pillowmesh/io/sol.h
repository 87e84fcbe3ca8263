// Medit's .sol (ASCII) and .solb (binary): values at the vertices of a mesh in another file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pillowmesh/mesh/status.h"
#include "pillowmesh/metric/tensor.h"

namespace pillowmesh {

/// One field of a file. `values` holds the components of vertex 0, then those of vertex 1, ...; tensors in Medit's
/// order, which is SymTensor's: m11 m12 m22 [m13 m23 m33].
struct SolField {
  enum class Kind : std::uint8_t { scalar = 1, vector = 2, tensor = 3 };
  Kind kind = Kind::scalar;
  std::vector<double> values;

  [[nodiscard]] static int components(Kind kind, int dim) {
    return kind == Kind::scalar ? 1 : (kind == Kind::vector ? dim : dim * (dim + 1) / 2);
  }
};

struct SolFile {
  int dim = 0;
  std::int64_t vertices = 0;
  std::vector<SolField> fields;
  /// Line of each vertex's first number; empty for binary files.
  std::vector<std::int64_t> lines;
};

/// Reads the section SolAtVertices; others are skipped. The ending .solb means binary.
/// \return bad_input: file, line and reason.
Expected<SolFile> read_sol(std::string_view name, std::span<const char> bytes);

/// The bytes of a file; .solb is binary. Numbers read back as the same bits. \pre fields have values for all vertices
std::string write_sol(const SolFile& sol, std::string_view name);

/// The metric that a file states, a tensor or a size per vertex: the first field that is a tensor, or else a scalar.
/// \param vertices of the mesh that the file belongs to
/// \return bad_input that names file, line and vertex: another dimension or number of vertices, no such field, a size
/// that is not positive and finite, a tensor that is not positive definite.
template <int Dim>
Expected<std::vector<SymTensor<Dim>>> metric_of_sol(const SolFile& sol, std::string_view name, std::size_t vertices);

/// The values of the first scalar field. \return bad_input as metric_of_sol; every value must be finite
Expected<std::vector<double>> scalar_of_sol(const SolFile& sol, std::string_view name, int dim, std::size_t vertices);

/// A file with one tensor field.
template <int Dim>
SolFile sol_of_metric(std::span<const SymTensor<Dim>> tensors);

}  // namespace pillowmesh
