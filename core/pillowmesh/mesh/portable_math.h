// Transcendental functions whose results have the same bits in the native and the WebAssembly build.
#pragma once

extern "C" {
double pm_exp(double);
double pm_log(double);
double pm_pow(double, double);
double pm_sin(double);
double pm_cos(double);
double pm_tan(double);
double pm_atan(double);
double pm_atan2(double, double);
double pm_asin(double);
double pm_acos(double);
double pm_floor(double);
}

/// Use these instead of <cmath> wherever a result can reach a mesh. + - * / and sqrt need no such care: IEEE 754 fixes
/// their bits. Source: core/third_party/musl_math. Accuracy: within 1 ulp.
namespace pillowmesh::portable {

inline double exp(double x) { return pm_exp(x); }
inline double log(double x) { return pm_log(x); }
inline double pow(double x, double y) { return pm_pow(x, y); }
inline double sin(double x) { return pm_sin(x); }
inline double cos(double x) { return pm_cos(x); }
inline double tan(double x) { return pm_tan(x); }
inline double atan(double x) { return pm_atan(x); }
inline double atan2(double y, double x) { return pm_atan2(y, x); }
inline double asin(double x) { return pm_asin(x); }
inline double acos(double x) { return pm_acos(x); }
inline double floor(double x) { return pm_floor(x); }

}  // namespace pillowmesh::portable
