// Stands in for musl's internal libm.h: double precision only, every choice that musl leaves to the target pinned, and
// every symbol renamed to pm_* so that nothing clashes with the system's libm. See README.md.
#ifndef PM_LIBM_H
#define PM_LIBM_H

#include <stdint.h>

// The same arithmetic on every target: no fused multiply-add, no excess precision, no rounding instructions.
#define PM_USE_FMA 0
#define TOINT_INTRINSICS 0
#undef FLT_EVAL_METHOD
#define FLT_EVAL_METHOD 0
#define double_t double
#define WANT_ROUNDING 1
#define DBL_EPSILON 2.22044604925031308085e-16
#undef INFINITY
#define INFINITY __builtin_inff()

#define isnan(x) __builtin_isnan(x)
#define fabs(x) __builtin_fabs(x)
#define sqrt(x) __builtin_sqrt(x)
#define issignaling_inline(x) 0
#define predict_true(x) __builtin_expect(!!(x), 1)
#define predict_false(x) __builtin_expect(x, 0)
#define hidden __attribute__((__visibility__("hidden")))

#define exp pm_exp
#define log pm_log
#define pow pm_pow
#define sin pm_sin
#define cos pm_cos
#define tan pm_tan
#define atan pm_atan
#define atan2 pm_atan2
#define asin pm_asin
#define acos pm_acos
#define floor pm_floor
#define scalbn pm_scalbn
#define __sin pm__sin
#define __cos pm__cos
#define __tan pm__tan
#define __rem_pio2 pm__rem_pio2
#define __rem_pio2_large pm__rem_pio2_large
#define __math_invalid pm__math_invalid
#define __math_oflow pm__math_oflow
#define __math_uflow pm__math_uflow
#define __math_xflow pm__math_xflow
#define __math_divzero pm__math_divzero
#define __exp_data pm__exp_data
#define __log_data pm__log_data
#define __pow_log_data pm__pow_log_data

double exp(double), log(double), pow(double, double), sin(double), cos(double), tan(double), atan(double);
double atan2(double, double), asin(double), acos(double), tanh(double), expm1(double), floor(double);
hidden double scalbn(double, int);
hidden int __rem_pio2_large(double*, double*, int, int, int);
hidden int __rem_pio2(double, double*);
hidden double __sin(double, double, int);
hidden double __cos(double, double);
hidden double __tan(double, double, int);
hidden double __math_xflow(uint32_t, double);
hidden double __math_uflow(uint32_t);
hidden double __math_oflow(uint32_t);
hidden double __math_divzero(uint32_t);
hidden double __math_invalid(double);

static inline double eval_as_double(double x) { return x; }
static inline double fp_barrier(double x) {
  volatile double y = x;
  return y;
}
// Floating-point exceptions are of no interest here.
#define FORCE_EVAL(x) ((void)(x))
#define fp_force_eval(x) ((void)(x))

#define asuint64(f) ((union { double _f; uint64_t _i; }){f})._i
#define asdouble(i) ((union { uint64_t _i; double _f; }){i})._f
#define EXTRACT_WORDS(hi, lo, d)  \
  do {                            \
    uint64_t __u = asuint64(d);   \
    (hi) = __u >> 32;             \
    (lo) = (uint32_t)__u;         \
  } while (0)
#define GET_HIGH_WORD(hi, d) ((hi) = asuint64(d) >> 32)
#define GET_LOW_WORD(lo, d) ((lo) = (uint32_t)asuint64(d))
#define INSERT_WORDS(d, hi, lo) ((d) = asdouble(((uint64_t)(hi) << 32) | (uint32_t)(lo)))
#define SET_HIGH_WORD(d, hi) INSERT_WORDS(d, hi, (uint32_t)asuint64(d))
#define SET_LOW_WORD(d, lo) INSERT_WORDS(d, asuint64(d) >> 32, lo)

#endif
