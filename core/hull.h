// Convex hull of points in 3D.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gridcull/core/half_space.h"

namespace gridcull {

/// Hull of the given points: outward, counter-clockwise triangles over the input's indices, and the
/// half-spaces whose intersection it is (inward normals: dot(normal, p) >= offset inside), coplanar
/// triangles sharing one. Outer: every input point satisfies every half-space as stored. Inner: a point with
/// dot(normal, p) >= offset + margin for all of them lies in the true hull.
struct Hull {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<HalfSpace> sides;
  double margin = 0.0;
};

/// Throws Error(bad_scene) for fewer than four points or a flat set.
Hull convex_hull(const std::vector<Vec3>& points);

/// Whether `point` lies in the open interior of the hull of `points`.
bool hull_holds(const std::vector<Vec3>& points, const Vec3& point);
/// The same for a hull whose triangles are known: allocates nothing.
bool hull_holds(const std::vector<Vec3>& points, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                const Vec3& point);

}  // namespace gridcull
