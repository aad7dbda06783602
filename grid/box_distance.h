// Distances of boxes from a viewpoint, and what rounding may add to them: method `silhouette` in 3D takes its keys
// from them.
#pragma once

#include <algorithm>
#include <cmath>

#include "gridcull/core/vec.h"

namespace gridcull {

/// Distances are rounded three or four times, each by at most 2^-52 of the coordinates that went in.
inline constexpr double distance_rounding = 0x1p-46;

/// Of coordinates, as rounding counts them.
inline double magnitude(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

/// Metres, 0 inside; the box relative to the viewpoint.
inline double distance_to_box(const Vec3& low, const Vec3& high) {
  const auto gap = [&](int k) { return std::max({low[k], -high[k], 0.0}); };
  const double x = gap(0), y = gap(1), z = gap(2);
  return std::sqrt(x * x + y * y + z * z);
}

/// Of its farthest corner.
inline double farthest_of_box(const Vec3& low, const Vec3& high) {
  const auto reach = [&](int k) { return std::max(std::fabs(low[k]), std::fabs(high[k])); };
  const double x = reach(0), y = reach(1), z = reach(2);
  return std::sqrt(x * x + y * y + z * z);
}

}  // namespace gridcull
