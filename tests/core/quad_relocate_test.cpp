#include "pillowmesh/smooth/quad_relocate.h"

#include <random>

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/metric/length.h"
#include "pillowmesh/quality/report.h"
#include "pillowmesh/smooth/quad_descent.h"

namespace quad_relocate_test {

using namespace pillowmesh;

namespace {

struct Box {
  Point<2> low, high;
};
Box box_of(const Mesh<2>& mesh) {
  Box box{mesh.points[0], mesh.points[0]};
  for (const auto& p : mesh.points) box = {box.low.cwiseMin(p), box.high.cwiseMax(p)};
  return box;
}
Background background(const Mesh<2>& mesh, const char* text) {
  const Box box = box_of(mesh);
  return {*MetricField<2>::from_formula(text), box.low, box.high};
}

/// Moves each interior vertex by up to `share` of its shortest edge, where that leaves its cells valid.
void shake(Mesh<2>& mesh, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<CellCorner> star;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.support[v].dim != 2) continue;
    vertex_star(mesh, v, star);
    double shortest = 1e300;
    for (const CellCorner& c : star)
      for (int axis = 0; axis < 2; ++axis)
        shortest = std::min(shortest, (mesh.points[mesh.cells[c.cell][c.corner ^ (1 << axis)]] - mesh.points[v]).norm());
    const Point<2> old = mesh.points[v];
    mesh.points[v] += share * shortest * Point<2>(random() / 2147483648.0 - 1.0, random() / 2147483648.0 - 1.0);
    if (!validate(mesh).ok()) mesh.points[v] = old;
  }
}

}  // namespace

TEST_CASE("a mesh of unit squares in the metric has no energy, and keeps its vertices") {
  auto mesh = make_grid<2>({6, 5}, Point<2>(0, 0), Point<2>(3, 5));
  const auto points = mesh.points;
  auto metric = background(mesh, "h1 = 0.5; h2 = 1");
  QuadRelocator relocator(mesh, metric, {.alignment = 0.5});
  CHECK(relocator.total_energy() == Approx(0.0).margin(1e-12));
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) CHECK(relocator.relocate(v) == 0.0);
  CHECK(mesh.points == points);
}

TEST_CASE("cells twice too long cost what the formula of the energy says") {
  // l1 = 2, l2 = 1, d = 2: w = 5 (1 + 1/4) / 2 - 2 = 1.125, E = d w.
  auto mesh = make_grid<2>({3, 3}, Point<2>(0, 0), Point<2>(6, 3));
  auto metric = background(mesh, "h = 1");
  QuadRelocator relocator(mesh, metric, {});
  CHECK(relocator.energy(4) == Approx(2.25));
  CHECK(relocator.total_energy() == Approx(9 * 2.25));
}

TEST_CASE("lengths cost what they are off by, at each corner, times their weight") {
  auto mesh = make_grid<2>({3, 3}, Point<2>(0, 0), Point<2>(6, 3));
  auto metric = background(mesh, "h = 1");
  QuadRelocator relocator(mesh, metric, {.length = 0.5});
  CHECK(relocator.energy(4) == Approx(2.25 + 4 * 0.5 * (1.0 + 0.0)));
}

TEST_CASE("spread of lengths, lack of shape and misalignment are those of the report") {
  auto mesh = make_grid<2>({12, 12}, Point<2>(0, 0), Point<2>(1, 1));
  shake(mesh, 0.3, 8);
  const char* text = "h1 = 0.1; h2 = 0.04 + 0.2*x; theta = 0.4 + x";
  auto metric = background(mesh, text);
  const QuadRelocator relocator(mesh, metric, {});
  const auto left = relocator.indicators();
  const Report report = measure(mesh, *MetricField<2>::from_formula(text));
  CHECK(left.spread == Approx(report.edge_length.cv).epsilon(0.01));
  CHECK(1.0 - left.lack == Approx(report.shape.mean).epsilon(0.01));
  CHECK(left.misalignment == relocator.misalignment());
}

TEST_CASE("the gradient of the energy agrees with finite differences") {
  auto mesh = make_grid<2>({6, 6}, Point<2>(0, 0), Point<2>(1, 1));
  shake(mesh, 0.4, 5);
  for (const EnergyWeights& weights : {EnergyWeights{}, EnergyWeights{.alignment = 0.5},
                                       EnergyWeights{.alignment = 0.5, .shape = 10.0, .shape_floor = 0.9, .obtuse = 0.5},
                                       EnergyWeights{.alignment = 0.5, .length = 3.0}}) {
    auto metric = background(mesh, "h1 = 0.1; h2 = 0.2; theta = 0.4");  // the angle between edges uses one metric
    QuadRelocator relocator(mesh, metric, weights);
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.support[v].dim != 2) continue;
      QuadRelocator::Derivatives d;
      REQUIRE(relocator.derivatives(v, d));
      const Point<2> x = mesh.points[v];
      for (int axis = 0; axis < 2; ++axis) {
        double E[2];
        for (int side = 0; side < 2; ++side) {
          mesh.points[v] = x;
          mesh.points[v][axis] += side == 0 ? -1e-6 : 1e-6;
          relocator.measure_all(relocator.weights());
          E[side] = relocator.total_energy();
        }
        mesh.points[v] = x;
        relocator.measure_all(relocator.weights());
        CHECK((E[1] - E[0]) / 2e-6 == Approx(d.gradient[axis]).epsilon(1e-4).margin(1e-4));
      }
    }
  }
}

TEST_CASE("another weight of alignment gives the energies that measuring everything with it gives") {
  auto mesh = make_grid<2>({6, 6}, Point<2>(0, 0), Point<2>(1, 1));
  shake(mesh, 0.4, 6);
  const char* text = "h1 = 0.1; h2 = 0.05 + 0.4*x; theta = 0.4 + x";
  auto metric = background(mesh, text);
  QuadRelocator relocator(mesh, metric, {.alignment = 0.1}), other(mesh, metric, {.alignment = 0.7});
  REQUIRE(relocator.total_energy() < 0.99 * other.total_energy());
  relocator.set_alignment(0.7);
  for (CellId c = 0; c < mesh.cell_count(); ++c) CHECK(relocator.energy(c) == other.energy(c));
  CHECK(relocator.misalignment() == Approx(measure(mesh, *MetricField<2>::from_formula(text)).misalignment).epsilon(0.05));
}

TEST_CASE("a mesh along an isotropic metric has no misalignment") {
  auto mesh = make_grid<2>({3, 3}, Point<2>(0, 0), Point<2>(1, 1));
  auto metric = background(mesh, "h = 0.2 + x");
  CHECK(QuadRelocator(mesh, metric, {}).misalignment() == 0.0);
}

namespace {

Background of_formula(const char* text) { return {*MetricField<2>::from_formula(text), Point<2>(-1, -1), Point<2>(1, 1)}; }

struct Ends {
  Point<2> p, q;
};
/// Edges of about unit length in the metric, anywhere in [-.9, .9]^2.
std::vector<Ends> some_edges(const MetricField<2>& field, int count) {
  std::mt19937 random(17);
  const auto any = [&] { return random() / 2147483648.0 - 1.0; };
  std::vector<Ends> edges;
  while (static_cast<int>(edges.size()) < count) {
    const Point<2> p(0.9 * any(), 0.9 * any());
    Point<2> e(any(), any());
    e *= (0.8 + 0.2 * any()) / std::sqrt(dot(field.evaluate(p), e, e));
    const Point<2> q = p + e;
    if (q.cwiseAbs().maxCoeff() < 0.9) edges.push_back({p, q});
  }
  return edges;
}

const char* const kVarying[] = {"h = 0.05 + 0.1*abs(x)", "h1 = 0.05 + 0.1*y^2; h2 = 0.1*exp(x); theta = x + 2*y",
                                "theta = atan2(y, x); r = sqrt(x^2 + y^2); h1 = r/30 + abs(0.5 - r)/2; h2 = r/15 + abs(0.5 - r)/2",
                                "h = if(x < 0.1, 0.05, 0.2)"};

}  // namespace

namespace {

template <class R>
void compare_lanes(const char* text) {
  constexpr int n = kWidth<R>;
  auto metric = of_formula(text);
  const auto edges = some_edges(*MetricField<2>::from_formula(text), 200);
  for (std::size_t i = 0; i + n <= edges.size(); i += n) {
    R px{}, py{}, ex{}, ey{};
    JetOf<R> P{}, Q{};
    std::array<EdgeTerm, n> alone;
    for (int k = 0; k < n; ++k) {
      const auto& [p, q] = edges[i + k];
      const auto A = jet_of(metric.jet(p)), B = jet_of(metric.jet(q));
      px[k] = p[0], py[k] = p[1], ex[k] = q[0] - p[0], ey[k] = q[1] - p[1];
      const auto set = [k](JetOf<R>& to, const JetOf<double>& j) {
        to.a[k] = j.a, to.b[k] = j.b, to.c[k] = j.c, to.ax[k] = j.ax, to.bx[k] = j.bx, to.cx[k] = j.cx;
        to.ay[k] = j.ay, to.by[k] = j.by, to.cy[k] = j.cy;
      };
      set(P, A), set(Q, B);
      alone[k] = edge_term<double>(metric, kNone, 1.0, px[k], py[k], ex[k], ey[k], A, B);
    }
    const auto together = edge_term<R>(metric, kNone, 1.0, px, py, ex, ey, P, Q);
    for (int k = 0; k < n; ++k) {
      REQUIRE((together.l[k] == alone[k].l && together.s[k] == alone[k].s));
      REQUIRE((together.g11[k] == alone[k].g11 && together.g12[k] == alone[k].g12 && together.g22[k] == alone[k].g22));
    }
  }
}

}  // namespace

TEST_CASE("edges in lanes are measured as each alone, to the bit") {
  for (const char* text : kVarying) {
    INFO(text);
    compare_lanes<Pair>(text);
    compare_lanes<Four>(text);
  }
}

TEST_CASE("where an edge was looked up before makes no difference, and lanes that do not count are not looked up") {
  for (const char* text : kVarying) {
    INFO(text);
    auto metric = of_formula(text);
    EdgeHints<4> hints(kNone);
    int looked_up = 0;
    for (const auto& [p, q] : some_edges(*MetricField<2>::from_formula(text), 300)) {
      const auto P = jet_of(metric.jet(p)), Q = jet_of(metric.jet(q));
      const Point<2> e = q - p;
      const auto four = [](const JetOf<double>& j) {
        return JetOf<Four>{same<Four>(j.a),  same<Four>(j.b),  same<Four>(j.c),  same<Four>(j.ax), same<Four>(j.bx),
                           same<Four>(j.cx), same<Four>(j.ay), same<Four>(j.by), same<Four>(j.cy)};
      };
      const EdgeTerm alone = edge_term(metric, kNone, 0.5, p[0], p[1], e[0], e[1], P, Q);
      const std::array<Index, 8> before = hints;
      const auto found = edge_term<Four>(EdgeLookup{metric, hints.data(), 3}, 0.5, same<Four>(p[0]), same<Four>(p[1]),
                                         same<Four>(e[0]), same<Four>(e[1]), four(P), four(Q));
      for (int k = 0; k < 3; ++k) REQUIRE((found.l[k] == alone.l && found.s[k] == alone.s && found.g12[k] == alone.g12));
      looked_up += before != hints ? 1 : 0;
    }
    CHECK(hints[6] == kNone);
    CHECK(hints[7] == kNone);
    CHECK(looked_up > 0);
  }
}

TEST_CASE("lengths told from the ends of an edge are near the integral, at kinks and jumps of the metric too") {
  for (const char* text : kVarying) {
    INFO(text);
    auto metric = of_formula(text);
    const auto field = *MetricField<2>::from_formula(text);
    double sum = 0.0, most = 0.0;
    for (const auto& [p, q] : some_edges(field, 1000)) {
      const Point<2> e = q - p;
      const double l = edge_term(metric, kNone, 0.5, p[0], p[1], e[0], e[1], jet_of(metric.jet(p)), jet_of(metric.jet(q))).l;
      const double off = std::abs(l / edge_length(field, p, q) - 1.0);
      sum += off;
      most = std::max(most, off);
    }
    CHECK(sum / 1000 < 0.01);
    if (std::string_view(text).find("if") == std::string_view::npos) CHECK(most < 0.08);
  }
}

TEST_CASE("slopes of an edge's length and misalignment agree with finite differences where the metric is smooth") {
  const char* text = kVarying[1];
  Background metric(*MetricField<2>::from_formula(text), Point<2>(-1, -1), Point<2>(1, 1), {.tolerance = 1e-5, .smallest = 0.01});
  const EnergyWeights weights{.alignment = 0.5, .rough = 0.5};
  double worst = 0.0, sum = 0.0;  // the change of the metric is told from the ends as well
  for (const auto& [p, q] : some_edges(*MetricField<2>::from_formula(text), 200)) {
    const auto term = [&](const Point<2>& x) {
      return edge_term(metric, kNone, weights.rough, x[0], x[1], q[0] - x[0], q[1] - x[1], jet_of(metric.jet(x)), jet_of(metric.jet(q)));
    };
    const EdgeTerm here = term(p);
    const EdgeSlope d = edge_slope(metric, kNone, weights, p[0], p[1], q[0] - p[0], q[1] - p[1], here, jet_of(metric.jet(p)),
                                   jet_of(metric.jet(q)));
    for (int axis = 0; axis < 2; ++axis) {
      Point<2> step = Point<2>::Zero();
      step[axis] = 1e-5;
      const EdgeTerm up = term(p + step), down = term(p - step);
      const double size = 1.0 / (q - p).norm();
      for (const double off : {(up.l - down.l) / 2e-5 / here.l - (axis == 0 ? d.lx : d.ly),
                               (up.s - down.s) / 2e-5 - (axis == 0 ? d.sx : d.sy)}) {
        worst = std::max(worst, std::abs(off) / size);
        sum += std::abs(off) / size;
      }
    }
  }
  CHECK(sum / 800 < 0.01);
  CHECK(worst < 0.1);
}

TEST_CASE("moves lower the energy that they say they lower, and invert nothing") {
  for (const auto& [name, initial] : corpus::meshes<2>()) {
    INFO(name);
    Mesh<2> mesh = initial;
    auto metric = background(mesh, "h1 = 0.05 + 0.1*abs(x); h2 = 0.2; theta = y");
    QuadRelocator relocator(mesh, metric, {.alignment = 0.5, .shape = 1.0});
    double energy = relocator.total_energy();
    for (int sweep = 0; sweep < 3; ++sweep)
      for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
        const double gain = relocator.relocate(v);
        const double now = relocator.total_energy();
        REQUIRE(gain >= 0.0);
        REQUIRE(energy - now == Approx(gain).margin(1e-7 * (1 + energy)));
        energy = now;
      }
    const double cached = relocator.total_energy();
    relocator.measure_all(relocator.weights());
    CHECK(relocator.total_energy() == Approx(cached));
    const Status valid = validate(mesh);
    INFO(valid.message);
    CHECK(valid.ok());
  }
}

TEST_CASE("moves since the beginning are taken back to the bit, but for those that were for good") {
  auto mesh = make_grid<2>({8, 8}, Point<2>(0, 0), Point<2>(1, 1));
  shake(mesh, 0.3, 23);
  auto metric = background(mesh, "h1 = 0.1 + 0.1*x; h2 = 0.08; theta = y");
  QuadRelocator relocator(mesh, metric, {.alignment = 0.3});
  const auto sweep = [&] {
    double gain = 0.0;
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) gain += relocator.relocate(v);
    return gain;
  };
  const double before = relocator.total_energy();
  relocator.begin_for_good();
  const double gain = sweep();
  CHECK(gain > 0.01);
  CHECK(relocator.change() == 0.0);
  relocator.undo();
  const double between = relocator.total_energy();
  CHECK(between == Approx(before - gain));

  relocator.begin();
  const auto points = mesh.points;
  const double more = sweep();
  CHECK(more > 0.0);
  CHECK(relocator.change() == Approx(-more));
  relocator.undo();
  mesh.points = points;
  CHECK(relocator.total_energy() == between);
}

TEST_CASE("descent spreads rows over the whole mesh where sweeps hardly begin to") {
  // 60 columns of equal width for a size that grows threefold.
  const auto initial = make_grid<2>({60, 3}, Point<2>(0, 0), Point<2>(1, 0.05));
  const char* text = "h1 = 0.01*(1 + 2*x); h2 = 0.0166";
  const auto relaxed = [&](int sweeps, int iterations) {
    Mesh<2> mesh = initial;
    auto metric = background(mesh, text);
    QuadRelocator relocator(mesh, metric, {});
    relocator.rest = 1e-12;
    for (int i = 0; i < sweeps; ++i)
      for (VertexId v = 0; v < mesh.vertex_count(); ++v) relocator.relocate(v);
    QuadDescent descent(mesh, relocator);
    for (int i = 0; i < iterations; ++i) descent.iterate();
    CHECK(validate(mesh).ok());
    return relocator.total_energy();
  };
  CHECK(relaxed(0, 100) < 0.2 * relaxed(100, 0));
}

TEST_CASE("descent that is begun anew goes down where the mesh was changed meanwhile") {
  Mesh<2> mesh = make_grid<2>({12, 12}, Point<2>(0, 0), Point<2>(1, 1));
  auto metric = background(mesh, "h = 1/12");
  QuadRelocator relocator(mesh, metric, {});
  QuadDescent descent(mesh, relocator);
  shake(mesh, 0.1, 8);
  relocator.measure_all(relocator.weights());
  for (int i = 0; i < 60; ++i) descent.iterate();
  shake(mesh, 0.3, 9);
  relocator.measure_all(relocator.weights());
  const double shaken = relocator.total_energy();
  descent.restart();
  CHECK(descent.iterate() > 0.1 * shaken);
  for (int i = 0; i < 60; ++i) descent.iterate();
  CHECK(relocator.total_energy() < 1e-6 * shaken);
}

}  // namespace quad_relocate_test
