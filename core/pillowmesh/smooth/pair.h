// Two numbers at a time, in one register where the machine has those. Each lane is computed as a double alone would be, so
// that results do not depend on whether two things were computed together.
#pragma once

#include <cmath>

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace pillowmesh {

#if defined(__GNUC__) || defined(__clang__)
typedef double Pair __attribute__((vector_size(16)));
#else
struct Pair {
  double v[2];
  double& operator[](int i) { return v[i]; }
  double operator[](int i) const { return v[i]; }
  friend Pair operator+(Pair a, Pair b) { return {{a.v[0] + b.v[0], a.v[1] + b.v[1]}}; }
  friend Pair operator-(Pair a, Pair b) { return {{a.v[0] - b.v[0], a.v[1] - b.v[1]}}; }
  friend Pair operator*(Pair a, Pair b) { return {{a.v[0] * b.v[0], a.v[1] * b.v[1]}}; }
  friend Pair operator/(Pair a, Pair b) { return {{a.v[0] / b.v[0], a.v[1] / b.v[1]}}; }
  friend Pair operator*(double a, Pair b) { return {{a * b.v[0], a * b.v[1]}}; }
  friend Pair operator-(Pair a) { return {{-a.v[0], -a.v[1]}}; }
};
#endif

inline Pair pair_of(double a, double b) { return Pair{a, b}; }
/// p[0] and p[1]; need not be aligned.
inline Pair load(const double* p) { return Pair{p[0], p[1]}; }
inline void store(double* p, const Pair& a) { p[0] = a[0], p[1] = a[1]; }

// What formulas written for one number or for two need besides + - * /.
inline double root(double a) { return std::sqrt(a); }
inline double larger(double a, double b) { return a > b ? a : b; }
template <class R>
R same(double a);
template <>
inline double same<double>(double a) { return a; }
template <>
inline Pair same<Pair>(double a) { return Pair{a, a}; }
#if defined(__SSE2__)
inline Pair root(Pair a) { return Pair(_mm_sqrt_pd(__m128d(a))); }
inline Pair larger(Pair a, Pair b) { return Pair(_mm_max_pd(__m128d(a), __m128d(b))); }  // as a > b ? a : b
#elif defined(__wasm_simd128__)
inline Pair root(Pair a) { return Pair(wasm_f64x2_sqrt(v128_t(a))); }
inline Pair larger(Pair a, Pair b) { return Pair(wasm_f64x2_pmax(v128_t(b), v128_t(a))); }  // b < a ? a : b
#else
inline Pair root(Pair a) { return Pair{std::sqrt(a[0]), std::sqrt(a[1])}; }
inline Pair larger(Pair a, Pair b) { return Pair{larger(a[0], b[0]), larger(a[1], b[1])}; }
#endif

}  // namespace pillowmesh
