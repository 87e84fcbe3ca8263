// pillowmesh convert
#include "cli/commands.h"
#include "cli/problem.h"

namespace pillowmesh::cli {

int convert(const ConvertFlags& flags) {
  if (Status s = check_output(flags.output, flags.input, flags.write); !s.ok()) return fail(s);
  auto mesh = load_mesh(flags.input);
  if (!mesh) return fail(mesh.status());
  if (Status s = write_mesh_file(*mesh, flags.output, flags.write); !s.ok()) return fail(s);
  return 0;
}

}  // namespace pillowmesh::cli
