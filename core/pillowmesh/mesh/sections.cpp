#include "pillowmesh/mesh/sections.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/portable_math.h"

namespace pillowmesh {
namespace {

constexpr double kRightAngle = 1.5707963267948966;

/// The direction at i n-ths of a full turn from the x axis. Directions that mirror each other have the same digits.
Point<2> direction(long i, long n) {
  const long quadrant = 4 * i / n, rest = 4 * i - quadrant * n;  // rest / n of a right angle
  double c = std::sqrt(0.5), s = c;
  if (2 * rest != n) {
    const bool upper = 2 * rest > n;
    const double angle = kRightAngle * static_cast<double>(upper ? n - rest : rest) / static_cast<double>(n);
    c = portable::cos(angle);
    s = portable::sin(angle);
    if (upper) std::swap(c, s);
  }
  switch (quadrant % 4) {
    case 0:
      return Point<2>(c, s);
    case 1:
      return Point<2>(-s, c);
    case 2:
      return Point<2>(-c, -s);
    default:
      return Point<2>(s, -c);
  }
}

VertexId add_point(MeshInput<2>& section, const Point<2>& p) {
  section.points.push_back(p);
  return static_cast<VertexId>(section.points.size()) - 1;
}

Index add_group(MeshInput<2>& section, const char* name) {
  const Index group = static_cast<Index>(section.facet_groups.size());
  section.facet_groups.push_back({group + 1, name});
  return group;
}

/// Puts the boundary facets along a chain of vertices in one group.
void add_side(MeshInput<2>& section, Index group, const std::vector<VertexId>& chain, bool closed) {
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) section.facets.push_back({{chain[i], chain[i + 1]}, group});
  if (closed) section.facets.push_back({{chain.back(), chain.front()}, group});
}

/// Adds m rows of quads between the chain `inner`, counter-clockwise, and as many points `outer`.
/// \return the rows of vertices, `inner` first.
std::vector<std::vector<VertexId>> add_strip(MeshInput<2>& section, const std::vector<VertexId>& inner,
                                             const std::vector<Point<2>>& outer, int m, bool closed) {
  const std::size_t n = inner.size();
  std::vector<std::vector<VertexId>> rows{inner};
  for (int j = 1; j <= m; ++j) {
    const double t = static_cast<double>(j) / m;
    rows.emplace_back();
    for (std::size_t i = 0; i < n; ++i)
      rows[j].push_back(
          add_point(section, j == m ? outer[i] : Point<2>((1 - t) * section.points[inner[i]] + t * outer[i])));
    for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
      const std::size_t k = (i + 1) % n;
      section.cells.push_back({rows[j - 1][i], rows[j][i], rows[j - 1][k], rows[j][k]});
    }
  }
  return rows;
}

}  // namespace

MeshInput<2> disk_section(int n, int m, double radius) {
  MeshInput<2> section;
  // The core leaves the rings cells of about its own cells' size, and its corners keep clear of the circle.
  const double half = radius * std::min(0.6, n / (n + 2.0 * m));
  // With this bulge the corners of the core have 120 degrees, as three quads want.
  constexpr double bulge = 0.4;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double u = static_cast<double>(2 * i - n) / n, v = static_cast<double>(2 * j - n) / n;
      add_point(section, half * Point<2>(u * std::sqrt(1 - bulge / 2 * v * v), v * std::sqrt(1 - bulge / 2 * u * u)));
    }
  const auto core = [&](int i, int j) { return static_cast<VertexId>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      section.cells.push_back({core(i, j), core(i + 1, j), core(i, j + 1), core(i + 1, j + 1)});
  std::vector<VertexId> around;  // counter-clockwise from the lower right corner
  for (int k = 0; k < n; ++k) around.push_back(core(n, k));
  for (int k = 0; k < n; ++k) around.push_back(core(n - k, n));
  for (int k = 0; k < n; ++k) around.push_back(core(0, n - k));
  for (int k = 0; k < n; ++k) around.push_back(core(k, 0));
  std::vector<Point<2>> circle;
  for (long k = 0; k < 4L * n; ++k) circle.push_back(radius * direction(2 * k + 7L * n, 8L * n));
  const auto rows = add_strip(section, around, circle, m, true);
  add_side(section, add_group(section, "side"), rows[m], true);
  return section;
}

MeshInput<2> ring_section(int n, int m, double inner, double outer) {
  MeshInput<2> section;
  std::vector<VertexId> start;
  std::vector<Point<2>> end;
  for (int i = 0; i < n; ++i) {
    start.push_back(add_point(section, inner * direction(i, n)));
    end.push_back(outer * direction(i, n));
  }
  const auto rows = add_strip(section, start, end, m, true);
  add_side(section, add_group(section, "inner"), rows[0], true);
  add_side(section, add_group(section, "outer"), rows[m], true);
  return section;
}

MeshInput<2> quarter_section(int n, int m, double radius, double side) {
  MeshInput<2> section;
  std::vector<VertexId> arc;
  std::vector<Point<2>> far;
  for (int i = 0; i <= 2 * n; ++i) {
    const Point<2> d = direction(i, 8L * n);
    arc.push_back(add_point(section, radius * d));
    far.push_back(i <= n ? Point<2>(side, side * (d[1] / d[0])) : Point<2>(side * (d[0] / d[1]), side));
  }
  const auto rows = add_strip(section, arc, far, m, false);
  add_side(section, add_group(section, "hole"), rows[0], false);
  std::vector<VertexId> first, last;
  for (const auto& row : rows) {
    first.push_back(row.front());
    last.push_back(row.back());
  }
  add_side(section, add_group(section, "ymin"), first, false);
  add_side(section, add_group(section, "xmax"), {rows[m].begin(), rows[m].begin() + n + 1}, false);
  add_side(section, add_group(section, "ymax"), {rows[m].begin() + n, rows[m].end()}, false);
  add_side(section, add_group(section, "xmin"), last, false);
  return section;
}

MeshInput<2> ell_section(int n, int m, double side, double arm) {
  MeshInput<2> section;
  const auto coordinate = [&](int i) {
    return i <= m ? arm * i / m : (i == n ? side : arm + (side - arm) * (i - m) / (n - m));
  };
  std::vector<VertexId> ids(static_cast<std::size_t>(n + 1) * (n + 1), kNone);
  const auto id = [&](int i, int j) -> VertexId& { return ids[static_cast<std::size_t>(j) * (n + 1) + i]; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= (j <= m ? n : m); ++i) id(i, j) = add_point(section, Point<2>(coordinate(i), coordinate(j)));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < (j < m ? n : m); ++i)
      section.cells.push_back({id(i, j), id(i + 1, j), id(i, j + 1), id(i + 1, j + 1)});
  const auto column = [&](const char* name, int i, int low, int high) {
    std::vector<VertexId> chain;
    for (int j = low; j <= high; ++j) chain.push_back(id(i, j));
    add_side(section, add_group(section, name), chain, false);
  };
  const auto row = [&](const char* name, int j, int low, int high) {
    std::vector<VertexId> chain;
    for (int i = low; i <= high; ++i) chain.push_back(id(i, j));
    add_side(section, add_group(section, name), chain, false);
  };
  column("xmin", 0, 0, n);
  column("xmid", m, m, n);
  column("xmax", n, 0, m);
  row("ymin", 0, 0, n);
  row("ymid", m, m, n);
  row("ymax", n, 0, m);
  return section;
}

MeshInput<3> extrude(const MeshInput<2>& section, int layers, double low, double high) {
  MeshInput<3> out;
  const Index plane = static_cast<Index>(section.points.size());
  out.points.reserve(section.points.size() * (layers + 1));
  out.cells.reserve(section.cells.size() * layers);
  for (int k = 0; k <= layers; ++k) {
    const double z = k == layers ? high : low + (high - low) * k / layers;
    for (const Point<2>& p : section.points) out.points.push_back(Point<3>(p[0], p[1], z));
  }
  out.facet_groups = section.facet_groups;
  const Index bottom = static_cast<Index>(out.facet_groups.size()), top = bottom + 1;
  out.facet_groups.push_back({bottom + 1, "zmin"});
  out.facet_groups.push_back({top + 1, "zmax"});
  for (int k = 0; k < layers; ++k) {
    const Index floor = k * plane, ceiling = floor + plane;
    for (const auto& c : section.cells) {
      Corners<3> hex;
      for (int i = 0; i < 4; ++i) {
        hex[i] = floor + c[i];
        hex[i + 4] = ceiling + c[i];
      }
      out.cells.push_back(hex);
      if (k == 0) out.facets.push_back({{hex[0], hex[1], hex[2], hex[3]}, bottom});
      if (k == layers - 1) out.facets.push_back({{hex[4], hex[5], hex[6], hex[7]}, top});
    }
    for (const auto& f : section.facets)
      out.facets.push_back(
          {{floor + f.vertices[0], floor + f.vertices[1], ceiling + f.vertices[0], ceiling + f.vertices[1]}, f.group});
  }
  return out;
}

}  // namespace pillowmesh
