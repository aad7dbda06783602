// Claim. The determinant is first computed in doubles from differences; with u = 2^-53 and the sum S of the magnitudes
// of its products, its error is below 4 u S in the plane (each product of two differences: 3 roundings; one
// subtraction) and below 9 u S in space (7 roundings a product at most, two sums), all to first order: 8 u S and 16 u S
// leave room for the higher orders and for the rounding of S. A greater value has the right sign.
//
// Else the determinant is written out in the coordinates themselves, 6 products of two or 24 of three, each an exact
// sum of 2 or 4 doubles (std::fma gives the rounding error of a product), and the doubles are distilled: passes of
// exact additions of neighbours, which leave the sum as it is, until the last outweighs all before it (W. Kahan's
// distillation; T. Ogita, S. M. Rump and S. Oishi, "Accurate sum and dot product", 2005, VecSum). A few passes do; as
// many as there are numbers leave none that overlap, so it ends. fma is written out where it is meant: the build
// contracts nothing.
#include "gridcull/grid/exact_side.h"

#include <array>
#include <cmath>

namespace gridcull {
namespace {

constexpr double u = 0x1p-53;

int sign_of(double value) { return (value > 0.0) - (value < 0.0); }

/// Doubles whose exact sum is wanted.
struct Terms {
  std::array<double, 96> term;
  std::size_t count = 0;

  void add(double value) { term[count++] = value; }

  /// sign * x * y.
  void add_product(double sign, double x, double y) {
    const double high = x * y;
    add(sign * high);
    add(sign * std::fma(x, y, -high));
  }

  /// sign * x * y * z.
  void add_product(double sign, double x, double y, double z) {
    const double high = x * y;
    add_product(sign, high, z);
    add_product(sign, std::fma(x, y, -high), z);
  }

  /// One pass: each pair of neighbours becomes its rounding error and its rounded sum.
  void distil() {
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const double a = term[i], b = term[i + 1], sum = a + b, part = sum - a;
      term[i] = (a - (sum - part)) + (b - part);
      term[i + 1] = sum;
    }
  }

  int sign() {
    for (std::size_t pass = 0; pass <= count; ++pass) {
      distil();
      double rest = 0.0;
      for (std::size_t i = 0; i + 1 < count; ++i) rest += std::fabs(term[i]);
      // `rest` is rounded count times.
      if (std::fabs(term[count - 1]) > rest * (1.0 + 256.0 * u)) return sign_of(term[count - 1]);
      if (rest == 0.0) return 0;
    }
    // They do not overlap now: the last that is not zero outweighs those before it.
    for (std::size_t i = count; i-- > 0;) {
      if (term[i] != 0.0) return sign_of(term[i]);
    }
    return 0;
  }
};

/// sign * det(p, q, r) of three columns.
void add_determinant(Terms& terms, double sign, const Vec3& p, const Vec3& q, const Vec3& r) {
  terms.add_product(sign, p.x, q.y, r.z);
  terms.add_product(sign, p.y, q.z, r.x);
  terms.add_product(sign, p.z, q.x, r.y);
  terms.add_product(-sign, p.x, q.z, r.y);
  terms.add_product(-sign, p.y, q.x, r.z);
  terms.add_product(-sign, p.z, q.y, r.x);
}

}  // namespace

int side_of_line(const Vec2& a, const Vec2& b, const Vec2& p) {
  const double left = (b.x - a.x) * (p.y - a.y), right = (b.y - a.y) * (p.x - a.x);
  const double value = left - right;
  if (std::fabs(value) > 8.0 * u * (std::fabs(left) + std::fabs(right))) return sign_of(value);
  Terms terms;
  terms.add_product(1.0, a.x, b.y), terms.add_product(-1.0, a.y, b.x);
  terms.add_product(1.0, b.x, p.y), terms.add_product(-1.0, b.y, p.x);
  terms.add_product(1.0, p.x, a.y), terms.add_product(-1.0, p.y, a.x);
  return terms.sign();
}

int side_of_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const Vec3 s = b - a, t = c - a, w = p - a;
  const Vec3 plus = w * Vec3(s.y * t.z, s.z * t.x, s.x * t.y), minus = w * Vec3(s.z * t.y, s.x * t.z, s.y * t.x);
  const double value = (plus.x - minus.x) + (plus.y - minus.y) + (plus.z - minus.z);
  const Vec3 size = glm::abs(plus) + glm::abs(minus);
  if (std::fabs(value) > 16.0 * u * (size.x + size.y + size.z)) return sign_of(value);
  // det(b - a, c - a, p - a) = det(b, c, p) - det(a, c, p) + det(a, b, p) - det(a, b, c).
  Terms terms;
  add_determinant(terms, 1.0, b, c, p);
  add_determinant(terms, -1.0, a, c, p);
  add_determinant(terms, 1.0, a, b, p);
  add_determinant(terms, -1.0, a, b, c);
  return terms.sign();
}

}  // namespace gridcull
