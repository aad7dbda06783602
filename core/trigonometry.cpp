// Range reduction by the exact IEEE remainder, then the classic minimax kernels of fdlibm
// (k_sin.c, k_cos.c: degree 13 and 14 on [-pi/4, pi/4], error < 2^-57). Only +, -, * and
// std::remainder are used, and contraction is off for the whole project, so the bits are fixed.
#include "gridcull/core/trigonometry.h"

#include <cmath>

namespace gridcull {
namespace {

double kernel_sin(double x) {
  const double z = x * x;
  const double r =
      8.33333333332248946124e-03 +
      z * (-1.98412698298579493134e-04 +
           z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
  return x + z * x * (-1.66666666666666324348e-01 + z * r);
}

double kernel_cos(double x) {
  const double z = x * x;
  const double r = z * (4.16666666666666019037e-02 +
                        z * (-1.38888888888741095749e-03 +
                             z * (2.48015872894767294178e-05 +
                                  z * (-2.75573143513906633035e-07 +
                                       z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  const double half = 0.5 * z;
  const double w = 1.0 - half;
  return w + (((1.0 - w) - half) + z * r);
}

}  // namespace

SinCos stable_sincos(double angle) {
  // pi/2 = high + low with 33 significant bits in high: quarter * high is exact for |quarter| < 2^20.
  constexpr double half_pi_high = 1.57079632673412561417e+00;
  constexpr double half_pi_low = 6.07710050650619224932e-11;
  constexpr double half_pi = 1.57079632679489661923;
  constexpr double reach = 1e5;
  const double near = std::fabs(angle) <= reach ? angle : std::remainder(angle, 4 * half_pi);
  const double quarter = std::nearbyint(near / half_pi);
  const double x = (near - quarter * half_pi_high) - quarter * half_pi_low;
  const double s = kernel_sin(x);
  const double c = kernel_cos(x);
  switch (static_cast<long long>(quarter) & 3) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
  }
}

}  // namespace gridcull
