#include "pillowmesh/metric/portrait.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/portable_math.h"

namespace pillowmesh {
namespace {

// Coordinates: x from -0.8 to 0.8 rightward, y from -1 to 1 upward; the face is around (0, 0.1).

double ramp(double t) { return t <= 0.0 ? 0.0 : (t >= 1.0 ? 1.0 : t * t * (3.0 - 2.0 * t)); }

/// 1 inside of an ellipse whose first axis is turned by `angle`, 0 outside, blurred over `blur` (of its radius).
double ellipse(double x, double y, double cx, double cy, double a, double b, double angle = 0.0, double blur = 0.1) {
  const double c = portable::cos(angle), s = portable::sin(angle), u = x - cx, v = y - cy;
  const double p = (c * u + s * v) / a, q = (-s * u + c * v) / b;
  return 1.0 - ramp((std::sqrt(p * p + q * q) - 1.0) / blur + 0.5);
}

/// 1 on a line from (ax, ay) to (bx, by) bent by `bend` to its left, with round ends.
double stroke(double x, double y, double ax, double ay, double bx, double by, double bend, double width) {
  double nearest = 1e9, last_x = ax, last_y = ay;
  constexpr int kPieces = 12;
  for (int k = 1; k <= kPieces; ++k) {
    const double t = static_cast<double>(k) / kPieces, out = 4.0 * t * (1.0 - t) * bend;
    const double px = ax + t * (bx - ax) - out * (by - ay), py = ay + t * (by - ay) + out * (bx - ax);
    const double ex = px - last_x, ey = py - last_y;
    const double along = std::clamp(((x - last_x) * ex + (y - last_y) * ey) / (ex * ex + ey * ey), 0.0, 1.0);
    const double gx = x - last_x - along * ex, gy = y - last_y - along * ey;
    nearest = std::min(nearest, gx * gx + gy * gy);
    last_x = px;
    last_y = py;
  }
  return 1.0 - ramp(std::sqrt(nearest) / width);
}

double brightness(double x, double y) {
  double v = 0.62 + 0.12 * y - 0.10 * x;  // the wall behind
  const auto paint = [&](double cover, double shade) { v += cover * (shade - v); };
  const double side = 0.16 * x;  // light from the left

  // Coat, shirt and neck.
  paint(ellipse(x, y, 0.0, -1.02, 0.74, 0.46, 0.0, 0.06), 0.13 + 0.06 * std::fabs(x));
  paint(ellipse(x, y, 0.0, -0.58, 0.17, 0.24, 0.0, 0.2), 0.62 - side);
  for (const double s : {-1.0, 1.0}) {
    paint(ellipse(x, y, s * 0.10, -0.74, 0.20, 0.055, s * 0.95, 0.2), 0.93);     // collar
    paint(stroke(x, y, s * 0.22, -0.66, s * 0.06, -1.0, s * 0.08, 0.05), 0.05);  // lapel
  }
  paint(ellipse(x, y, 0.0, -0.80, 0.10, 0.05, 0.0, 0.25), 0.06);  // bow tie
  paint(ellipse(x, y, -0.10, -0.81, 0.08, 0.07, 0.3, 0.2), 0.08);
  paint(ellipse(x, y, 0.10, -0.81, 0.08, 0.07, -0.3, 0.2), 0.08);

  // Hair behind, ears, head.
  paint(ellipse(x, y, 0.0, 0.30, 0.47, 0.50, 0.0, 0.08), 0.17);
  for (const double s : {-1.0, 1.0}) paint(ellipse(x, y, s * 0.415, 0.06, 0.06, 0.11, s * 0.15, 0.25), 0.60 - side);
  paint(ellipse(x, y, 0.0, 0.07, 0.385, 0.53, 0.0, 0.06), 0.80 - side - 0.10 * (y > 0.3 ? y - 0.3 : 0.0));
  paint(ellipse(x, y, -0.22, -0.12, 0.10, 0.10, 0.0, 1.2) * 0.5, 0.88);  // cheeks
  paint(ellipse(x, y, 0.24, -0.12, 0.10, 0.13, 0.0, 1.2) * 0.5, 0.60);
  paint(ellipse(x, y, -0.06, 0.40, 0.18, 0.08, 0.0, 1.2) * 0.5, 0.92);  // forehead

  // Hair in front: a parting on the left.
  paint(ellipse(x, y, -0.34, 0.46, 0.12, 0.28, -0.45, 0.14), 0.15);
  paint(ellipse(x, y, 0.20, 0.62, 0.36, 0.13, -0.35, 0.14), 0.15);
  paint(ellipse(x, y, 0.38, 0.34, 0.07, 0.26, 0.10, 0.2), 0.16);

  // Beard and moustache.
  paint(ellipse(x, y, 0.0, -0.42, 0.335, 0.30, 0.0, 0.12) * ramp((-0.13 - y + 0.5 * x * x) / 0.10), 0.20 - 0.3 * side);
  paint(ellipse(x, y, -0.255, -0.22, 0.115, 0.10, 0.5, 0.4) * 0.9, 0.26);
  paint(ellipse(x, y, 0.255, -0.22, 0.115, 0.10, -0.5, 0.4) * 0.9, 0.20);
  for (const double s : {-1.0, 1.0}) paint(ellipse(x, y, s * 0.085, -0.185, 0.105, 0.036, -s * 0.22, 0.35), 0.16);
  paint(ellipse(x, y, 0.0, -0.262, 0.085, 0.028, 0.0, 0.3), 0.60);  // lower lip
  paint(stroke(x, y, -0.09, -0.238, 0.09, -0.238, -0.05, 0.014), 0.10);

  // Nose.
  paint(stroke(x, y, 0.045, 0.13, 0.075, -0.07, -0.06, 0.035) * 0.7, 0.50);
  paint(ellipse(x, y, 0.0, -0.075, 0.055, 0.045, 0.0, 0.9) * 0.8, 0.88);
  for (const double s : {-1.0, 1.0}) paint(ellipse(x, y, s * 0.042, -0.115, 0.024, 0.012, s * 0.3, 0.5), 0.25);

  // Eyes: socket, white, iris, lid, brow, and the rim of a pair of spectacles.
  for (const double s : {-1.0, 1.0}) {
    paint(ellipse(x, y, s * 0.165, 0.135, 0.12, 0.075, 0.0, 0.9) * 0.6, 0.50 - side);
    paint(ellipse(x, y, s * 0.165, 0.115, 0.082, 0.036, 0.0, 0.2), 0.95);
    paint(ellipse(x, y, s * 0.165 + 0.004, 0.117, 0.036, 0.036, 0.0, 0.2), 0.08);
    paint(stroke(x, y, s * 0.165 - 0.085, 0.120, s * 0.165 + 0.085, 0.120, 0.14, 0.016), 0.10);
    paint(stroke(x, y, s * 0.06, 0.225, s * 0.27, 0.215, s * 0.10, 0.030), 0.12);
    const double rim = std::fabs(std::sqrt((x - s * 0.165) * (x - s * 0.165) + (y - 0.105) * (y - 0.105)) - 0.128);
    paint(1.0 - ramp(rim / 0.013), 0.12);
    paint(stroke(x, y, s * 0.293, 0.115, s * 0.405, 0.135, 0.0, 0.012), 0.15);
  }
  paint(stroke(x, y, -0.045, 0.125, 0.045, 0.125, 0.25, 0.012), 0.12);
  return std::clamp(v, 0.0, 1.0);
}

}  // namespace

GrayImage portrait(int width, int height) {
  GrayImage image{width, height, {}};
  image.values.reserve(static_cast<std::size_t>(width) * height);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      image.values.push_back(
          static_cast<float>(brightness(1.6 * (i + 0.5) / width - 0.8, 1.0 - 2.0 * (j + 0.5) / height)));
  return image;
}

}  // namespace pillowmesh
