// pillowmesh measure
#include <cstdio>

#include "cli/commands.h"
#include "cli/problem.h"
#include "cli/process.h"
#include "cli/terminal.h"
#include "pillowmesh/quality/report.h"

namespace pillowmesh::cli {
namespace {

template <int Dim>
int measure_mesh(const Mesh<Dim>& mesh, const MeasureFlags& flags, double read_seconds) {
  auto field = problem_metric<Dim>(flags.problem, mesh);
  if (!field) return fail(field.status());
  Clock clock;
  Report report = pillowmesh::measure(mesh, *field);
  const double seconds = clock.lap();
  report.seconds = {{"total", read_seconds + seconds}, {"read", read_seconds}, {"measure", seconds}};
  report.peak_memory_bytes = peak_memory();
  if (Status s = write_report(report, flags.report); !s.ok()) return fail(s);
  if (flags.report != "-") std::fputs(table(report).c_str(), stdout);
  return 0;
}

}  // namespace

int measure(const MeasureFlags& flags) {
  if (Status s = check_not_input(flags.report, flags.problem.input); !s.ok()) return fail(s);
  Clock clock;
  auto mesh = problem_mesh(flags.problem);
  if (!mesh) return fail(mesh.status());
  const double read_seconds = clock.lap();
  return std::visit([&](const auto& m) { return measure_mesh(m, flags, read_seconds); }, *mesh);
}

}  // namespace pillowmesh::cli
