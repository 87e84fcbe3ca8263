#include "pillowmesh/metric/derivative.h"

#include <cmath>
#include <random>

#include "../catch.h"
#include "pillowmesh/metric/expression.h"
#include "pillowmesh/metric/program.h"

namespace derivative_test {

using namespace pillowmesh;

namespace {

double value(const Graph& graph, NodeId node, double x, double y) {
  const std::array<NodeId, 1> outputs{node};
  const Program program = *Program::compile(graph, outputs);
  std::array<Lanes, 2> at;
  at[0][0] = x, at[1][0] = y;
  std::array<Lanes, 1> out;
  program.run(at.data(), 1, out);
  return out[0][0];
}

}  // namespace

TEST_CASE("derivatives of every function agree with differences") {
  for (const char* text : {"x*y - 3*x + y",
                           "(x + 2*y)/(1.1 + x*y)",
                           "-x^3*y",
                           "x^y",
                           "y^2.5",
                           "2^x",
                           "sqrt(x + y)",
                           "exp(x*y)",
                           "log(x + 2*y)",
                           "sin(3*x)*cos(y)",
                           "tan(x*y)",
                           "asin(x/2)",
                           "acos(y/3)",
                           "atan(x*y)",
                           "atan2(y, x)",
                           "tanh(5*(x - y))",
                           "abs(x - 2*y)",
                           "min(x, y^2)",
                           "max(x, y^2, 0.3)",
                           "if(x > y, x^2, y^3)",
                           "floor(x) + x",
                           "cos(atan2(y, x))",
                           "sin(atan2(x*x, y))",
                           "r^3",
                           "1/x^2"}) {
    Formula formula = *parse_formula(std::string("f = ") + text, 2);
    const NodeId f = formula.find("f")->value;
    const NodeId d[2] = {differentiate(formula.graph, f, 0), differentiate(formula.graph, f, 1)};
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(0.1, 0.9);
    for (int i = 0; i < 20; ++i) {
      const double x = any(random), y = any(random), h = 1e-6;
      INFO(text << " at " << x << ", " << y);
      const Graph& g = formula.graph;
      CHECK(value(g, d[0], x, y) ==
            Approx((value(g, f, x + h, y) - value(g, f, x - h, y)) / (2 * h)).epsilon(1e-6).margin(1e-7));
      CHECK(value(g, d[1], x, y) ==
            Approx((value(g, f, x, y + h) - value(g, f, x, y - h)) / (2 * h)).epsilon(1e-6).margin(1e-7));
    }
  }
}

TEST_CASE("what does not depend on a coordinate has the derivative zero, whatever it is") {
  Formula formula = *parse_formula("f = x + log(y - y)", 2);
  CHECK(value(formula.graph, differentiate(formula.graph, formula.find("f")->value, 0), 0.5, 0.5) == 1.0);
}

}  // namespace derivative_test
