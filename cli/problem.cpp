#include "cli/problem.h"

#include <algorithm>
#include <filesystem>

#include "pillowmesh/metric/gallery.h"

namespace pillowmesh::cli {
namespace {

/// Norm, error and curvature: what has to be above what.
Status check_numbers(const ProblemFlags& flags) {
  const bool curved = !flags.hessian_of.empty() || !flags.hessian_file.empty() || !flags.image.empty();
  if (flags.norm != 0.0 && !(flags.norm >= 1.0)) return Status::usage("--norm takes a number from 1, or inf");
  if (flags.error != 0.0 && !(flags.error > 0.0)) return Status::usage("--error takes a number above 0");
  if (flags.curvature != 0.0 && !(flags.curvature >= 3.0)) return Status::usage("--curvature takes a number from 3");
  if ((flags.norm != 0.0 || flags.error != 0.0) && !curved)
    return Status::usage("--norm and --error belong to --hessian-of, --hessian-file and --metric-image");
  if ((!flags.hessian_of.empty() || !flags.hessian_file.empty()) && flags.error == 0.0 && flags.operations.cells == 0.0)
    return Status::usage(
        "a Hessian says where cells should be small, not how small: give --target-cells N or --error E");
  return {};
}

bool names_metric(const ProblemFlags& flags) {
  for (const std::string* source : {&flags.metric, &flags.case_name, &flags.metric_file, &flags.image,
                                    &flags.hessian_of, &flags.hessian_file, &flags.metric_of, &flags.sketch})
    if (!source->empty()) return true;
  return !flags.layers.empty() || flags.curvature > 0.0;
}

}  // namespace

Expected<const Case*> named_case(const std::string& name) {
  if (const Case* c = find_case(name)) return c;
  if (name == portrait_case().name) return &portrait_case();
  std::vector<std::string> names{std::string(portrait_case().name)};
  std::string all;
  for (const Case& c : gallery()) {
    names.emplace_back(c.name);
    all += names.back() + " ";
  }
  const std::string near = nearest(name, names);
  return Status::usage("there is no case '" + name + "'" + (near.empty() ? "" : "; did you mean '" + near + "'?") +
                       " (cases: " + all + std::string(portrait_case().name) + ")");
}

namespace {

/// Insertions, deletions and replacements that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& c : candidates) {
    const std::size_t distance = edit_distance(word, c);
    if (distance < least) {
      least = distance;
      best = c;
    }
  }
  return best;
}

Expected<AnyMesh> load_mesh(const std::string& input, const BoundaryOptions& options) {
  return is_primitive(input) ? parse_primitive(input, options.freeze) : read_mesh_file(input, options);
}

Expected<AnyMesh> problem_mesh(const ProblemFlags& flags, const BoundaryOptions& options) {
  if (!(flags.size_scale > 0.0 && flags.size_scale < 1e300))
    return Status::usage("--size-scale takes a number above 0");
  if (!flags.metric.empty() && !flags.case_name.empty()) return Status::usage("--metric and --case exclude each other");
  if (!names_metric(flags))
    return Status::usage(
        "a metric is missing: give --metric \"h = ...\", --metric-file F.sol --case NAME or another source");
  if (!flags.background.empty() && flags.metric_file.empty() && flags.hessian_file.empty())
    return Status::usage("--background is the mesh of --metric-file or --hessian-file, which is missing");
  if (Status s = check_numbers(flags); !s.ok()) return s;
  if (!flags.case_name.empty()) {
    auto c = named_case(flags.case_name);
    if (!c) return c.status();
    if (flags.input.empty()) return parse_primitive((*c)->mesh, options.freeze);
  }
  if (flags.input.empty()) return Status::usage("a mesh is missing: give a file, grid:... or --case NAME");
  return load_mesh(flags.input, options);
}

Status check_not_input(const std::string& output, const std::string& input) {
  std::error_code ignored;
  if (output.empty() || output == "-" || input.empty() || !std::filesystem::equivalent(output, input, ignored))
    return {};
  return Status::usage(output + " is the input file; write to another name");
}

Status check_output(const std::string& output, const std::string& input, const WriteOptions& options) {
  if (output.empty()) return {};
  if (Status s = check_writable(output, options); !s.ok()) return s;
  std::error_code ignored;
  const std::filesystem::path folder = std::filesystem::path(output).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, ignored))
    return Status::usage(output + ": cannot be written: there is no folder " + folder.string());
  if (std::filesystem::is_directory(output, ignored)) return Status::usage(output + " is a folder");
  return check_not_input(output, input);
}

}  // namespace pillowmesh::cli
