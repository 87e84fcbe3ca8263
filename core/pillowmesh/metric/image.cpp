#include "pillowmesh/metric/image.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "pillowmesh/mesh/portable_math.h"
#include "pillowmesh/metric/spectrum.h"

namespace pillowmesh {
namespace {

constexpr int kMost = 320;

/// Numbers on a grid, row by row.
struct Raster {
  int width, height;
  std::vector<double> v;
  [[nodiscard]] double at(int i, int j) const {  // beyond the rim: the rim
    return v[static_cast<std::size_t>(std::clamp(j, 0, height - 1)) * width + std::clamp(i, 0, width - 1)];
  }
};

/// The means over equal intervals of a line of `from` pixels, `stride` numbers apart.
void shrink_line(const double* in, int from, int stride, double* out, int to, int out_stride) {
  const double step = static_cast<double>(from) / to;
  for (int k = 0; k < to; ++k) {
    const double low = k * step, high = low + step;
    double sum = 0.0;
    for (int i = static_cast<int>(low); i < from && i < high; ++i)
      sum += in[static_cast<std::size_t>(i) * stride] * (std::min<double>(high, i + 1) - std::max<double>(low, i));
    out[static_cast<std::size_t>(k) * out_stride] = sum / step;
  }
}

Raster shrink(const GrayImage& image) {
  const double factor = std::min(1.0, static_cast<double>(kMost) / std::max(image.width, image.height));
  const int w = std::max(4, static_cast<int>(image.width * factor)),
            h = std::max(4, static_cast<int>(image.height * factor));
  const std::vector<double> all(image.values.begin(), image.values.end());
  std::vector<double> rows(static_cast<std::size_t>(w) * image.height);
  for (int j = 0; j < image.height; ++j)
    shrink_line(all.data() + static_cast<std::size_t>(j) * image.width, image.width, 1,
                rows.data() + static_cast<std::size_t>(j) * w, w, 1);
  Raster out{w, h, std::vector<double>(static_cast<std::size_t>(w) * h)};
  for (int i = 0; i < w; ++i) shrink_line(rows.data() + i, image.height, w, out.v.data() + i, h, w);
  return out;
}

/// Gaussian mean with this standard deviation in pixels.
Raster smooth(const Raster& in, double deviation) {
  const int reach = std::max(1, static_cast<int>(std::ceil(3.0 * deviation)));
  std::vector<double> weight(static_cast<std::size_t>(reach) + 1);
  double sum = 0.0;
  for (int k = 0; k <= reach; ++k) {
    weight[k] = portable::exp(-0.5 * k * k / (deviation * deviation));
    sum += (k == 0 ? 1.0 : 2.0) * weight[k];
  }
  Raster half = in, out = in;
  for (int pass = 0; pass < 2; ++pass) {
    const Raster& from = pass == 0 ? in : half;
    Raster& to = pass == 0 ? half : out;
    for (int j = 0; j < in.height; ++j)
      for (int i = 0; i < in.width; ++i) {
        double s = weight[0] * from.at(i, j);
        for (int k = 1; k <= reach; ++k)
          s += weight[k] * (pass == 0 ? from.at(i - k, j) + from.at(i + k, j) : from.at(i, j - k) + from.at(i, j + k));
        to.v[static_cast<std::size_t>(j) * in.width + i] = s / sum;
      }
  }
  return out;
}

Status check(const GrayImage& image) {
  if (image.width < 4 || image.height < 4)
    return Status::bad_input("the image has " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                             " pixels; it takes at least 4 x 4 to see where it bends");
  if (image.values.size() != static_cast<std::size_t>(image.width) * image.height)
    return Status::bad_input("the image should have " + std::to_string(image.width) + " x " +
                             std::to_string(image.height) + " values, not " + std::to_string(image.values.size()));
  for (std::size_t k = 0; k < image.values.size(); ++k)
    if (!std::isfinite(image.values[k]))
      return Status::bad_input("pixel (" + std::to_string(k % image.width) + ", " + std::to_string(k / image.width) +
                               ") of the image is not a finite number");
  const auto [low, high] = std::minmax_element(image.values.begin(), image.values.end());
  if (static_cast<double>(*high) - *low <= 1e-3 * std::max(std::fabs(*high), std::fabs(*low)))
    return Status::bad_input(
        "the image has one colour: there is nothing in it that cells could follow; take one with contrast");
  return {};
}

}  // namespace

Expected<NodalMetric<2>> image_metric(const GrayImage& image, const Point<2>& low, const Point<2>& high,
                                      const ImageOptions& options) {
  if (Status s = check(image); !s.ok()) return s;
  const Raster raw = shrink(image);
  const int w = raw.width, h = raw.height;
  const double deviation = std::max(0.5, options.smoothing * std::max(w, h));
  const Raster gray = smooth(raw, deviation);

  NodalMetric<2> metric = nodal_grid<2>({w - 1, h - 1}, low, high);
  const double dx = (high[0] - low[0]) / (w - 1), dy = (high[1] - low[1]) / (h - 1);
  Raster entries[3] = {gray, gray, gray};
  for (int j = 0; j < h; ++j) {
    for (int i = 0; i < w; ++i) {
      // Rows go down, y goes up. At the rim the difference beside it.
      const int a = std::clamp(i, 1, w - 2), b = std::clamp(j, 1, h - 2);
      const double c = gray.at(a, b);
      SymTensor<2> H;
      H.m[0] = (gray.at(a - 1, b) - 2.0 * c + gray.at(a + 1, b)) / (dx * dx);
      H.m[2] = (gray.at(a, b - 1) - 2.0 * c + gray.at(a, b + 1)) / (dy * dy);
      H.m[1] = -(gray.at(a + 1, b + 1) + gray.at(a - 1, b - 1) - gray.at(a + 1, b - 1) - gray.at(a - 1, b + 1)) /
               (4.0 * dx * dy);
      H = map_eigenvalues(H, [](double v) { return std::fabs(v); });
      for (int k = 0; k < 3; ++k) entries[k].v[static_cast<std::size_t>(j) * w + i] = H.m[k];
    }
  }
  // |H| vanishes in the middle of every edge of the image, where it bends one way and then the other: the mean closes
  // that.
  for (Raster& entry : entries) entry = smooth(entry, 1.5 * deviation);
  for (int j = 0; j < h; ++j)
    for (int i = 0; i < w; ++i)
      for (int k = 0; k < 3; ++k)
        metric.tensors[static_cast<std::size_t>(h - 1 - j) * w + i].m[k] =
            entries[k].v[static_cast<std::size_t>(j) * w + i];
  if (Status s = multiscale_metric(metric, options.hessian); !s.ok()) return s;
  return metric;
}

}  // namespace pillowmesh
