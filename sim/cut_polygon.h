// A polygon in space, nearly flat, as triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/mesh.h"

namespace gridcull {

/// Appends count - 2 triangles over these vertices with the polygon's own boundary: a fan for a convex one, ear
/// clipping (G. H. Meisters, "Polygons have ears", 1975) in the plane that its normal lies nearest to for others, and a
/// fan again for more than 2,000 corners, which would take long. Where that leads out of the outline, or the polygon
/// crosses itself, the triangles still have its boundary, so a mesh that closes stays closed.
void cut_polygon(std::span<const Vec3> vertices, std::vector<std::uint32_t> polygon, std::vector<Triangle>& out);

}  // namespace gridcull
