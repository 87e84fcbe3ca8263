#include "pillowmesh/metric/gallery.h"

namespace pillowmesh {
namespace {

// The paper's sizes along one axis, Eqs. (3) and (5).
#define PILLOWMESH_SIZE_ALONG_Y \
  "if(y <= 2, 1 - 19*y/40, if(y <= 4.5, 20^((2*y - 9)/5), if(y <= 7, 5^((9 - 2*y)/5), 1/5 + (y - 7)^4/20)))"
#define PILLOWMESH_SIZE_ALONG_X \
  "if(x <= 2, 1 - 19*x/40, if(x <= 3.5, 20^((2*x - 7)/3), if(x <= 5, 5^((7 - 2*x)/3), 1/5 + (x - 5)^4/20)))"

// The Hessian H of tanh(20 (x - sin(3 y) / 2)) at (x + A, y + B): adds W log(|H| / 0.02), its eigenvalues limited to
// sizes from 0.003 to 0.15, to log M = a I + (b c; c -b), under the names a N, b N, c N after P.
#define PILLOWMESH_SHOCK_AT(N, P, A, B, W)                                                     \
  "s" N " = tanh(20*(x + " A " - 0.5*sin(3*(y + " B                                            \
  "))));\n"                                                                                    \
  "d" N " = 1 - s" N "^2;\ne" N " = -2*s" N "*d" N ";\nv" N " = -30*cos(3*(y + " B             \
  "));\n"                                                                                      \
  "q" N " = 200*e" N ";\nr" N " = 0.5*(v" N "^2*e" N " + 90*d" N "*sin(3*(y + " B              \
  ")));\n"                                                                                     \
  "t" N " = 20*v" N "*e" N ";\ng" N " = sqrt((q" N " - r" N ")^2 + t" N                        \
  "^2) + 1e-30;\n"                                                                             \
  "k" N " = log(min(max(50*abs(q" N " + r" N " + g" N                                          \
  "), 1/0.15^2), 1/0.003^2));\n"                                                               \
  "l" N " = log(min(max(50*abs(q" N " + r" N " - g" N                                          \
  "), 1/0.15^2), 1/0.003^2));\n"                                                               \
  "a" N " = " P("a") " + " W "*0.5*(k" N " + l" N                                              \
                     ");\n"                                                                    \
                     "b" N " = " P("b") " + " W "*0.5*(k" N " - l" N ")*(q" N " - r" N ")/g" N \
                                        ";\n"                                                  \
                                        "c" N " = " P("c") " + " W "*0.5*(k" N " - l" N ")*t" N "/g" N ";\n"
#define PILLOWMESH_NONE(X) "0"
#define PILLOWMESH_AFTER_1(X) X "1"
#define PILLOWMESH_AFTER_2(X) X "2"
#define PILLOWMESH_AFTER_3(X) X "3"
#define PILLOWMESH_AFTER_4(X) X "4"
#define PILLOWMESH_AFTER_5(X) X "5"
#define PILLOWMESH_AFTER_6(X) X "6"
#define PILLOWMESH_AFTER_7(X) X "7"
#define PILLOWMESH_AFTER_8(X) X "8"

// In Eqs. (8) and (12) the paper prints |1-r|; its circle and sphere have radius 0.5, and its tables come from |0.5-r|.
constexpr Case kCases[] = {
    {"iso2d", 2, "Two lines of fine squares, graded by hand-made functions", "grid:7,9:0,7,0,9",
     "h = " PILLOWMESH_SIZE_ALONG_Y, "[Paper] Eqs. (2), (3), Figure 5"},
    {"aniso2d", 2, "The same grading in x and in y, each along its own axis", "grid:7,9:0,7,0,9",
     "h1 = " PILLOWMESH_SIZE_ALONG_X ";\nh2 = " PILLOWMESH_SIZE_ALONG_Y, "[Paper] Eqs. (2), (5), Figure 6"},
    {"circle2d", 2, "Stretched cells along a circle that the rows do not follow", "grid:10,10:-1,1,-1,1",
     "theta = atan2(y, x);\nh1 = r/120 + abs(0.5 - r)/2;\nh2 = r/30 + abs(0.5 - r)/2",
     "[Paper] Eqs. (6)-(8), Figure 7, with |0.5-r| for the misprinted |1-r|"},
    {"linear2d", 2, "A flat layer a thousand times thinner than wide", "grid:10,10:0,1,0,1",
     "h1 = 0.1;\nh2 = 0.0001 + 2*(0.1 - 0.0001)*abs(y - 0.5)", "UGAWG, linear"},
    {"larsson1", 2, "Stretching that alternates between the axes like a chessboard", "grid:8,8:0,1,0,1",
     "s = 200*sin(2*pi*x)*sin(2*pi*y);\nm11 = 400 + s;\nm12 = 0;\nm22 = 400 - s", "UGAWG, larsson1"},
    {"masabl-1", 2, "A boundary layer with fine cells at both ends", "grid:10,10:0,1,0,1",
     "h1 = 0.01 + 0.2*cos(pi*(x - 0.5));\nh2 = 0.001*exp(6*y)", "UGAWG, masabl-1"},
    {"circle-1", 2, "A thin quarter ring around a point outside the square", "grid:10,10:0,1,0,1",
     "theta = atan2(y - 0.5, x + 0.5);\nd = sqrt((x + 0.5)^2 + (y - 0.5)^2);\n"
     "h1 = 0.0005 + 1.5*abs(1 - d);\nh2 = 0.1*d + 1.5*abs(1 - d)",
     "UGAWG, circle-1"},
    {"shock2d", 2, "The Hessian of a sine-shaped shock, smoothed so that it can be met", "grid:10,10:-1,1,-1,1",
     PILLOWMESH_SHOCK_AT("1", PILLOWMESH_NONE, "0", "0", "0.25")
         PILLOWMESH_SHOCK_AT("2", PILLOWMESH_AFTER_1, "0.01", "0", "0.125")
             PILLOWMESH_SHOCK_AT("3", PILLOWMESH_AFTER_2, "-0.01", "0", "0.125")
                 PILLOWMESH_SHOCK_AT("4", PILLOWMESH_AFTER_3, "0", "0.01", "0.125")
                     PILLOWMESH_SHOCK_AT("5", PILLOWMESH_AFTER_4, "0", "-0.01", "0.125")
                         PILLOWMESH_SHOCK_AT("6", PILLOWMESH_AFTER_5, "0.01", "0.01", "0.0625") PILLOWMESH_SHOCK_AT(
                             "7", PILLOWMESH_AFTER_6, "-0.01", "0.01", "0.0625")
                             PILLOWMESH_SHOCK_AT("8", PILLOWMESH_AFTER_7, "0.01", "-0.01", "0.0625")
                                 PILLOWMESH_SHOCK_AT("9", PILLOWMESH_AFTER_8, "-0.01", "-0.01",
                                                     "0.0625") "g = sqrt(b9^2 + c9^2) + 1e-30;\nm = 0.5*(exp(a9 + g) + "
                                                               "exp(a9 - g));\nn = 0.5*(exp(a9 + g) - exp(a9 - g))/g;\n"
                                                               "m11 = m + n*b9;\nm12 = n*c9;\nm22 = m - n*b9",
     "own; the metric of a shock that error estimates give"},
    {"linear3d", 3, "Cubes that grow upwards", "grid:4,4,4:0,1,0,1,0,1", "h = 0.05 + 0.15*z",
     "[Paper] Table 4, Figure 9"},
    {"sphere3d-paper", 3, "A sphere, with the rotations in the order that the paper prints", "grid:5,5,5:0,1,0,1,0,1",
     // M = R_phi R_theta D R_theta^-1 R_phi^-1, where h2 = h3 leaves one direction (u, v, w).
     "theta = atan2(y, x);\nphi = -atan2(z, sqrt(x^2 + y^2));\n"
     "s1 = r/40 + 3*abs(0.5 - r)/2;\ns2 = r/10 + 3*abs(0.5 - r)/2;\n"
     "u = cos(phi)*cos(theta);\nv = sin(theta);\nw = -sin(phi)*cos(theta);\n"
     "b = 1/s2^2;\na = 1/s1^2 - b;\n"
     "m11 = b + a*u^2;\nm12 = a*u*v;\nm22 = b + a*v^2;\nm13 = a*u*w;\nm23 = a*v*w;\nm33 = b + a*w^2",
     "[Paper] Eqs. (9)-(12), Figure 10, with |0.5-r| for the misprinted |1-r|"},
    {"sphere3d", 3, "Flat cells along a sphere, thin in the radial direction", "grid:5,5,5:0,1,0,1,0,1",
     "theta = atan2(y, x);\nphi = -atan2(z, sqrt(x^2 + y^2));\n"
     "h1 = r/40 + 3*abs(0.5 - r)/2;\nh2 = r/10 + 3*abs(0.5 - r)/2;\nh3 = h2",
     "[Paper] Eqs. (10)-(12) with the rotations in radial order"},
    {"boundary-layer", 3, "Thin layers on the floor of a cube", "grid:5,5,5:0,1,0,1,0,1",
     "h1 = 0.2;\nh2 = 0.2;\nh3 = 0.002 + 0.198*z", "own"},
    {"cube-linear", 3, "A flat layer in the middle of a cube", "grid:10,10,10:0,1,0,1,0,1",
     "h1 = 0.1;\nh2 = 0.1;\nh3 = 0.001 + 2*(0.1 - 0.001)*abs(z - 0.5)", "UGAWG, cube-linear"},
    {"polar-1", 3, "A thin layer on the hole in a cube", "quarter:6,5,10:0.5,1,0,1",
     "d = sqrt(x^2 + y^2);\ntheta = atan2(y, x);\nh1 = 0.001 + 2*(0.1 - 0.001)*abs(d - 0.5);\nh2 = 0.1;\nh3 = 0.1",
     "UGAWG, cube-cylinder, polar-1"},
    {"polar-2", 3, "The same layer, with cells that follow the hole's curvature", "quarter:6,5,10:0.5,1,0,1",
     "d = sqrt(x^2 + y^2);\ntheta = atan2(y, x);\nh1 = 0.001 + 2*(0.1 - 0.001)*abs(d - 0.5);\n"
     "t = 10*(0.6 - d);\nh2 = if(t < 0, 0.1, t/40 + 0.1*(1 - t));\nh3 = 0.1",
     "UGAWG, cube-cylinder, polar-2"},
};

#undef PILLOWMESH_SHOCK_AT
#undef PILLOWMESH_NONE
#undef PILLOWMESH_AFTER_1
#undef PILLOWMESH_AFTER_2
#undef PILLOWMESH_AFTER_3
#undef PILLOWMESH_AFTER_4
#undef PILLOWMESH_AFTER_5
#undef PILLOWMESH_AFTER_6
#undef PILLOWMESH_AFTER_7
#undef PILLOWMESH_AFTER_8
#undef PILLOWMESH_SIZE_ALONG_X
#undef PILLOWMESH_SIZE_ALONG_Y

}  // namespace

std::span<const Case> gallery() { return kCases; }

const Case& portrait_case() {
  static constexpr Case kPortrait{"riemann",
                                  2,
                                  "A portrait, seen in the cells: the Hessian of an image",
                                  "grid:16,20:0,0.8,0,1",
                                  "",
                                  "own image, after [Paper] Figure 11"};
  return kPortrait;
}

const Case* find_case(std::string_view name) {
  for (const Case& c : kCases) {
    if (c.name == name) return &c;
  }
  return nullptr;
}

}  // namespace pillowmesh
