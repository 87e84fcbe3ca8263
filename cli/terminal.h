// What the command says while it runs and when it is done.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "pillowmesh/quality/report.h"

namespace pillowmesh::cli {

/// One line on a terminal's stderr, redrawn at most ten times a second; silent when stderr is no terminal.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void set(double share, std::string_view activity);
  void draw(std::int64_t cells);
  void clear();

 private:
  bool shown_;
  bool drawn_ = false;
  double share_ = 0.0;
  std::string activity_;
  std::chrono::steady_clock::time_point next_{};
};

/// The indicators as a table, as in the paper; with the initial mesh's rows when `initial` is given.
std::string table(const Report& report, const Report* initial = nullptr);

/// To the file, or to stdout for "-"; nothing for an empty path.
Status write_report(const Report& report, const std::string& path);

}  // namespace pillowmesh::cli
