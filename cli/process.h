// The process: interruption, memory, time.
#pragma once

#include <chrono>
#include <cstdint>

namespace pillowmesh::cli {

/// From here on Ctrl-C (SIGINT) or SIGTERM sets `interrupted`; a second one ends the process at once.
void catch_interrupts();
bool interrupted();

/// Most memory that the process has had, in bytes; 0 where the system does not tell.
std::int64_t peak_memory();

/// Seconds since its birth or the last `lap`.
class Clock {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace pillowmesh::cli
