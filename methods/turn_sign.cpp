// J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997: a filter
// (his bound A), then all twelve parts of the six products summed exactly (GROW-EXPANSION). std::fma gives the exact
// error of a product, by instruction or by the library, with the same bits.
#include "gridcull/methods/turn_sign.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace gridcull {
namespace {

/// A sum of doubles that do not overlap, smallest first.
class ExactSum {
 public:
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  int sign() const {
    for (std::size_t i = count_; i-- > 0;) {
      if (parts_[i] != 0.0) return parts_[i] > 0.0 ? 1 : -1;
    }
    return 0;
  }

 private:
  void add(double carry) {
    for (std::size_t i = 0; i < count_; ++i) {
      const double sum = carry + parts_[i], back = sum - carry;
      parts_[i] = (carry - (sum - back)) + (parts_[i] - back);
      carry = sum;
    }
    parts_[count_++] = carry;
  }

  std::array<double, 12> parts_{};
  std::size_t count_ = 0;
};

}  // namespace

int turn_sign(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x), det = left - right;
  constexpr double bound = (3.0 + 16.0 * 0x1p-53) * 0x1p-53;
  if (std::fabs(det) > bound * (std::fabs(left) + std::fabs(right))) return det > 0.0 ? 1 : -1;
  ExactSum sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.y, b.x);
  sum.add_product(b.x, c.y);
  sum.add_product(-b.y, c.x);
  sum.add_product(c.x, a.y);
  sum.add_product(-c.y, a.x);
  return sum.sign();
}

}  // namespace gridcull
