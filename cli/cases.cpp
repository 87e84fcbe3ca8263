// pillowmesh cases
#include <cstdio>
#include <string>

#include "cli/commands.h"
#include "pillowmesh/metric/gallery.h"

namespace pillowmesh::cli {

int cases() {
  for (const Case& c : gallery()) {
    std::string formula;
    for (char k : c.formula) {
      formula += k;
      if (k == '\n') formula += "                 ";
    }
    const auto text = [](std::string_view s) { return static_cast<int>(s.size()); };
    std::printf("%-16.*s %.*s (%dD, %.*s)\n  mesh           %.*s\n  metric         %s\n\n", text(c.name), c.name.data(),
                text(c.title), c.title.data(), c.dim, text(c.source), c.source.data(), text(c.mesh), c.mesh.data(),
                formula.c_str());
  }
  const Case& portrait = portrait_case();
  std::printf(
      "%s          %s (%s)\n  mesh           %s\n  metric         of an image that is computed, see --metric-image\n\n",
      portrait.name.data(), portrait.title.data(), portrait.source.data(), portrait.mesh.data());
  std::puts("Run one with: pillowmesh adapt --case NAME -o OUT.vtu");
  return 0;
}

}  // namespace pillowmesh::cli
