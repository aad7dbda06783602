// Range reduction by the exact IEEE remainder, then the classic minimax kernels of fdlibm
// (k_sin.c, k_cos.c: degree 13 and 14 on [-pi/4, pi/4], error < 2^-57). Only +, -, * and
// std::remainder are used, and contraction is off for the whole project, so the bits are fixed.
#include "gridcull/core/trigonometry.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace gridcull {
namespace {

// pi/2 = high + low with 33 significant bits in high: quarter * high is exact for |quarter| < 2^20.
constexpr double half_pi_high = 1.57079632673412561417e+00;
constexpr double half_pi_low = 6.07710050650619224932e-11;
constexpr double half_pi = 1.57079632679489661923;
/// Angles beyond are reduced by std::remainder first.
constexpr double reach = 1e5;

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

namespace {

/// The same without branches and calls, for |angle| <= reach, so that compilers take several at a time.
///
/// Rounding: |angle / half_pi| < 2^17, and a sum with 1.5 * 2^52 has no room for a fraction, so that the addition
/// rounds to the nearest whole number, halves to the even one, as std::nearbyint does. Its lowest bits are then the
/// number's in two's complement. Where std::nearbyint gives -0 this gives +0; quarter * high and quarter * low are then
/// zeros of either sign, whose subtraction changes nothing but the sign of an x that is zero itself, and sin(+-0) = +0
/// here as there: x + z * x * (negative number) has a term of either sign.
SinCos sincos_within_reach(double near) {
  constexpr double whole = 0x1.8p52;
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  const double shifted = near / half_pi + whole;
  const double quarter = shifted - whole;
  const auto turns = std::bit_cast<std::uint64_t>(shifted);
  const double x = (near - quarter * half_pi_high) - quarter * half_pi_low;
  const auto s = std::bit_cast<std::uint64_t>(kernel_sin(x));
  const auto c = std::bit_cast<std::uint64_t>(kernel_cos(x));
  const std::uint64_t swap = std::uint64_t{0} - (turns & 1);  // all bits or none
  const std::uint64_t both = (s ^ c) & swap;
  // sin turns its sign in quarters 2 and 3, cos in 1 and 2.
  return {std::bit_cast<double>((s ^ both) ^ (turns << 62 & sign)),
          std::bit_cast<double>((c ^ both) ^ ((turns + 1) << 62 & sign))};
}

}  // namespace

void stable_sincos(std::span<const double> angles, std::span<SinCos> out) {
  constexpr std::size_t stretch = 64;
  for (std::size_t first = 0; first < angles.size(); first += stretch) {
    const std::size_t count = std::min(stretch, angles.size() - first);
    bool near = true;
    for (std::size_t i = first; i < first + count; ++i) near &= std::fabs(angles[i]) <= reach;
    if (near) {
      for (std::size_t i = first; i < first + count; ++i) out[i] = sincos_within_reach(angles[i]);
    } else {
      for (std::size_t i = first; i < first + count; ++i) out[i] = stable_sincos(angles[i]);
    }
  }
}

}  // namespace gridcull
