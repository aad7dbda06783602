// Axis-aligned box.
#pragma once

#include <algorithm>
#include <limits>

#include "gridcull/core/vec.h"

namespace gridcull {

/// Closed box, metres; in 2D z is 0 .. 0. Empty until a point is added.
struct Bounds {
  Vec3 min{std::numeric_limits<double>::infinity()};
  Vec3 max{-std::numeric_limits<double>::infinity()};

  bool empty() const { return !(min.x <= max.x); }
  void add(const Vec3& p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
  }
  void add_ball(const Vec3& centre, double radius) {
    add(centre - Vec3(radius));
    add(centre + Vec3(radius));
  }
  Vec3 size() const { return max - min; }
  Vec3 centre() const { return 0.5 * (min + max); }
};

}  // namespace gridcull
