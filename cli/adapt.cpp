// pillowmesh adapt
#include <cstdio>
#include <filesystem>
#include <utility>

#include "cli/commands.h"
#include "cli/problem.h"
#include "cli/process.h"
#include "cli/terminal.h"
#include "pillowmesh/adapt/adapter.h"
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

template <int Dim>
int adapt_mesh(Mesh<Dim> mesh, const AdaptFlags& flags, double read_seconds) {
  auto field = problem_metric<Dim>(flags.problem, mesh);
  if (!field) return fail(field.status());
  StepFiles steps(flags.steps);
  if (Status s = steps.prepare(); !s.ok()) return fail(s);

  const bool print = !flags.quiet && flags.report != "-";
  Clock clock;
  Report initial;
  if (print) initial = measure(mesh, *field);
  double measure_seconds = clock.lap();

  ProgressLine progress(flags.quiet);
  Context context;
  context.cancelled = interrupted;
  context.progress = [&](double share, std::string_view activity) { progress.set(share, activity); };
  Adapter<Dim> adapter(std::move(mesh), *field, flags.options, std::move(context));
  if (Status s = run(adapter, steps, progress); !s.ok()) return fail(s);
  const double adapt_seconds = clock.lap();
  const Status& outcome = adapter.outcome();
  if (outcome.code == StatusCode::bad_input || outcome.code == StatusCode::usage) return fail(outcome);

  if (!flags.output.empty())
    if (Status s = write_mesh_file(adapter.mesh(), flags.output, flags.write); !s.ok()) return fail(s);
  const double write_seconds = clock.lap();

  Report report = measure(adapter.mesh(), *field);
  measure_seconds += clock.lap();
  report.seconds = adapter.seconds();
  report.seconds["read"] = read_seconds;
  report.seconds["measure"] = measure_seconds;
  report.seconds["write"] = write_seconds;
  report.seconds["total"] = read_seconds + measure_seconds + adapt_seconds + write_seconds;
  report.operations = adapter.operations();
  report.peak_memory_bytes = peak_memory();
  if (Status s = write_report(report, flags.report); !s.ok()) return fail(s);
  if (print) std::fputs(table(report, &initial).c_str(), stdout);
  if (!outcome.ok()) return fail(outcome);
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
