// The metric of an image: cells small and stretched where the brightness bends.
#pragma once

#include <vector>

#include "pillowmesh/metric/hessian.h"

namespace pillowmesh {

struct GrayImage {
  int width = 0, height = 0;
  std::vector<float> values;  ///< row by row from the top, each from the left; any unit
};

struct ImageOptions {
  /// The floor says how large cells get where nothing is to be seen, and with that how far directions and sizes turn on the
  /// way to what is: at .003 quads cannot follow (cv of lengths .10 and shapes down to .2 in case riemann), at .02 they do
  /// (.083, .6), and the face stays as clear.
  HessianOptions hessian{.norm = 1.0, .floor = 2e-2};
  /// Standard deviation of the Gaussian that smooths the image, and then its Hessians, as a share of the longer side:
  /// finer detail is not seen. At least half a pixel of the grid is used.
  double smoothing = 0.006;
};

/// A metric on a grid over the box from `low` to `high`, onto which the image is stretched: area means on at most 320
/// points along the longer side, smoothed, second differences, their absolute values smoothed, multiscale_metric. Its
/// sizes mean nothing until they are scaled to a number of cells. \return bad_input: smaller than 4 x 4, a value that
/// is no number (which pixel), one colour (what to do).
Expected<NodalMetric<2>> image_metric(const GrayImage& image, const Point<2>& low, const Point<2>& high,
                                      const ImageOptions& options = {});

}  // namespace pillowmesh
