#include <array>
#include <cmath>
#include <cstdint>

#include "pillowmesh/mesh/wide.h"
#include "pillowmesh/metric/branchless.h"
#include "pillowmesh/metric/operations.h"
#include "pillowmesh/metric/program.h"

namespace pillowmesh {
namespace {

// Lanes are processed in groups of this many, so that the loops have no remainder.
constexpr int kGroup = 8;

template <class F>
PILLOWMESH_LANES void map(double* __restrict out, const double* a, int n, F f) {
  for (int i = 0; i < n; i += kGroup) {
    for (int k = 0; k < kGroup; ++k) out[i + k] = f(a[i + k]);
  }
}

template <class F>
PILLOWMESH_LANES void map(double* __restrict out, const double* a, const double* b, int n, F f) {
  for (int i = 0; i < n; i += kGroup) {
    for (int k = 0; k < kGroup; ++k) out[i + k] = f(a[i + k], b[i + k]);
  }
}

template <class F>
PILLOWMESH_LANES void map(double* __restrict out, const double* a, const double* b, const double* c, int n, F f) {
  for (int i = 0; i < n; i += kGroup) {
    for (int k = 0; k < kGroup; ++k) out[i + k] = f(a[i + k], b[i + k], c[i + k]);
  }
}

/// f of a and b, and then c.
template <class F>
PILLOWMESH_LANES void map_pair(double* __restrict out, const double* a, const double* b, const double* c, int n, Op then,
                               bool second, F f) {
  if (then == Op::add) return map(out, a, b, c, n, [f](double u, double v, double w) { return f(u, v) + w; });
  if (then == Op::multiply) return map(out, a, b, c, n, [f](double u, double v, double w) { return f(u, v) * w; });
  if (then == Op::subtract) {
    if (second) return map(out, a, b, c, n, [f](double u, double v, double w) { return w - f(u, v); });
    return map(out, a, b, c, n, [f](double u, double v, double w) { return f(u, v) - w; });
  }
  if (second) return map(out, a, b, c, n, [f](double u, double v, double w) { return w / f(u, v); });
  map(out, a, b, c, n, [f](double u, double v, double w) { return f(u, v) / w; });
}

#if defined(__wasm__)
void map_exponential(double* out, const double* a, int n) {
  map(out, a, n, portable::exp);
}
template <class F, class Exact>
void map_turns(double* out, const double* a, int n, F, Exact exact) {
  map(out, a, n, exact);  // two numbers at a time are not worth the size of the loops
}
#else
// The table of musl's exp (core/third_party/musl_math/exp_data.h): powers of 2^(1/128), and what each lacks.
extern "C" {
extern const struct ExponentialTable {
  double per_power, to_whole, power_high, power_low, c[4], unused[6];
  std::uint64_t powers[256];
} pm__exp_data;
}

// Whether ordinary_exp is not for x.
bool not_ordinary(double x) {
  const double size = x < 0.0 ? -x : x;
  return !((size >= 0x1p-54) & (size < 512.0));
}

// e^x, bit for bit what musl's function gives where it has no branch to take.
// After Arm's optimized routines, exp.c: Copyright (c) 2018, Arm Limited. SPDX-License-Identifier: MIT
PILLOWMESH_LANES double ordinary_exp(double x) {
  const ExponentialTable& t = pm__exp_data;
  const double shifted = t.to_whole + x * t.per_power, k = shifted - t.to_whole;
  const double r = x + k * t.power_high + k * t.power_low, z = r * r;
  const std::uint64_t n = __builtin_bit_cast(std::uint64_t, shifted);
  const double tail = __builtin_bit_cast(double, t.powers[2 * (n % 128)]);
  const double scale = __builtin_bit_cast(double, t.powers[2 * (n % 128) + 1] + (n << 45));
  return scale + scale * (tail + r + z * (t.c[0] + r * t.c[1]) + z * z * (t.c[2] + r * t.c[3]));
}

PILLOWMESH_LANES void map_exponential(double* __restrict out, const double* a, int n) {
  for (int i = 0; i < n; i += kGroup) {
    std::array<double, kGroup> x;
    double doubts = 0.0;
    for (int k = 0; k < kGroup; ++k) {
      x[k] = a[i + k];
      out[i + k] = ordinary_exp(x[k]);
      doubts += not_ordinary(x[k]) ? 1.0 : 0.0;
    }
    if (doubts == 0.0) continue;
    for (int k = 0; k < kGroup; ++k)
      if (not_ordinary(x[k])) out[i + k] = portable::exp(x[k]);
  }
}
/// f of quarter turns; where those are doubtful `exact`, of the number.
template <class F, class Exact>
PILLOWMESH_LANES void map_turns(double* out, const double* a, int n, F f, Exact exact) {
  for (int i = 0; i < n; i += kGroup) {
    std::array<double, kGroup> x, y, doubt;
    for (int k = 0; k < kGroup; ++k) {
      x[k] = a[i + k];
      const branchless::QuarterTurns t = branchless::quarter_turns(x[k]);
      y[k] = f(t);
      doubt[k] = t.doubtful ? 1.0 : 0.0;
    }
    for (int k = 0; k < kGroup; ++k) out[i + k] = y[k];
    double doubts = 0.0;
    for (int k = 0; k < kGroup; ++k) doubts += doubt[k];
    if (doubts == 0.0) continue;
    for (int k = 0; k < kGroup; ++k)
      if (doubt[k] != 0.0) out[i + k] = exact(x[k]);
  }
}
#endif

int count_true(const double* a, int n) {
  int count = 0;
  for (int i = 0; i < n; ++i) count += a[i] != 0.0 ? 1 : 0;
  return count;
}

}  // namespace

void Program::run(const Lanes* coordinates, int count, std::span<Lanes> results) const {
#if defined(PILLOWMESH_WIDE)
  if (kWidest) return run_widest(coordinates, count, results);
  if (kWide) return run_wide(coordinates, count, results);
#endif
  run_code(coordinates, count, results);
}

#if defined(PILLOWMESH_WIDE)
PILLOWMESH_WIDE void Program::run_wide(const Lanes* coordinates, int count, std::span<Lanes> results) const {
  run_code(coordinates, count, results);
}
PILLOWMESH_WIDEST void Program::run_widest(const Lanes* coordinates, int count, std::span<Lanes> results) const {
  run_code(coordinates, count, results);
}
#endif

PILLOWMESH_LANES void Program::run_code(const Lanes* coordinates, int count, std::span<Lanes> results) const {
  alignas(64) double registers[kMaxRegisters * kLanes];
  const int n = (count + kGroup - 1) / kGroup * kGroup;
  for (int axis = 0; axis < axes_; ++axis) {
    double* r = registers + axis * kLanes;
    for (int i = 0; i < count; ++i) r[i] = coordinates[axis][i];
    // Repeating a point keeps the batch of one mind about every `if`.
    for (int i = count; i < n; ++i) r[i] = r[count - 1];
  }
  const auto lanes = [&](int index) -> const double* {
    return index >= 0 ? registers + index * kLanes : constants_[~index].data();
  };

  using namespace operations;
  const auto end = static_cast<int>(code_.size());
  for (int line = 0; line < end; ++line) {
    const Instruction& i = code_[line];
    const double* a = lanes(i.a);
    const double* b = lanes(i.b);
    double* out = registers + i.out * kLanes;
    if (i.then != Op::constant) {
      const double* c = lanes(i.c);
      if (i.op == Op::add) {
        map_pair(out, a, b, c, n, i.then, i.second, [](double u, double v) { return u + v; });
      } else if (i.op == Op::subtract) {
        map_pair(out, a, b, c, n, i.then, i.second, [](double u, double v) { return u - v; });
      } else if (i.op == Op::multiply) {
        map_pair(out, a, b, c, n, i.then, i.second, [](double u, double v) { return u * v; });
      } else {
        map_pair(out, a, b, c, n, i.then, i.second, [](double u, double v) { return u / v; });
      }
      continue;
    }
    switch (i.op) {
      case Op::add:
        map(out, a, b, n, [](double u, double v) { return u + v; });
        break;
      case Op::subtract:
        map(out, a, b, n, [](double u, double v) { return u - v; });
        break;
      case Op::multiply:
        map(out, a, b, n, [](double u, double v) { return u * v; });
        break;
      case Op::divide:
        map(out, a, b, n, [](double u, double v) { return u / v; });
        break;
      case Op::negate:
        map(out, a, n, [](double u) { return -u; });
        break;
      case Op::power:
        map(out, a, b, n, portable::pow);
        break;
      case Op::square_root:
        map(out, a, n, [](double u) { return std::sqrt(u); });
        break;
      case Op::exponential:
        map_exponential(out, a, n);
        break;
      case Op::logarithm:
        map(out, a, n, branchless::log);
        break;
      case Op::sine:
        map_turns(out, a, n, [](const branchless::QuarterTurns& t) { return branchless::sin(t); }, portable::sin);
        break;
      case Op::cosine:
        map_turns(out, a, n, [](const branchless::QuarterTurns& t) { return branchless::cos(t); }, portable::cos);
        break;
      case Op::tangent:
        map(out, a, n, portable::tan);
        break;
      case Op::arc_sine:
        map(out, a, n, portable::asin);
        break;
      case Op::arc_cosine:
        map(out, a, n, portable::acos);
        break;
      case Op::arc_tangent:
        map(out, a, n, portable::atan);
        break;
      case Op::arc_tangent_2:
        map(out, a, b, n, portable::atan2);
        break;
      case Op::hyperbolic_tangent:
        map(out, a, n, branchless::tanh);
        break;
      case Op::absolute:
        map(out, a, n, [](double u) { return std::fabs(u); });
        break;
      case Op::minimum:
        map(out, a, b, n, minimum);
        break;
      case Op::maximum:
        map(out, a, b, n, maximum);
        break;
      case Op::floor:
        map(out, a, n, portable::floor);
        break;
      case Op::less:
        map(out, a, b, n, [](double u, double v) { return truth(u < v); });
        break;
      case Op::less_or_equal:
        map(out, a, b, n, [](double u, double v) { return truth(u <= v); });
        break;
      case Op::equal:
        map(out, a, b, n, [](double u, double v) { return truth(u == v); });
        break;
      case Op::not_equal:
        map(out, a, b, n, [](double u, double v) { return truth(u != v); });
        break;
      case Op::cosine_of_arc:
        map(out, a, b, n, cosine_of_arc);
        break;
      case Op::sine_of_arc:
        map(out, a, b, n, sine_of_arc);
        break;
      case Op::size_to_metric:
        map(out, a, n, size_to_metric);
        break;
      case Op::select: {
        // Of one mind, the other side may have been jumped over: do not even read it.
        const double* c = lanes(i.c);
        const int yes = count_true(a, n);
        if (yes == 0 || yes == n) {
          map(out, yes == n ? b : c, n, [](double u) { return u; });
        } else {
          for (int k = 0; k < n; ++k) out[k] = a[k] != 0.0 ? b[k] : c[k];
        }
        break;
      }
      case Op::skip_if_none:
        if (count_true(a, n) == 0) line += i.c;
        break;
      case Op::skip_if_all:
        if (count_true(a, n) == n) line += i.c;
        break;
      case Op::constant:
      case Op::variable:
        break;
    }
  }
  for (std::size_t k = 0; k < outputs_.size(); ++k) {
    const double* from = lanes(outputs_[k]);
    for (int i = 0; i < n; ++i) results[k][i] = from[i];
  }
}

}  // namespace pillowmesh
