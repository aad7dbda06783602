// Whether a point lies inside an outline by the even-odd rule (where it crosses itself, too).
#pragma once

#include <cstddef>
#include <vector>

#include "gridcull/core/vec.h"

namespace gridcull {

/// `outline`: closed, not empty. Points on it, to within rounding, are answered either way.
inline bool even_odd(const std::vector<Vec2>& outline, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vec2 a = outline[j] - p, b = outline[i] - p;
    if ((a.y > 0.0) != (b.y > 0.0) && (cross2(a, b) > 0.0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

}  // namespace gridcull
