// pillowmesh adapt
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>

#include "cli/commands.h"
#include "cli/fields.h"
#include "cli/problem.h"
#include "cli/process.h"
#include "cli/terminal.h"
#include "pillowmesh/adapt/adapter.h"
#include "pillowmesh/mesh/interfaces.h"
#include "pillowmesh/quality/report.h"

namespace pillowmesh::cli {
namespace {

/// Writes step-000.vtu, step-001.vtu, ... into a folder.
class StepFiles {
 public:
  explicit StepFiles(std::string folder) : folder_(std::move(folder)) {}

  Status prepare() const {
    if (folder_.empty()) return {};
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (!std::filesystem::is_directory(folder_))
      return Status::usage("--steps " + folder_ + ": cannot be made: " + error.message());
    return {};
  }
  template <int Dim>
  Status write(const Mesh<Dim>& mesh) {
    if (folder_.empty()) return {};
    char name[32];
    std::snprintf(name, sizeof name, "step-%03d.vtu", next_++);
    return write_mesh_file(mesh, (std::filesystem::path(folder_) / name).string());
  }

 private:
  std::string folder_;
  int next_ = 0;
};

/// Runs the method to its end. \return what went wrong outside of it: a step file that cannot be written.
template <int Dim>
Status run(Adapter<Dim>& adapter, StepFiles& steps, ProgressLine& progress) {
  const auto iterations = [&] {
    const auto found = adapter.operations().find("iterations");
    return found == adapter.operations().end() ? 0 : found->second;
  };
  if (Status s = steps.write(adapter.mesh()); !s.ok()) return s;
  std::int64_t written = iterations();
  for (bool more = true; more;) {
    more = adapter.step();
    progress.draw(adapter.mesh().cell_count());
    // The last file holds the result: what dicing and smoothing make of the last iteration.
    if (iterations() == written && more) continue;
    written = iterations();
    if (Status s = steps.write(adapter.mesh()); !s.ok()) return s;
  }
  progress.clear();
  return {};
}

/// Whether a run came to its own end: edges that stay too long are no reason to stop.
bool usable(const Status& outcome) { return outcome.ok() || outcome.message.starts_with("edges longer"); }

template <int Dim>
double live_cells(const Mesh<Dim>& mesh) {
  double count = 0.0;
  for (CellId c = 0; c < mesh.cell_count(); ++c) count += mesh.alive(c) ? 1.0 : 0.0;
  return count;
}

/// Adapts until the mesh has the number of cells that is asked for, within 5 %. The complexity of the metric is that
/// number from the start, and full adaptation meets it; layers alone make more cells, in a proportion that hardly
/// changes with the sizes: then again with other sizes, a few times. \param adapt_to gives cells / target
template <int Dim, class AdaptTo>
Status meet_target(const MetricField<Dim>& field, AdaptTo&& adapt_to) {
  double low = -20.0, high = 20.0, at = 0.0;  // log of the factor on all sizes
  constexpr int kRuns = 10;
  for (int i = 0; i < kRuns; ++i) {
    const Expected<double> ratio = adapt_to(at == 0.0 ? field : field.scaled(std::exp(at)));
    if (!ratio) return ratio.status();
    if (std::fabs(*ratio - 1.0) <= 0.05) return {};
    (*ratio > 1.0 ? low : high) = at;
    at += std::log(*ratio) / Dim;
    if (!(at > low && at < high)) at = 0.5 * (low + high);
  }
  return {};
}

template <int Dim>
int adapt_mesh(Mesh<Dim> mesh, const AdaptFlags& flags, double read_seconds) {
  auto field = problem_metric<Dim>(flags.problem, mesh);
  if (!field) return fail(field.status());
  const auto solution = load_fields(flags);
  if (!solution) return fail(solution.status());
  StepFiles steps(flags.steps);
  if (Status s = steps.prepare(); !s.ok()) return fail(s);

  if (const Index facets = free_interface_facets(mesh); facets > 0 && !flags.quiet)
    std::fprintf(stderr,
                 "pillowmesh: note: regions meet at %lld %s that are not frozen; the interface may move "
                 "(--freeze GROUP keeps one, see docs/geometry.md)\n",
                 static_cast<long long>(facets), Dim == 2 ? "edges" : "facets");
  const bool print = !flags.quiet && flags.report != "-";
  Clock clock;
  Report initial;
  if (print) initial = measure_lengths_and_shapes(mesh, *field);
  double measure_seconds = clock.lap();

  ProgressLine progress(flags.quiet);
  Context context;
  context.cancelled = interrupted;
  context.progress = [&](double share, std::string_view activity) { progress.set(share, activity); };
  const double target = flags.problem.operations.cells;
  std::optional<Adapter<Dim>> best;
  const auto adapt_to = [&](const MetricField<Dim>& metric) -> Expected<double> {
    Adapter<Dim> adapter(target > 0.0 ? mesh : std::move(mesh), metric, flags.options, context);
    if (Status s = run(adapter, steps, progress); !s.ok()) return s;
    const double ratio = target > 0.0 ? live_cells(adapter.mesh()) / target : 1.0;
    if (!best || std::fabs(ratio - 1.0) < std::fabs(live_cells(best->mesh()) / target - 1.0))
      best.emplace(std::move(adapter));
    return usable(best->outcome()) ? ratio : 1.0;  // stopped for another reason: that is all there is
  };
  if (Status s = meet_target<Dim>(*field, adapt_to); !s.ok()) return fail(s);
  const Adapter<Dim>& adapter = *best;
  field = adapter.field();
  const double adapt_seconds = clock.lap();
  const Status& outcome = adapter.outcome();
  if (outcome.code == StatusCode::bad_input || outcome.code == StatusCode::usage) return fail(outcome);

  std::vector<CarriedField> carried;
  if (!flags.output.empty())
    if (Status s = write_with_fields(adapter.mesh(), *solution, flags, carried); !s.ok()) return fail(s);
  const double write_seconds = clock.lap();

  Report report = measure(adapter.mesh(), *field);
  measure_seconds += clock.lap();
  report.seconds = adapter.seconds();
  report.seconds["read"] = read_seconds;
  report.seconds["measure"] = measure_seconds;
  report.seconds["write"] = write_seconds;
  report.seconds["total"] = read_seconds + measure_seconds + adapt_seconds + write_seconds;
  report.operations = adapter.operations();
  report.fields = carried;
  report.peak_memory_bytes = peak_memory();
  if (Status s = write_report(report, flags.report); !s.ok()) return fail(s);
  if (print) std::fputs(table(report, &initial).c_str(), stdout);
  if (print && !carried.empty()) std::printf("%s\n", sentence(carried).c_str());
  if (!outcome.ok()) return fail(outcome);
  if (target > 0.0 && std::fabs(live_cells(adapter.mesh()) / target - 1.0) > 0.05)
    return fail(Status::limit_not_met("the mesh has " + std::to_string(report.cells) +
                                      " cells, more than 5 % from --target-cells"));
  return report.valid ? 0 : fail(Status::limit_not_met("the adapted mesh is not valid: " + report.defect));
}

}  // namespace

int adapt(const AdaptFlags& flags) {
  if (Status s = check_output(flags.output, flags.problem.input, flags.write); !s.ok()) return fail(s);
  if (Status s = check_not_input(flags.report, flags.problem.input); !s.ok()) return fail(s);
  catch_interrupts();
  Clock clock;
  auto mesh = problem_mesh(flags.problem, flags.options.boundary);
  if (!mesh) return fail(mesh.status());
  const double read_seconds = clock.lap();
  return std::visit([&](auto& m) { return adapt_mesh(std::move(m), flags, read_seconds); }, *mesh);
}

}  // namespace pillowmesh::cli
