// Convex hulls of large sets.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/convex_boundary.h"

namespace gridcull {

/// Convex hull with the given points as vertices, bit for bit: every input point lies in it exactly. Sets in one plane
/// give a polygon with two faces, on one line the two ends, equal ones one point. 2D (z = 0): the polygon alone.
/// Expected O(n log n) for points in no special order.
ConvexBoundary hull_boundary(std::span<const Vec3> points, int dimension);

/// Indices of the hull of the points' coordinates `x` and `y` (0, 1 or 2): strictly convex, counter-clockwise, exact
/// (A. M. Andrew's monotone chain, 1979). Two where all lie on a line, one where all are equal.
std::vector<std::uint32_t> planar_hull(std::span<const Vec3> points, int x, int y);

}  // namespace gridcull
