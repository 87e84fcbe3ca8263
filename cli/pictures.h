// Pictures and sketches from files.
#pragma once

#include <string>
#include <vector>

#include "pillowmesh/metric/image.h"
#include "pillowmesh/metric/sketch.h"

namespace pillowmesh::cli {

/// PNG, JPEG, BMP or PNM; colours become brightness. \return bad_input: file and reason
Expected<GrayImage> read_image(const std::string& path);

/// One dab per line: x y radius size [angle in degrees, stretch]; # starts a comment. \return bad_input: file, line,
/// reason
Expected<std::vector<Dab>> read_sketch(const std::string& path);

}  // namespace pillowmesh::cli
