#include "pillowmesh/metric/expression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "../catch.h"
#include "pillowmesh/metric/program.h"

namespace expression_test {

using namespace pillowmesh;

namespace {

std::string error_of(std::string_view text, int dim = 2) {
  const Expected<Formula> formula = parse_formula(text, dim);
  if (formula) return "";
  CHECK(formula.status().code == StatusCode::usage);
  return formula.status().message;
}

Program compile(std::string_view text, int dim = 2) {
  Expected<Formula> formula = parse_formula(text, dim);
  INFO(text << ": " << formula.status().message);
  REQUIRE(formula);
  const NodeId output = formula->assignments.back().value;
  Expected<Program> program = Program::compile(formula->graph, std::span<const NodeId>(&output, 1));
  REQUIRE(program);
  return *program;
}

// The last assigned value at points of a 3D batch.
std::vector<double> values(std::string_view text, const std::vector<std::array<double, 3>>& points) {
  std::array<Lanes, 3> coordinates{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int d = 0; d < 3; ++d) coordinates[d][i] = points[i][d];
  }
  Lanes result;
  compile(text, 3).run(coordinates.data(), static_cast<int>(points.size()), std::span<Lanes>(&result, 1));
  return {result.begin(), result.begin() + static_cast<std::ptrdiff_t>(points.size())};
}

double value(std::string_view text, double x = 0.3, double y = 0.7, double z = -1.1) {
  return values(text, {{x, y, z}})[0];
}

}  // namespace

TEST_CASE("operators bind as in mathematics") {
  CHECK(value("a = 1 + 2*3 - 4/2") == 5.0);
  CHECK(value("a = 2 - 3 - 4") == -5.0);
  CHECK(value("a = 8/4/2") == 1.0);
  CHECK(value("a = 2^3^2") == 512.0);
  CHECK(value("a = -3^2") == -9.0);
  CHECK(value("a = 2^-2") == 0.25);
  CHECK(value("a = --x + +x", 0.5) == 1.0);
  CHECK(value("a = (1 + 2)*3") == 9.0);
  CHECK(value("a = 1 + 1 < 3") == 1.0);
  CHECK(value("a = 0.1e1 + .5 + 1.") == 2.5);
}

TEST_CASE("each function computes what its name says") {
  CHECK(value("a = sqrt(x)") == Approx(std::sqrt(0.3)));
  CHECK(value("a = exp(x)") == Approx(std::exp(0.3)));
  CHECK(value("a = log(x)") == Approx(std::log(0.3)));
  CHECK(value("a = sin(z)") == Approx(std::sin(-1.1)));
  CHECK(value("a = cos(z)") == Approx(std::cos(-1.1)));
  CHECK(value("a = tan(z)") == Approx(std::tan(-1.1)));
  CHECK(value("a = atan(z)") == Approx(std::atan(-1.1)));
  CHECK(value("a = atan2(y, z)") == Approx(std::atan2(0.7, -1.1)));
  CHECK(value("a = asin(x)") == Approx(std::asin(0.3)));
  CHECK(value("a = acos(x)") == Approx(std::acos(0.3)));
  CHECK(value("a = tanh(z)") == Approx(std::tanh(-1.1)));
  CHECK(value("a = abs(z)") == 1.1);
  CHECK(value("a = floor(z)") == -2.0);
  CHECK(value("a = min(x, y, z)") == -1.1);
  CHECK(value("a = max(z, y, x)") == 0.7);
  CHECK(value("a = pow(y, x)") == Approx(std::pow(0.7, 0.3)));
  CHECK(value("a = r") == Approx(std::sqrt(0.3 * 0.3 + 0.7 * 0.7 + 1.1 * 1.1)));
  CHECK(value("a = pi") == Approx(3.14159265358979));
}

TEST_CASE("comparisons give one or zero") {
  const std::vector<std::array<double, 3>> points{{1, 2, 0}, {2, 2, 0}, {3, 2, 0}};
  CHECK(values("a = x < y", points) == std::vector<double>{1, 0, 0});
  CHECK(values("a = x <= y", points) == std::vector<double>{1, 1, 0});
  CHECK(values("a = x > y", points) == std::vector<double>{0, 0, 1});
  CHECK(values("a = x >= y", points) == std::vector<double>{0, 1, 1});
  CHECK(values("a = x == y", points) == std::vector<double>{0, 1, 0});
  CHECK(values("a = x != y", points) == std::vector<double>{1, 0, 1});
}

TEST_CASE("rewritten powers and rotations keep their values") {
  for (const double x : {-1.7, -0.2, 0.4, 2.5}) {
    CAPTURE(x);
    CHECK(value("a = x^2", x) == x * x);
    CHECK(value("a = x^3", x) == Approx(x * x * x));
    CHECK(value("a = x^4", x) == Approx(x * x * x * x));
    CHECK(value("a = x^-1", x) == 1 / x);
    CHECK(value("a = x^-2", x) == Approx(1 / (x * x)));
    CHECK(value("a = abs(x)^0.5", x) == Approx(std::sqrt(std::fabs(x))));
    CHECK(value("a = 20^x", x) == Approx(std::pow(20.0, x)));
    CHECK(value("a = x^0", x) == 1.0);
    const double angle = std::atan2(0.7, x);
    CHECK(value("a = cos(atan2(y, x))", x) == Approx(std::cos(angle)));
    CHECK(value("a = sin(atan2(y, x))", x) == Approx(std::sin(angle)));
    CHECK(value("a = cos(atan2(y, x) + pi/2)", x) == Approx(-std::sin(angle)));
    CHECK(value("a = sin(pi/2 + atan2(y, x))", x) == Approx(std::cos(angle)));
    CHECK(value("a = cos(atan2(y, x) - pi/2)", x) == Approx(std::sin(angle)));
    CHECK(value("a = sin(atan2(y, x) - pi/2)", x) == Approx(-std::cos(angle)));
    CHECK(value("a = cos(pi/2 - atan2(y, x))", x) == Approx(std::sin(angle)));
    CHECK(value("a = sin(pi/2 - atan2(y, x))", x) == Approx(std::cos(angle)));
    CHECK(value("a = cos(-atan2(y, x))", x) == Approx(std::cos(angle)));
    CHECK(value("a = sin(-atan2(y, x))", x) == Approx(-std::sin(angle)));
  }
  CHECK(value("a = cos(atan2(x, y))", 0.0, 0.0) == 1.0);
  CHECK(value("a = sin(atan2(x, y))", 0.0, 0.0) == 0.0);
}

TEST_CASE("names may be reused by later statements and assigned again") {
  CHECK(value("a = 2; b = a*x; a = b + a;", 0.5) == 3.0);
  CHECK(value("r = 3; a = r") == 3.0);
}

TEST_CASE("arithmetic done two operations at a time has the bits of one after the other") {
  std::mt19937 random(7);
  const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
  // A formula, and what C++ makes of it.
  struct Made {
    std::string text;
    std::function<double(double, double)> f;
  };
  const std::function<Made(int)> make = [&](int depth) -> Made {
    if (depth == 0) {
      const int which = below(4);
      if (which == 0) return {"x", [](double x, double) { return x; }};
      if (which == 1) return {"y", [](double, double y) { return y; }};
      const double c = 0.25 * (1 + below(9)) + 0.1;
      std::ostringstream text;
      text.precision(17);
      text << c;
      return {text.str(), [c](double, double) { return c; }};
    }
    const Made a = make(below(depth)), b = make(below(depth));
    const std::string text = "(" + a.text + " " + std::string(1, "+-*/"[below(4)]) + " " + b.text + ")";
    const char op = text[1 + a.text.size() + 1];
    return {text, [a, b, op](double x, double y) {
              const double u = a.f(x, y), v = b.f(x, y);
              return op == '+' ? u + v : (op == '-' ? u - v : (op == '*' ? u * v : u / v));
            }};
  };
  for (int round = 0; round < 300; ++round) {
    const Made made = make(6);
    std::vector<std::array<double, 3>> points;
    for (int i = 0; i < 20; ++i) points.push_back({1.0 + 0.37 * i, 2.3 - 0.11 * i, 0});
    INFO(made.text);
    const std::vector<double> got = values("a = " + made.text, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double expected = made.f(points[i][0], points[i][1]);
      if (std::isfinite(expected)) CHECK(got[i] == expected);
    }
  }
}

TEST_CASE("two operations of arithmetic are one instruction where nobody else needs what is between them") {
  CHECK(compile("a = x*y + z", 3).code().size() == 1);
  CHECK(compile("a = (x + y)*(x - y)").code().size() == 2);
  CHECK(compile("b = x*y; a = (b + 1)*b").code().size() == 2);
  CHECK(compile("a = sin(x*y) + x").code().size() == 3);
  CHECK(value("b = x*x; a = (b + b)/b", 3.0) == 2.0);
  CHECK(value("a = if(x - y > 0, x*2 + 1, x*3 - 1)", 3.0, 1.0) == 7.0);
  CHECK(value("a = if(x - y > 0, x*2 + 1, x*3 - 1)", 1.0, 3.0) == 2.0);
}

TEST_CASE("as many values may be alive at once as without that") {
  std::string text, sum = "a = x";
  for (int i = 0; i < 100; ++i) {
    const std::string n = std::to_string(i + 1);
    text += "v" + n + " = sin(" + n + "*x) + cos(" + n + "*x);";
    sum += " + v" + n;
  }
  double expected = 0.4;
  for (int i = 1; i <= 100; ++i) expected += std::sin(i * 0.4) + std::cos(i * 0.4);
  CHECK(value(text + sum, 0.4) == Approx(expected));
}

TEST_CASE("constants are folded away") {
  CHECK(compile("a = sqrt(16) + sin(0) + if(1 < 2, 3, x)").code().empty());
  // x*x once, one addition: the common subexpression is computed once.
  CHECK(compile("a = x^2 + x*x").code().size() == 2);
  // r is not computed unless used.
  CHECK(compile("b = r; a = x + 1").code().size() == 1);
}

TEST_CASE("if takes each point's own side, and the other side cannot hurt") {
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i < 50; ++i) points.push_back({i * 0.1 - 2.0, 0, 0});
  // log of a negative number, and a nested if, on the side that is not taken.
  const std::vector<double> got = values("a = if(x > 0, log(x), if(x < -1, exp(x)*exp(x), sqrt(-x)*tan(x)))", points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i][0];
    const double wanted = x > 0 ? std::log(x) : x < -1 ? std::exp(2 * x) : std::sqrt(-x) * std::tan(x);
    CAPTURE(x);
    CHECK(got[i] == Approx(wanted).margin(1e-15));
  }
}

TEST_CASE("a batch of one mind gives the same bits as a batch of two minds") {
  const std::string text = "s = exp(sin(x)); a = if(x < 0, s*cos(x) + exp(y), if(y < 1, s + log(x + 3)*tan(x), s))";
  std::vector<std::array<double, 3>> mixed;
  for (int i = 0; i < 64; ++i) mixed.push_back({(i % 7) * 0.3 - 0.8, (i % 5) * 0.4, 0});
  const std::vector<double> together = values(text, mixed);
  for (std::size_t i = 0; i < mixed.size(); ++i) CHECK(values(text, {mixed[i]})[0] == together[i]);
}

TEST_CASE("a mistake is reported with its column") {
  CHECK(error_of("h = 0.1 + foo") == "column 11: unknown name 'foo'; known: x, y, r, pi");
  CHECK(error_of("s = 1; h = t") == "column 12: unknown name 't'; known: x, y, r, pi, s");
  CHECK(error_of("h = z") == "column 5: 'z' is not available: the mesh is two-dimensional");
  CHECK(error_of("h = 1 +").substr(0, 10) == "column 8: ");
  CHECK(error_of("h = (1").substr(0, 10) == "column 7: ");
  CHECK(error_of("h = 1 2") == "column 7: expected an operator or ';', found '2'");
  CHECK(error_of("h 1") == "column 3: expected '=' after 'h', found '1'");
  CHECK(error_of("h == 1").substr(0, 10) == "column 4: ");
  CHECK(error_of("x = 1") == "column 1: 'x' is given and cannot be assigned");
  CHECK(error_of("h=1; sin = 2") == "column 6: 'sin' is a function and cannot be assigned");
  CHECK(error_of("h = sin(1, 2)") == "column 5: 'sin' takes 1 argument, not 2");
  CHECK(error_of("h = if(1, 2)") == "column 5: 'if' takes 3 arguments, not 2");
  CHECK(error_of("h = min(1)") == "column 5: 'min' takes 2 or more arguments, not 1");
  CHECK(error_of("h = sinus(1)").substr(0, 35) == "column 5: unknown function 'sinus';");
  CHECK(error_of("h = 0 < x < 1").substr(0, 42) == "column 11: comparisons cannot be chained; ");
  CHECK(error_of("h = 1;\nh = $").substr(0, 11) == "column 12: ");
  CHECK(error_of("h = \xc3\xa4 + 1").find("found '\xc3\xa4'") != std::string::npos);
  CHECK(error_of("").substr(0, 9) == "column 1:");
  CHECK(error_of(" ; ").substr(0, 9) == "column 2:");
}

TEST_CASE("hostile formulas are refused, not crashed on") {
  CHECK(error_of("h = " + std::string(5000, '(')).find("nested too deeply") != std::string::npos);
  CHECK(error_of("h = " + std::string(5000, '-') + "1").find("nested too deeply") != std::string::npos);
  std::string power = "h = x";
  for (int i = 0; i < 3000; ++i) power += "^x";
  CHECK(error_of(power).find("nested too deeply") != std::string::npos);
  CHECK(error_of("h = 1;" + std::string(30000, ' ') + "h = 2").find("longer than") != std::string::npos);
}

TEST_CASE("a formula that keeps too many values alive is refused") {
  std::string text;
  std::string sum = "0";
  for (int i = 0; i < 300; ++i) {
    text += "a" + std::to_string(i) + " = sin(x + " + std::to_string(i) + ");";
    sum = "a" + std::to_string(i) + "*cos(" + sum + ")";
    if (i % 100 == 99) {
      text += "b" + std::to_string(i) + " = " + sum + ";";
      sum = "b" + std::to_string(i);
    }
  }
  Expected<Formula> formula = parse_formula(text, 2);
  REQUIRE(formula);
  std::vector<NodeId> outputs;
  for (const Formula::Assignment& a : formula->assignments) outputs.push_back(a.value);
  CHECK_FALSE(Program::compile(formula->graph, outputs));
}

}  // namespace expression_test
