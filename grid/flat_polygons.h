// Triangles joined to convex polygons.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gridcull/core/vec.h"

namespace gridcull {

/// Corners in order, at most 32; any turn.
using FlatPolygon = std::vector<Vec3>;

/// Neighbours joined across whole shared edges while they lie in one plane and stay convex, all decided exactly:
/// the union of the polygons is the union of the triangles with area.
std::vector<FlatPolygon> join_triangles(const std::vector<Vec3>& vertices,
                                        const std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace gridcull
