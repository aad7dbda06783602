// Triangle meshes: whether one closes, and what is inside one that does.
//
// Inside is what lies behind an odd number of the triangles along a ray (the even-odd rule, as for polygons), so the
// turn of a triangle does not matter, and shells may nest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gridcull/core/shape.h"

namespace gridcull {

using Triangle = std::array<std::uint32_t, 3>;

/// Where a mesh does not close.
struct MeshHoles {
  std::size_t open_edges = 0;  ///< edges that an odd number of triangles share
  Vec3 at{0.0};                ///< the middle of one of them
};

/// An edge is two numbers of vertices, so vertices at one place must have been welded. Triangles that name a vertex
/// twice count for nothing.
MeshHoles find_holes(const Faces& mesh);

enum class MeshSide { outside, on_surface, inside };

/// On which side of these triangles, which close, the point lies; exact for the doubles given (core/predicates.h). Of
/// the surface only what a ray along +x from the point meets is told as such.
MeshSide side_of_mesh(std::span<const Vec3> vertices, std::span<const Triangle> triangles, const Vec3& point);

}  // namespace gridcull
