// Convex hull in the plane.
#pragma once

#include <algorithm>
#include <vector>

#include "gridcull/core/vec.h"
#include "gridcull/grid/exact_side.h"

namespace gridcull {

/// Strictly convex, counter-clockwise, exact (A. M. Andrew's monotone chain, 1979); fewer than three points when flat.
inline std::vector<Vec2> hull_of_outline(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t base = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= base + 2 && side_of_line(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // the other side's first
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace gridcull
