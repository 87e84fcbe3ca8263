#include "cli/terminal.h"

#include <unistd.h>

#include <cstdio>

#include "pillowmesh/io/io.h"

namespace pillowmesh::cli {
namespace {

std::string format(const char* pattern, auto... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

std::string row(const char* name, const char* mesh, const Statistics& s) {
  return format("%-15s %-8s %9lld %9.4g %9.4g %9.4g %9.4g\n", name, mesh, static_cast<long long>(s.count), s.min,
                s.mean, s.max, s.cv);
}

std::string seconds_line(const Report& report) {
  const auto total = report.seconds.find("total");
  if (total == report.seconds.end()) return {};
  std::string parts;
  for (const auto& [name, value] : report.seconds)
    if (name != "total" && value >= 0.005) parts += (parts.empty() ? "" : ", ") + name + format(" %.2f", value);
  return format("time %.2f s", total->second) + (parts.empty() ? "" : " (" + parts + ")") + "\n";
}

}  // namespace

ProgressLine::ProgressLine(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO) == 1) {}

void ProgressLine::set(double share, std::string_view activity) {
  share_ = share;
  activity_ = activity;
}

void ProgressLine::draw(std::int64_t cells) {
  if (!shown_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  drawn_ = true;
  std::fprintf(stderr, "\r%3.0f %%  %-24.24s %12lld cells\033[K", 100.0 * share_, activity_.c_str(),
               static_cast<long long>(cells));
  std::fflush(stderr);
}

void ProgressLine::clear() {
  if (!drawn_) return;
  drawn_ = false;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
}

std::string table(const Report& report, const Report* initial) {
  std::string text = format("%lld %s, %lld edges, %lld vertices (%lld irregular); ideal number of %s %.0f\n",
                            static_cast<long long>(report.cells), report.dim == 2 ? "quads" : "hexahedra",
                            static_cast<long long>(report.edges), static_cast<long long>(report.vertices),
                            static_cast<long long>(report.irregular_vertices), report.dim == 2 ? "quads" : "hexahedra",
                            report.complexity);
  text += format("%-15s %-8s %9s %9s %9s %9s %9s\n", "", "", "count", "min", "mean", "max", "cv");
  const char* mesh = initial != nullptr ? "adapted" : "";
  if (initial != nullptr) text += row("edge length l", "initial", initial->edge_length);
  text += row("edge length l", mesh, report.edge_length);
  if (initial != nullptr) text += row("shape eta", "initial", initial->shape);
  text += row("shape eta", mesh, report.shape);
  text += row("eta, integral", mesh, report.shape_integral);
  text += format("scaled Jacobian min %.4g, mean %.4g; %.1f %% of the edges with l in [0.71, 1.41]\n",
                 report.scaled_jacobian_min, report.scaled_jacobian_mean, 100.0 * report.edge_length.share_in_range);
  text += report.valid ? "valid: conforming, manifold, all corner Jacobians positive\n"
                       : "NOT VALID: " + report.defect + "\n";
  return text + seconds_line(report);
}

Status write_report(const Report& report, const std::string& path) {
  if (path.empty()) return {};
  std::string json = to_json(report);
  if (!json.ends_with('\n')) json += '\n';
  if (path != "-") return write_text_file(json, path);
  std::fputs(json.c_str(), stdout);
  return {};
}

}  // namespace pillowmesh::cli
