// Two or four numbers at a time, in one register. Each lane is computed as a double alone would be, so that results depend
// neither on what was computed together nor on the registers.
#pragma once

#include <cmath>
#include <cstring>

#include "pillowmesh/mesh/wide.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace pillowmesh {

#if defined(__GNUC__) || defined(__clang__)
typedef double Pair __attribute__((vector_size(16)));
typedef double Four __attribute__((vector_size(32)));
#else
template <int N>
struct Lanes {
  double v[N];
  double& operator[](int i) { return v[i]; }
  double operator[](int i) const { return v[i]; }
  template <class F>
  static Lanes each(F f) {
    Lanes r;
    for (int i = 0; i < N; ++i) r.v[i] = f(i);
    return r;
  }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return each([&](int i) { return a.v[i] + b.v[i]; }); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return each([&](int i) { return a.v[i] - b.v[i]; }); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return each([&](int i) { return a.v[i] * b.v[i]; }); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return each([&](int i) { return a.v[i] / b.v[i]; }); }
  friend Lanes operator-(const Lanes& a) { return each([&](int i) { return -a.v[i]; }); }
  friend Lanes operator-(double a, const Lanes& b) { return each([&](int i) { return a - b.v[i]; }); }
  friend Lanes operator*(double a, const Lanes& b) { return each([&](int i) { return a * b.v[i]; }); }
  friend Lanes operator/(double a, const Lanes& b) { return each([&](int i) { return a / b.v[i]; }); }
  friend Lanes operator-(const Lanes& a, double b) { return each([&](int i) { return a.v[i] - b; }); }
};
using Pair = Lanes<2>;
using Four = Lanes<4>;
#endif

template <class R>
inline constexpr int kWidth = sizeof(R) / sizeof(double);

/// p[0], p[1] and so on; need not be aligned.
template <class R>
PILLOWMESH_LANES R load(const double* p) {
  R a;
  std::memcpy(&a, p, sizeof a);
  return a;
}
template <class R>
PILLOWMESH_LANES void store(double* p, const R& a) {
  std::memcpy(p, &a, sizeof a);
}
/// p[0], p[1], and where there are four p[1], p[2]: of things with two ends, each of which shares one with the next.
template <class R>
R ends(const double* p);
template <>
PILLOWMESH_LANES Pair ends<Pair>(const double* p) {
  return load<Pair>(p);
}
template <>
PILLOWMESH_LANES Four ends<Four>(const double* p) {
  return Four{p[0], p[1], p[1], p[2]};
}

// What formulas written for one number or for several need besides + - * /.
template <class R>
R same(double a);
template <>
PILLOWMESH_LANES double same<double>(double a) {
  return a;
}
template <>
PILLOWMESH_LANES Pair same<Pair>(double a) {
  return Pair{a, a};
}
template <>
PILLOWMESH_LANES Four same<Four>(double a) {
  return Four{a, a, a, a};
}
inline double root(double a) { return std::sqrt(a); }
inline double larger(double a, double b) { return a > b ? a : b; }
#if defined(__SSE2__)
PILLOWMESH_LANES Pair root(const Pair& a) { return Pair(_mm_sqrt_pd(__m128d(a))); }
PILLOWMESH_LANES Pair larger(const Pair& a, const Pair& b) { return Pair(_mm_max_pd(__m128d(a), __m128d(b))); }  // as above
#elif defined(__wasm_simd128__)
PILLOWMESH_LANES Pair root(const Pair& a) { return Pair(wasm_f64x2_sqrt(v128_t(a))); }
PILLOWMESH_LANES Pair larger(const Pair& a, const Pair& b) { return Pair(wasm_f64x2_pmax(v128_t(b), v128_t(a))); }  // b < a ? a : b
#else
PILLOWMESH_LANES Pair root(const Pair& a) { return Pair{std::sqrt(a[0]), std::sqrt(a[1])}; }
PILLOWMESH_LANES Pair larger(const Pair& a, const Pair& b) { return Pair{larger(a[0], b[0]), larger(a[1], b[1])}; }
#endif
PILLOWMESH_LANES Four root(const Four& a) { return Four{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])}; }
#if defined(__GNUC__) || defined(__clang__)
PILLOWMESH_LANES Four larger(const Four& a, const Four& b) { return a > b ? a : b; }
#else
PILLOWMESH_LANES Four larger(const Four& a, const Four& b) {
  return Four{larger(a[0], b[0]), larger(a[1], b[1]), larger(a[2], b[2]), larger(a[3], b[3])};
}
#endif

}  // namespace pillowmesh
