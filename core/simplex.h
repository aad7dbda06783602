// A few points of a set, far from each other, that span what it spans.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "gridcull/core/bounding_ball.h"
#include "gridcull/core/vec.h"

namespace gridcull {

struct Simplex {
  std::array<std::uint32_t, 4> at{};  ///< indices, rank + 1 of them count; rank 3: orientation() of them is -1
  int rank = 0;                       ///< exact; 0: all points are equal, 1: on a line, 2: in a plane, 3: space
  std::array<int, 2> axes{0, 1};      ///< rank 2 and 3: coordinates in which the first three are not on one line
};

/// Not empty. O(n).
Simplex simplex_of(std::span<const Vec3> points);

/// A ball that lies in the hull of the points: one in a tetrahedron (2D: triangle) of points far from each other.
/// Radius 0 where they are nearly flat: below 2^-20 of their coordinates.
Ball ball_inside(std::span<const Vec3> points, int dimension);

/// v / |v|, or 0.
inline Vec3 unit(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : Vec3(0.0);
}

/// Two of its coordinates.
inline Vec2 planar(const Vec3& p, int x, int y) { return {p[x], p[y]}; }

}  // namespace gridcull
