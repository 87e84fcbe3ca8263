// Error against cells for uniform, isotropic and anisotropic meshes.
//
//   convergence          a short run of each problem, which checks itself
//   convergence --all    all rows of docs/convergence.md, as lines "problem kind cells error carried-error"
#include <cstdio>
#include <string_view>

#include "loop.h"

using namespace solver;
using pillowmesh::Effort;

namespace {

const char* name_of(Kind kind) {
  return kind == Kind::uniform ? "uniform" : (kind == Kind::isotropic ? "isotropic" : "anisotropic");
}

void print(const Known& known, Kind kind, const Turn& t) {
  std::printf("%s %s %d %.4e %.4e\n", known.name.c_str(), name_of(kind), t.cells, t.error, t.carried);
  std::fflush(stdout);
}

/// Doubles the number of cells `levels` times, `turns` turns of the loop at each. \return the last turn
bool adapted(const Known& known, Kind kind, double cells, int levels, int turns, Effort last, Turn& t) {
  State state;
  t = begin(known, 16, state);
  for (int level = 0; level <= levels; ++level, cells *= 2) {
    for (int i = 0; i < turns; ++i) {
      const auto next = turn(known, cells, kind == Kind::isotropic, i + 1 < turns ? Effort::fast : last, state);
      if (!next.ok()) {
        std::fprintf(stderr, "%s: %s\n", known.name.c_str(), next.status().message.c_str());
        return false;
      }
      t = *next;
    }
    print(known, kind, t);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const bool all = argc > 1 && std::string_view(argv[1]) == "--all";
  bool good = true;
  for (const Known& known : known_problems()) {
    Turn coarse, fine;
    State state;
    for (int n = 16; n <= (all ? 512 : 32); n *= 2) {
      const Turn t = begin(known, n, state);
      if (n == 16) coarse = t;
      print(known, Kind::uniform, t);
    }
    if (all) good = adapted(known, Kind::isotropic, 250, 4, 4, Effort::normal, fine) && good;
    if (!adapted(known, Kind::anisotropic, 250, all ? 4 : 0, 4, all ? Effort::normal : Effort::fast, fine)) return 1;
    if (!all) good = good && fine.error < 0.6 * coarse.error;
  }
  return good ? 0 : 1;
}
