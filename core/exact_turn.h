// Directions on a line, for sorting: the "diamond angle", monotone in the angle and made of exactly rounded
// operations only, so that the reference answers with the same bits everywhere.
#pragma once

#include <cmath>

#include "gridcull/core/vec.h"

namespace gridcull::exact {

/// Turns: counter-clockwise from +x, 0 <= turn < 4, one per quadrant.
inline constexpr double full_turn = 4.0;

/// Turn of a direction that is not zero. Points on one ray may differ in the last bit.
inline double turn_of(const Vec2& d) {
  const double sum = std::fabs(d.x) + std::fabs(d.y);
  if (d.y >= 0.0) return d.x > 0.0 ? d.y / sum : 1.0 + -d.x / sum;
  const double turn = d.x < 0.0 ? 2.0 + -d.y / sum : 3.0 + d.x / sum;
  return turn < full_turn ? turn : 0.0;
}

/// The direction with |x| + |y| = 1; radians per turn are 1 / (x^2 + y^2) there.
inline Vec2 diamond_at(double turn) {
  if (turn < 1.0) return {1.0 - turn, turn};
  if (turn < 2.0) return {1.0 - turn, 2.0 - turn};
  if (turn < 3.0) return {turn - 3.0, 2.0 - turn};
  return {turn - 3.0, turn - 4.0};
}

/// How far counter-clockwise `to` lies from `from`, 0 <= result < 4.
inline double turns_between(double from, double to) { return to >= from ? to - from : to - from + full_turn; }

/// A closed range of directions.
struct Sector {
  double from = 0.0;
  double width = full_turn;  ///< full_turn: all directions

  bool all() const { return width >= full_turn; }
  bool holds(double turn) const { return all() || turns_between(from, turn) <= width; }
  bool meets(const Sector& other) const { return holds(other.from) || other.holds(from); }
};

}  // namespace gridcull::exact
