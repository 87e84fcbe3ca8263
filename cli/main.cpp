// The command line: options, help, exit status. 0 done; 1 finished but a limit was not met; 2 usage; 3 bad input.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "cli/commands.h"
#include "cli/problem.h"

namespace pillowmesh::cli {

int fail(const Status& status) {
  std::fflush(stdout);
  std::fprintf(stderr, "pillowmesh: %s\n", status.message.c_str());
  const int code = static_cast<int>(status.code);
  return code >= 1 && code <= 3 ? code : 1;
}

namespace {

constexpr const char* kMeshHelp =
    "Meshes: .mesh .meshb (Medit), .msh (Gmsh 2.2 and 4.1), .vtk, .vtu; all quads or all hexahedra; or one that is\n"
    "made, in 3D with the parts in brackets: grid:NX,NY[,NZ]:X0,X1,Y0,Y1[,Z0,Z1]; disk or cylinder\n"
    "ogrid:N,M[,NZ]:R[,Z0,Z1]; ring or tube ring:N,M[,NZ]:R0,R1[,Z0,Z1]; square or box without a quarter disk or\n"
    "cylinder quarter:N,M[,NZ]:R,S[,Z0,Z1]; L or L-prism lprism:N,M[,NZ]:S,A[,Z0,Z1]. N cells one way, M the other.\n";
constexpr const char* kMetricHelp =
    "Metric: statements `name = expression;` over x, y, z, r = |(x,y,z)|, pi and earlier names, with + - * / ^,\n"
    "comparison, if(c,a,b), sqrt exp log sin cos tan atan2 asin acos tanh abs min max pow floor. The result is `h`;\n"
    "or `h1 h2 theta` (2D), `h1 h2 h3 [theta phi]` (3D); or the tensor `m11 m12 m22 [m13 m23 m33]`.\n";
constexpr const char* kExitHelp =
    "Exit status: 0 done; 1 finished, but a requested limit was not met; 2 usage; 3 bad input.\n";

/// Operations of MetricOperations: parsed by set_operation, which the page uses too.
struct OptionHelp {
  const char* name;
  const char* type;
  const char* text;
};
constexpr OptionHelp kOperations[] = {
    {"target-cells", "N", "Scale all sizes so that the adapted mesh has N cells, to 5 %"},
    {"hmin", "H", "No size below H"},
    {"hmax", "H", "No size above H"},
    {"max-anisotropy", "A", "No size more than A times another at the same point"},
    {"gradation", "G", "Sizes grow by at most the factor G from one cell to the next"},
};

/// What the command line gave, by option.
using Given = std::map<std::string, std::string>;

void add_problem(CLI::App& app, ProblemFlags& flags, Given& given) {
  app.add_option("input", flags.input, "Mesh file or grid:...; may be left out with --case");
  app.option_defaults()->group("Metric");
  app.add_option("--metric", flags.metric, "Metric formula")->type_name("FORMULA");
  app.add_option("--metric-file", flags.metric_file,
                 "Metric from a Medit .sol or .solb file: a size or tensor per vertex")
      ->type_name("F.sol");
  app.add_option("--background", flags.background,
                 "Mesh that --metric-file belongs to; triangles and tets too (default: input)")
      ->type_name("MESH");
  app.add_option("--metric-image", flags.image,
                 "Metric from the Hessian of a picture: PNG, JPEG, BMP, PNM (6000 cells by default)")
      ->type_name("F.png");
  app.add_option("--hessian-of", flags.hessian_of,
                 "Metric from the Hessian of a function, e.g. \"tanh(20*(x-.5*sin(3*y)))\"")
      ->type_name("FORMULA");
  app.add_option("--hessian-file", flags.hessian_file, "Metric from the Hessian of a solution: a scalar per vertex")
      ->type_name("F.sol");
  app.add_option("--norm", flags.norm, "Hessians: keep the error small in the norm L^P (default 2, pictures 1; inf)")
      ->type_name("P");
  app.add_option("--error", flags.error, "Hessians: interpolation error asked for, in place of --target-cells")
      ->type_name("E");
  app.add_option("--metric-of", flags.metric_of, "Metric that another mesh has")->type_name("MESH");
  app.add_option("--sketch", flags.sketch, "Metric from dabs, one per line: x y radius size [angle stretch]")
      ->type_name("F");
  app.add_option("--boundary-layer", flags.layers,
                 "Layers along a boundary group, first height, growth; may be repeated")
      ->type_name("GROUP:H:G");
  app.add_option("--curvature", flags.curvature, "Cells so small at curved boundaries that a full circle gets N")
      ->type_name("N");
  app.add_option("--case", flags.case_name, "Named case: its metric, and its mesh if none is given (see cases)")
      ->type_name("NAME");
  app.add_option("--size-scale", flags.size_scale, "Multiplies all sizes of the metric")->type_name("F");
  for (const OptionHelp& o : kOperations)
    app.add_option(std::string("--") + o.name, given[o.name], o.text)->type_name(o.type);
  app.option_defaults()->group("Options");
}

Status set_operations(const CLI::App& app, const Given& given, ProblemFlags& flags) {
  for (const OptionHelp& o : kOperations)
    if (app.count(std::string("--") + o.name) > 0)
      if (Status s = set_operation(flags.operations, o.name, given.at(o.name)); !s.ok()) return s;
  return {};
}

void add_write(CLI::App& app, WriteOptions& write, std::string& gmsh) {
  app.add_flag("--binary", write.binary, "Write the binary variant of the format");
  app.add_option("--gmsh-version", gmsh, "Version of a .msh file: 2.2 or 4.1 (default 4.1)")->type_name("V");
}

/// The options of AdaptOptions: parsed by set_option, which the page and permalinks use too.
constexpr OptionHelp kOptions[] = {
    {"method", "auto|full|paper",
     "full: refine, coarsen, reconnect and relocate quads; paper: refine and smooth, as for hexahedra; auto "
     "(default): full, unless an option of the paper's method is given"},
    {"threshold", "L", "Refine edges with a metric length above L (default 2)"},
    {"effort", "fast|normal|best", "How long method full searches (default normal)"},
    {"align", "A", "Method full: how much edges follow the metric's directions, 0 to 1 (default 1)"},
    {"seed", "N", "Method full: of its random numbers; the same seed gives the same mesh everywhere (default 1)"},
    {"smooth", "none|end|between",
     "Method paper: when vertices are relocated (default end; between: after each iteration too)"},
    {"dice", "N", "Method paper: refine N times coarser, then split each cell in N^dim (default 1)"},
    {"thickness", "K", "Method paper: cells across a layer at its seed (default 1)"},
    {"continuation", "N",
     "Method paper: approach the metric in N steps, from a floor on sizes that is halved; 0: at once; auto (default): "
     "7 where sizes change fast in 3D"},
    {"augment", "N", "Rings of cells added at the ends of a layer, or auto (default): 1 in 2D, 0 in 3D"},
    {"geometry", "linear|smooth",
     "New boundary vertices on the input's edges and facets (default), or on smooth curves and surfaces through its "
     "boundary vertices, on circles where those are"},
    {"corner-angle", "DEGREES",
     "The boundary of a file has a corner (2D) or a feature edge (3D) where it turns by more (default 40)"},
    {"max-cells", "N", "Stop with a valid mesh before it has more cells (default 10000000)"},
    {"max-iterations", "N", "Iterations at the most (default 30)"},
    {"max-sweeps", "N", "Sweeps of the smoother at the most, each time it runs (default 200)"},
};

/// Options of the paper's method choose it, unless the other one is asked for.
Status choose_method(const Given& given, AdaptOptions& options) {
  for (const char* name : {"smooth", "dice", "thickness", "continuation"}) {
    const auto at = given.find(name);
    if (at == given.end() || at->second.empty()) continue;
    const auto method = given.find("method");
    if (method != given.end() && method->second == "full")
      return Status::usage(std::string("--") + name + " belongs to --method paper");
    options.method = Method::paper;
  }
  return {};
}

Status set_gmsh_version(WriteOptions& write, const std::string& text) {
  if (text.empty()) return {};
  if (text == "2.2" || text == "22" || text == "2") {
    write.gmsh_version = 22;
  } else if (text == "4.1" || text == "41" || text == "4") {
    write.gmsh_version = 41;
  } else {
    return Status::usage("--gmsh-version is 2.2 or 4.1, not '" + text + "'");
  }
  return {};
}

/// CLI11's exceptions end here. \return the exit status
int usage_error(const CLI::App& app, const CLI::Error& error, int argc, char** argv) {
  std::string hint;
  const std::vector<std::string> commands{"adapt", "measure", "metric", "convert", "cases"};
  if (argc > 1 && app.get_subcommands().empty()) {
    const std::string near = argv[1][0] == '-' ? "" : nearest(argv[1], commands);
    if (!near.empty() && near != argv[1]) hint = "; did you mean '" + near + "'?";
  }
  const auto used = app.get_subcommands();
  const std::string name = used.empty() ? "pillowmesh" : "pillowmesh " + used.front()->get_name();
  return fail(Status::usage(std::string(error.what()) + hint + " (see " + name + " --help)"));
}

int run(int argc, char** argv) {
  CLI::App app{"Adapts all-quadrilateral and all-hexahedral meshes to an anisotropic metric."};
  app.name("pillowmesh");
  app.set_version_flag("--version", "pillowmesh " PILLOWMESH_VERSION);
  app.require_subcommand(1);
  app.footer(std::string("Examples:\n"
                         "  pillowmesh adapt --case iso2d -o iso2d.vtu\n"
                         "  pillowmesh adapt plate.msh --metric \"h = 0.02 + 0.15*abs(x-2)\" -o adapted.msh\n"
                         "  pillowmesh measure adapted.msh --metric \"h = 0.02 + 0.15*abs(x-2)\" --report report.json\n"
                         "  pillowmesh convert adapted.msh adapted.vtu --binary\n\n") +
             kExitHelp);

  AdaptFlags adapt_flags;
  std::string adapt_gmsh;
  Given given, measure_given, metric_given;
  CLI::App* adapt_app = app.add_subcommand("adapt", "Adapt a mesh to a metric");
  add_problem(*adapt_app, adapt_flags.problem, given);
  adapt_app->option_defaults()->group("Method");
  for (const OptionHelp& o : kOptions)
    adapt_app->add_option(std::string("--") + o.name, given[o.name], o.text)->type_name(o.type);
  std::vector<std::string> freeze;
  adapt_app
      ->add_option("--freeze", freeze,
                   "Keep a group (of cells, boundary facets, edges or points) as it is; may be repeated. So are the "
                   "required entities of a Medit file")
      ->type_name("GROUP")
      ->allow_extra_args(false);
  adapt_app->option_defaults()->group("Output");
  adapt_app->add_option("-o,--output", adapt_flags.output, "Adapted mesh; its ending chooses the format")
      ->type_name("OUT");
  add_write(*adapt_app, adapt_flags.write, adapt_gmsh);
  adapt_app->add_option("--solution", adapt_flags.solution,
                        "Carry the fields of this .sol at the input's vertices: to a .sol beside OUT, or into a VTK file")
      ->type_name("F.sol");
  adapt_app->add_flag("--no-fields", adapt_flags.no_fields, "Do not carry the arrays of a VTK input to a VTK output");
  adapt_app
      ->add_option("--steps", adapt_flags.steps,
                   "Write the mesh after each iteration, and the last: DIR/step-000.vtu, ...")
      ->type_name("DIR");
  adapt_app->add_option("--report", adapt_flags.report, "Write the indicators as JSON; - for stdout")
      ->type_name("R.json");
  adapt_app->add_flag("-q,--quiet", adapt_flags.quiet, "No progress line, no table");
  adapt_app->footer(std::string("Examples:\n"
                                "  pillowmesh adapt --case aniso2d -o aniso2d.vtu --steps steps\n"
                                "  pillowmesh adapt plate.msh --metric \"h = 0.02 + 0.15*abs(x-2)\" -o out.vtu\n"
                                "  pillowmesh adapt grid:8,8:0,1,0,1 --metric \"h1 = 0.2; h2 = 0.01 + 0.2*y\" --smooth "
                                "between -o out.mesh\n"
                                "  pillowmesh adapt --case circle2d --dice 3 --report -\n\n") +
                    kMeshHelp + kMetricHelp + "Ctrl-C stops with the valid mesh that is there (exit status 1).\n" +
                    kExitHelp);

  MeasureFlags measure_flags;
  CLI::App* measure_app = app.add_subcommand("measure", "Print the indicators of any quad or hex mesh");
  add_problem(*measure_app, measure_flags.problem, measure_given);
  measure_app->add_option("--report", measure_flags.report, "Write the indicators as JSON; - for stdout")
      ->type_name("R.json");
  measure_app->footer(std::string("Examples:\n"
                                  "  pillowmesh measure --case iso2d\n"
                                  "  pillowmesh measure out.vtu --metric \"h = 0.1\" --report -\n\n") +
                      kMeshHelp + kMetricHelp + kExitHelp);

  MetricFlags metric_flags;
  CLI::App* metric_app = app.add_subcommand("metric", "Write a metric at the vertices of a mesh, as .sol");
  add_problem(*metric_app, metric_flags.problem, metric_given);
  metric_app->add_option("-o,--output", metric_flags.output, "Medit .sol (text) or .solb (binary)")
      ->type_name("F.sol")
      ->required();
  metric_app->footer(
      std::string("Examples:\n"
                  "  pillowmesh metric --case circle2d grid:200,200:-1,1,-1,1 -o circle.sol\n"
                  "  pillowmesh metric plate.mesh --metric \"h = 0.02 + 0.15*abs(x-2)\" -o plate.sol\n\n") +
      kMeshHelp + kMetricHelp + kExitHelp);

  ConvertFlags convert_flags;
  std::string convert_gmsh;
  CLI::App* convert_app = app.add_subcommand("convert", "Convert a mesh to another format; groups are kept");
  convert_app->add_option("input", convert_flags.input, "Mesh file or grid:...")->required();
  convert_app->add_option("output", convert_flags.output, "Mesh file; its ending chooses the format")->required();
  add_write(*convert_app, convert_flags.write, convert_gmsh);
  convert_app->footer(std::string("Examples:\n"
                                  "  pillowmesh convert plate.msh plate.vtu --binary\n"
                                  "  pillowmesh convert plate.vtk plate.msh --gmsh-version 2.2\n"
                                  "  pillowmesh convert grid:4,4:0,1,0,1 square.mesh\n\n") +
                      kMeshHelp + kExitHelp);

  CLI::App* cases_app = app.add_subcommand("cases", "List the named cases: mesh and metric of each");
  cases_app->footer("Example:\n  pillowmesh adapt --case iso2d -o iso2d.vtu\n");

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {  // --help, --version
    return app.exit(done);
  } catch (const CLI::Error& error) {
    return usage_error(app, error, argc, argv);
  }
  for (const OptionHelp& o : kOptions)
    if (adapt_app->count(std::string("--") + o.name) > 0)
      if (Status s = set_option(adapt_flags.options, o.name, given[o.name]); !s.ok()) return fail(s);
  if (Status s = set_operations(*adapt_app, given, adapt_flags.problem); !s.ok()) return fail(s);
  if (Status s = set_operations(*measure_app, measure_given, measure_flags.problem); !s.ok()) return fail(s);
  if (Status s = set_operations(*metric_app, metric_given, metric_flags.problem); !s.ok()) return fail(s);
  for (const std::string& group : freeze)
    if (Status s = set_option(adapt_flags.options, "freeze", group); !s.ok()) return fail(s);
  if (Status s = choose_method(given, adapt_flags.options); !s.ok()) return fail(s);
  if (Status s = set_gmsh_version(adapt_flags.write, adapt_gmsh); !s.ok()) return fail(s);
  if (Status s = set_gmsh_version(convert_flags.write, convert_gmsh); !s.ok()) return fail(s);

  if (*adapt_app) return adapt(adapt_flags);
  if (*measure_app) return measure(measure_flags);
  if (*metric_app) return metric(metric_flags);
  if (*convert_app) return convert(convert_flags);
  return cases();
}

}  // namespace
}  // namespace pillowmesh::cli

int main(int argc, char** argv) {
#ifdef __GLIBC__
  // Memory is asked for in large pieces, of which only what is used counts: a mesh that grows page by page waits for the
  // system a quarter of the time.
  mallopt(M_TOP_PAD, 64 << 20);
#endif
  return pillowmesh::cli::run(argc, argv);
}
