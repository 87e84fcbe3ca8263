// The subcommands of `pillowmesh`: what each is asked to do, and its exit status.
#pragma once

#include <string>
#include <vector>

#include "pillowmesh/adapt/options.h"
#include "pillowmesh/io/io.h"
#include "pillowmesh/metric/combine.h"

namespace pillowmesh::cli {

/// Where mesh and metric come from.
struct ProblemFlags {
  std::string input;                ///< a file, a primitive (grid:...), or empty: the mesh of the case
  std::string metric;               ///< a formula
  std::string metric_file;          ///< a .sol file
  std::string background;           ///< the mesh that it belongs to; empty: the input
  std::string case_name;            ///< a name of the gallery
  std::string image;                ///< PNG, JPEG, PNM, BMP
  std::string hessian_of;           ///< a function
  std::string hessian_file;         ///< its values, a .sol file
  std::string metric_of;            ///< a mesh
  std::string sketch;               ///< a list of dabs
  std::vector<std::string> layers;  ///< GROUP:FIRST:GROWTH
  double curvature = 0.0;           ///< cells on a full circle; 0: none
  double norm = 0.0;                ///< 0: as the source says
  double error = 0.0;
  double size_scale = 1.0;
  MetricOperations operations;
};

struct AdaptFlags {
  ProblemFlags problem;
  AdaptOptions options;
  WriteOptions write;
  std::string output;
  std::string solution;  ///< a .sol of the input
  bool no_fields = false;  ///< do not carry the arrays of a VTK input
  std::string steps;   ///< folder for one file per iteration
  std::string report;  ///< file, or "-"
  bool quiet = false;
};

struct MeasureFlags {
  ProblemFlags problem;
  std::string report;
};

struct MetricFlags {
  ProblemFlags problem;
  std::string output;
};

struct ConvertFlags {
  std::string input, output;
  WriteOptions write;
};

int adapt(const AdaptFlags& flags);
int measure(const MeasureFlags& flags);
int metric(const MetricFlags& flags);
int convert(const ConvertFlags& flags);
int cases();

/// Prints the sentence of `status` to stderr. \return the exit status of the command
int fail(const Status& status);

}  // namespace pillowmesh::cli
