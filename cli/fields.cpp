#include "cli/fields.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <variant>

#include "pillowmesh/io/sol.h"
#include "pillowmesh/mesh/primitives.h"

namespace pillowmesh::cli {
namespace {

bool is_vtk(const std::string& name) {
  std::string e = std::filesystem::path(name).extension().string();
  std::transform(e.begin(), e.end(), e.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return e == ".vtk" || e == ".vtu";
}

/// The fields of a .sol as arrays "solution", "solution_2", ...
template <int Dim>
Status add_sol(const std::string& name, Solution<Dim>& solution) {
  auto bytes = read_file(name);
  if (!bytes) return bytes.status();
  auto sol = read_sol(name, *bytes);
  if (!sol) return sol.status();
  if (sol->dim != Dim || sol->vertices != static_cast<std::int64_t>(solution.points.size()))
    return Status::bad_input(name + ": has values at " + std::to_string(sol->vertices) + " vertices in dimension " +
                             std::to_string(sol->dim) + ", but the mesh has " + std::to_string(solution.points.size()) +
                             " in dimension " + std::to_string(Dim));
  int number = 0;
  for (SolField& f : sol->fields) {
    const std::string label = ++number == 1 ? "solution" : "solution_" + std::to_string(number);
    solution.fields.push_back({label, false, false, SolField::components(f.kind, Dim), std::move(f.values)});
  }
  return {};
}

/// Kinds by number of components, which tell them apart in either dimension.
template <int Dim>
SolFile to_sol(const Mesh<Dim>& mesh, std::vector<FieldArray> fields) {
  SolFile sol;
  sol.dim = Dim;
  sol.vertices = static_cast<std::int64_t>(solution_on(mesh).points.size());
  for (FieldArray& f : fields)
    for (const auto kind : {SolField::Kind::scalar, SolField::Kind::vector, SolField::Kind::tensor})
      if (SolField::components(kind, Dim) == f.components) sol.fields.push_back({kind, std::move(f.values)});
  return sol;
}

std::string count(std::int64_t n, const char* what) {
  return std::to_string(n) + " field" + (n == 1 ? "" : "s") + " of " + what;
}

}  // namespace

Expected<std::optional<AnySolution>> load_fields(const AdaptFlags& flags) {
  std::optional<AnySolution> none;
  const bool primitive = is_primitive(flags.problem.input) || flags.problem.input.empty();
  const bool arrays = !flags.no_fields && !primitive && is_vtk(flags.problem.input) && is_vtk(flags.output);
  if (flags.output.empty() || (!arrays && flags.solution.empty())) return none;
  if (primitive) return Status::usage("--solution belongs to a mesh file");
  auto bytes = read_file(flags.problem.input);
  if (!bytes) return bytes.status();
  auto solution = read_solution(flags.problem.input, *bytes);
  if (!solution) return solution.status();
  return std::visit(
      [&](auto& s) -> Expected<std::optional<AnySolution>> {
        if (!arrays) s.fields.clear();
        if (!flags.solution.empty())
          if (Status status = add_sol(flags.solution, s); !status.ok()) return status;
        if (s.fields.empty()) return none;
        return std::optional<AnySolution>(std::move(s));
      },
      *solution);
}

template <int Dim>
Status write_with_fields(const Mesh<Dim>& mesh, const std::optional<AnySolution>& from, const AdaptFlags& flags,
                         std::vector<CarriedField>& carried) {
  if (!from) return write_mesh_file(mesh, flags.output, flags.write);
  auto fields = carry(std::get<Solution<Dim>>(*from), mesh);
  if (!fields) return Status::bad_input("the fields cannot be carried: " + fields.status().message);
  for (const FieldArray& f : *fields) carried.push_back({f.name, f.of_cells, std::string(carried_how(f))});
  if (is_vtk(flags.output)) return write_mesh_file(mesh, flags.output, flags.write, std::move(*fields));
  if (Status s = write_mesh_file(mesh, flags.output, flags.write); !s.ok()) return s;
  const std::string beside = std::filesystem::path(flags.output).replace_extension(".sol").string();
  return write_text_file(write_sol(to_sol(mesh, std::move(*fields)), beside), beside);
}

std::string sentence(const std::vector<CarriedField>& carried) {
  if (carried.empty()) return "";
  const auto of_cells = std::count_if(carried.begin(), carried.end(), [](const CarriedField& f) { return f.of_cells; });
  const auto of_points = static_cast<std::int64_t>(carried.size()) - of_cells;
  return "carried " + count(of_points, "points") + " (multilinear interpolation), " + count(of_cells, "cells") +
         " (means)";
}

#define PILLOWMESH_INSTANTIATE(Dim)                                                                                \
  template Status write_with_fields(const Mesh<Dim>&, const std::optional<AnySolution>&, const AdaptFlags&,        \
                                    std::vector<CarriedField>&);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh::cli
