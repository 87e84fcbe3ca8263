#include "pillowmesh/mesh/foot.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/jacobian.h"

namespace pillowmesh {
namespace {

int cut_at(double t) { return t <= 0 ? 0 : (t >= 1 ? 1 : kNone); }

template <int Dim>
Foot<Dim> foot_on_chord(const Point<Dim>& a, const Point<Dim>& b, const Point<Dim>& p) {
  const Point<Dim> e = b - a;
  const double t = e.dot(p - a) / e.squaredNorm();
  Foot<Dim> foot;
  foot.cut[0] = cut_at(t);
  foot.point = t <= 0 ? a : (t >= 1 ? b : Point<Dim>(a + t * e));
  foot.distance2 = (p - foot.point).squaredNorm();
  foot.tangent[0] = e;
  return foot;
}

template <int Dim>
bool is_straight(const Bend<Dim>& bend) {
  return (bend.from.array() == 0).all() && (bend.to.array() == 0).all();
}

/// Newton on the squared distance from the foot on the chord, cut off at the ends.
template <int Dim>
Foot<Dim> foot_on_curve(const Point<Dim>& a, const Point<Dim>& b, const Bend<Dim>& bend, const Point<Dim>& p) {
  if (is_straight(bend)) return foot_on_chord<Dim>(a, b, p);
  const Point<Dim> e = b - a;
  double s = std::min(std::max(e.dot(p - a) / e.squaredNorm(), 0.0), 1.0);
  for (int i = 0; i < 25; ++i) {
    const Point<Dim> r = a + s * e + off_chord(bend, s) - p, d = e + off_chord_slope(bend, s);
    const Point<Dim> dd = (6 * s - 4) * bend.from + (6 * s - 2) * bend.to;
    const double flat = d.squaredNorm(), bent = flat + r.dot(dd);
    const double step = -r.dot(d) / (bent > 0.3 * flat ? bent : flat);
    const double next = std::min(std::max(s + step, 0.0), 1.0), change = std::abs(next - s);
    s = next;
    if (change < 1e-15) break;
  }
  Foot<Dim> foot;
  foot.cut[0] = cut_at(s);
  foot.point = s <= 0 ? a : (s >= 1 ? b : Point<Dim>(a + s * e + off_chord(bend, s)));
  foot.distance2 = (p - foot.point).squaredNorm();
  foot.tangent[0] = e + off_chord_slope(bend, s);
  return foot;
}

/// On the arc from a to b, which is less than half of the circle; straight out from its centre.
Foot<2> foot_on_arc(const Point<2>& a, const Point<2>& b, const Circle& circle, const Point<2>& p) {
  const Point<2> ca = a - circle.centre, cb = b - circle.centre, d = p - circle.centre;
  const double turn = cross(ca, cb) > 0 ? 1.0 : -1.0, length2 = d.squaredNorm();
  const bool after_a = turn * cross(ca, d) > 0, before_b = turn * cross(d, cb) > 0;
  Foot<2> foot;
  if (after_a && before_b) {
    foot.cut[0] = kNone;
    foot.point = circle.centre + circle.radius / std::sqrt(length2) * d;
  } else {
    foot.cut[0] = (p - a).squaredNorm() < (p - b).squaredNorm() ? 0 : 1;
    foot.point = foot.cut[0] == 0 ? a : b;
  }
  foot.distance2 = (p - foot.point).squaredNorm();
  const Point<2> out = foot.point - circle.centre;
  foot.tangent[0] = turn * Point<2>(-out[1], out[0]);
  return foot;
}

/// Four corners and, where it is bent, four sides: the bilinear patch, and on it what the sides are off their chords
/// (Coons, "Surfaces for computer-aided design of space forms", 1967).
class QuadPiece {
 public:
  QuadPiece(const Geometry<3>& g, Index i) : bends_(nullptr) {
    for (int k = 0; k < 4; ++k) q_[k] = g.points[g.facets[i][k]];
    if (g.bends.empty()) return;
    bool straight = true;
    for (const Bend<3>& bend : g.bends[i]) straight = straight && is_straight(bend);
    if (!straight) bends_ = g.bends[i].data();
  }
  void at(double u, double v) {
    point = (1 - v) * ((1 - u) * q_[0] + u * q_[1]) + v * ((1 - u) * q_[2] + u * q_[3]);
    du = (1 - v) * (q_[1] - q_[0]) + v * (q_[3] - q_[2]);
    dv = (1 - u) * (q_[2] - q_[0]) + u * (q_[3] - q_[1]);
    if (bends_ == nullptr) return;
    const Point<3> left = off_chord(bends_[0], v), right = off_chord(bends_[1], v), low = off_chord(bends_[2], u),
                   high = off_chord(bends_[3], u);
    point += (1 - u) * left + u * right + (1 - v) * low + v * high;
    du += right - left + (1 - v) * off_chord_slope(bends_[2], u) + v * off_chord_slope(bends_[3], u);
    dv += high - low + (1 - u) * off_chord_slope(bends_[0], v) + u * off_chord_slope(bends_[1], v);
  }

  Point<3> point, du, dv;

 private:
  Point<3> q_[4];
  const Bend<3>* bends_;
};

/// Gauss-Newton on (u, v), cut off at the unit square.
Foot<3> foot_on_quad(QuadPiece piece, const Point<3>& p) {
  double u = 0.5, v = 0.5;
  for (int i = 0; i < 25; ++i) {
    piece.at(u, v);
    const Point<3>&du = piece.du, &dv = piece.dv;
    const Point<3> r = p - piece.point;
    double a = du.dot(du), b = du.dot(dv), c = dv.dot(dv), f = du.dot(r), g = dv.dot(r);
    // On a side that the step leads out of, only the other parameter is free.
    const bool fix_u = (u <= 0 && f < 0) || (u >= 1 && f > 0), fix_v = (v <= 0 && g < 0) || (v >= 1 && g > 0);
    double su = 0, sv = 0;
    const double det = a * c - b * b;
    if (!fix_u && !fix_v && det > 1e-30 * a * c) {
      su = (c * f - b * g) / det;
      sv = (a * g - b * f) / det;
    } else if (!fix_u && a > 0) {
      su = f / a;
    } else if (!fix_v && c > 0) {
      sv = g / c;
    }
    const double u1 = std::min(std::max(u + su, 0.0), 1.0), v1 = std::min(std::max(v + sv, 0.0), 1.0);
    const double change = std::abs(u1 - u) + std::abs(v1 - v);
    u = u1;
    v = v1;
    if (change < 1e-15) break;
  }
  piece.at(u, v);
  Foot<3> foot;
  foot.point = piece.point;
  foot.distance2 = (p - foot.point).squaredNorm();
  foot.cut[0] = cut_at(u);
  foot.cut[1] = cut_at(v);
  foot.tangent[0] = piece.du;
  foot.tangent[1] = piece.dv;
  return foot;
}

}  // namespace

template <>
Foot<2> foot_on_facet(const Geometry<2>& g, Index i, const Point<2>& p) {
  const Point<2>&a = g.points[g.facets[i][0]], &b = g.points[g.facets[i][1]];
  if (g.bends.empty()) return foot_on_chord<2>(a, b, p);
  if (g.circle[i] != kNone) return foot_on_arc(a, b, g.circles[g.circle[i]], p);
  return foot_on_curve<2>(a, b, g.bends[i][0], p);
}

template <>
Foot<3> foot_on_facet(const Geometry<3>& g, Index i, const Point<3>& p) {
  return foot_on_quad({g, i}, p);
}

template <int Dim>
Foot<Dim> foot_on_segment(const Geometry<Dim>& g, Index i, const Point<Dim>& p) {
  const Point<Dim>&a = g.points[g.segments[i][0]], &b = g.points[g.segments[i][1]];
  return g.segment_bends.empty() ? foot_on_chord<Dim>(a, b, p) : foot_on_curve<Dim>(a, b, g.segment_bends[i], p);
}

template Foot<2> foot_on_segment(const Geometry<2>&, Index, const Point<2>&);
template Foot<3> foot_on_segment(const Geometry<3>&, Index, const Point<3>&);

}  // namespace pillowmesh
