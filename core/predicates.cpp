// Source: J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
// predicates", Discrete & Computational Geometry 18, 1997, sections 2 (expansions) and 4 (error bounds A of
// ORIENT2D and ORIENT3D). Changed: two stages only, the filter and the full expansion; sums grow one component
// at a time (Fig. 6), since the second stage is rare and its length small.
//
// Needs round-to-nearest doubles without contraction, as the whole project is built.
#include "gridcull/core/predicates.h"

#include <array>
#include <cmath>

namespace gridcull {
namespace {

/// A sum of non-overlapping doubles, smallest first, zeros left out. 192 = three products of a
/// sixteen-component minor with a two-component difference, each doubling.
struct Expansion {
  std::array<double, 192> part;
  int count = 0;

  void push(double value) {
    if (value != 0.0) part[static_cast<std::size_t>(count++)] = value;
  }
  int sign() const {
    if (count == 0) return 0;
    return part[static_cast<std::size_t>(count - 1)] > 0.0 ? 1 : -1;
  }
};

/// a + b = high + low, exactly (Theorem 7).
void two_sum(double a, double b, double& high, double& low) {
  high = a + b;
  const double b_part = high - a;
  const double a_part = high - b_part;
  low = (a - a_part) + (b - b_part);
}

/// a = high + low with 26 bits each (Theorem 17).
void split(double a, double& high, double& low) {
  constexpr double splitter = 134217729.0;  // 2^27 + 1
  const double c = splitter * a;
  high = c - (c - a);
  low = a - high;
}

/// a * b = high + low, exactly (Theorem 18).
void two_product(double a, double b, double& high, double& low) {
  double a_high, a_low, b_high, b_low;
  split(a, a_high, a_low);
  split(b, b_high, b_low);
  high = a * b;
  low = a_low * b_low - (((high - a_high * b_high) - a_low * b_high) - a_high * b_low);
}

/// e + b (Fig. 6, GROW-EXPANSION).
void grow(Expansion& e, double b) {
  Expansion out;
  double carry = b;
  for (int i = 0; i < e.count; ++i) {
    double low;
    two_sum(carry, e.part[static_cast<std::size_t>(i)], carry, low);
    out.push(low);
  }
  out.push(carry);
  e = out;
}

/// e += scale * f.
void add_scaled(Expansion& e, const Expansion& f, double scale) {
  for (int i = 0; i < f.count; ++i) {
    double high, low;
    two_product(f.part[static_cast<std::size_t>(i)], scale, high, low);
    grow(e, low);
    grow(e, high);
  }
}

Expansion difference(double a, double b) {
  double high, low;
  two_sum(a, -b, high, low);
  Expansion e;
  e.push(low);
  e.push(high);
  return e;
}

/// e += sign * f * g.
void add_product(Expansion& e, const Expansion& f, const Expansion& g, double sign) {
  for (int i = 0; i < g.count; ++i) add_scaled(e, f, sign * g.part[static_cast<std::size_t>(i)]);
}

Expansion minor(const Expansion& a, const Expansion& b, const Expansion& c, const Expansion& d) {
  Expansion e;
  add_product(e, a, d, 1.0);
  add_product(e, b, c, -1.0);
  return e;
}

int sign_of(double value) { return (value > 0.0) - (value < 0.0); }

constexpr double half_ulp = 0x1p-53;

}  // namespace

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (b.x - a.x) * (c.y - a.y);
  const double right = (b.y - a.y) * (c.x - a.x);
  const double det = left - right;
  // Section 4.1, bound A: (3 + 16 eps) eps times the permanent.
  if (std::fabs(det) > (3.0 + 16.0 * half_ulp) * half_ulp * (std::fabs(left) + std::fabs(right))) return sign_of(det);
  return minor(difference(b.x, a.x), difference(b.y, a.y), difference(c.x, a.x), difference(c.y, a.y)).sign();
}

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double yz = u.y * v.z, zy = u.z * v.y;
  const double zx = u.z * v.x, xz = u.x * v.z;
  const double xy = u.x * v.y, yx = u.y * v.x;
  const double det = w.x * (yz - zy) + w.y * (zx - xz) + w.z * (xy - yx);
  const double permanent = std::fabs(w.x) * (std::fabs(yz) + std::fabs(zy)) +
                           std::fabs(w.y) * (std::fabs(zx) + std::fabs(xz)) +
                           std::fabs(w.z) * (std::fabs(xy) + std::fabs(yx));
  // Section 4.2, bound A: (7 + 56 eps) eps times the permanent.
  if (std::fabs(det) > (7.0 + 56.0 * half_ulp) * half_ulp * permanent) return sign_of(det);
  const Expansion ux = difference(b.x, a.x), uy = difference(b.y, a.y), uz = difference(b.z, a.z);
  const Expansion vx = difference(c.x, a.x), vy = difference(c.y, a.y), vz = difference(c.z, a.z);
  Expansion sum;
  add_product(sum, minor(uy, uz, vy, vz), difference(d.x, a.x), 1.0);
  add_product(sum, minor(uz, ux, vz, vx), difference(d.y, a.y), 1.0);
  add_product(sum, minor(ux, uy, vx, vy), difference(d.z, a.z), 1.0);
  return sum.sign();
}

}  // namespace gridcull
