#include "pillowmesh/metric/gallery.h"

namespace pillowmesh {
namespace {

// The paper's sizes along one axis, Eqs. (3) and (5).
#define PILLOWMESH_SIZE_ALONG_Y \
  "if(y <= 2, 1 - 19*y/40, if(y <= 4.5, 20^((2*y - 9)/5), if(y <= 7, 5^((9 - 2*y)/5), 1/5 + (y - 7)^4/20)))"
#define PILLOWMESH_SIZE_ALONG_X \
  "if(x <= 2, 1 - 19*x/40, if(x <= 3.5, 20^((2*x - 7)/3), if(x <= 5, 5^((7 - 2*x)/3), 1/5 + (x - 5)^4/20)))"

// H / 0.02 at nine points, (x, y) and 0.01 beside it, H the Hessian of tanh(20 z), z = x - sin(3 y) / 2: its eigenvalues
// without sign, limited to those of sizes from 0.15 to 0.003, and of the logarithms the mean with weights of 4, 2 and 1,
// a I + (b c; c -b).
//
// With w = 1 / (1 + exp(40 z)), d = w (1 - w), e = (2 w - 1) d and v = -1.5 cos(3 y):
// H / 0.02 = 160000 e (1 v; v v^2) + 18000 d sin(3 y) (0 0; 0 1) = s I + (b c; c -b).
// To evaluate tanh nine times would take longer than exp(40 x) and exp(-20 sin(3 y)) in three rows.

/// Of a row of three points: what takes e and d to s, b and c.
#define PILLOWMESH_SHOCK_ROW(R, SINE, COSINE)                                                                         \
  "p" R " = " SINE ";\no" R " = " COSINE ";\nz" R " = exp(-20*p" R ");\nq" R " = 180000*o" R "^2;\n"                  \
  "s" R " = 80000 + q" R ";\nf" R " = 80000 - q" R ";\nv" R " = 9000*p" R ";\nt" R " = -240000*o" R ";\n"

/// Of point N of row R, where exp(40 x) is U: s, b, c, the limited eigenvalues k and l, and n, by which b and c are to be
/// multiplied for their logarithms.
#define PILLOWMESH_SHOCK_AT(N, R, U)                                                                                  \
  "w" N " = 1/(1 + " U "*z" R ");\nd" N " = w" N "*(1 - w" N ");\ne" N " = (2*w" N " - 1)*d" N ";\n"                  \
  "i" N " = v" R "*d" N ";\ns" N " = s" R "*e" N " + i" N ";\nb" N " = f" R "*e" N " - i" N ";\nc" N " = t" R "*e" N ";\n"\
  "g" N " = sqrt(b" N "^2 + c" N "^2) + 1e-30;\n"                                                                     \
  "k" N " = min(max(abs(s" N " + g" N "), 1/0.15^2), 1/0.003^2);\n"                                                   \
  "l" N " = min(max(abs(s" N " - g" N "), 1/0.15^2), 1/0.003^2);\nn" N " = log(k" N "/l" N ")/g" N ";\n"
#define PILLOWMESH_SHOCK_MEAN(X)                                                                                      \
  X " = 0.03125*(4*n1*" X "1 + 2*(n2*" X "2 + n3*" X "3 + n4*" X "4 + n5*" X "5)"                                     \
    " + n6*" X "6 + n7*" X "7 + n8*" X "8 + n9*" X "9);\n"

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
     PILLOWMESH_SHOCK_ROW("0", "sin(3*y)", "cos(3*y)")
     PILLOWMESH_SHOCK_ROW("h", "p0*cos(0.03) + o0*sin(0.03)", "o0*cos(0.03) - p0*sin(0.03)")
     PILLOWMESH_SHOCK_ROW("l", "p0*cos(0.03) - o0*sin(0.03)", "o0*cos(0.03) + p0*sin(0.03)")
     "u = exp(40*x);\nur = u*exp(0.4);\nul = u*exp(-0.4);\n"
     PILLOWMESH_SHOCK_AT("1", "0", "u") PILLOWMESH_SHOCK_AT("2", "0", "ur") PILLOWMESH_SHOCK_AT("3", "0", "ul")
     PILLOWMESH_SHOCK_AT("4", "h", "u") PILLOWMESH_SHOCK_AT("5", "l", "u") PILLOWMESH_SHOCK_AT("6", "h", "ur")
     PILLOWMESH_SHOCK_AT("7", "h", "ul") PILLOWMESH_SHOCK_AT("8", "l", "ur") PILLOWMESH_SHOCK_AT("9", "l", "ul")
     PILLOWMESH_SHOCK_MEAN("b") PILLOWMESH_SHOCK_MEAN("c")
     "a = 0.03125*log((k1*l1)^4*(k2*l2*k3*l3*k4*l4*k5*l5)^2*(k6*l6*k7*l7*k8*l8*k9*l9));\n"
     "g = sqrt(b^2 + c^2) + 1e-30;\nj = exp(a + g);\nk = exp(a - g);\nm = 0.5*(j + k);\nn = 0.5*(j - k)/g;\n"
     "m11 = m + n*b;\nm12 = n*c;\nm22 = m - n*b",
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

#undef PILLOWMESH_SHOCK_ROW
#undef PILLOWMESH_SHOCK_AT
#undef PILLOWMESH_SHOCK_MEAN
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
