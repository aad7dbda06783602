// The surface of a convex body: vertices and faces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gridcull/core/vec.h"

namespace gridcull {

/// In 3D a closed convex polyhedron; a flat one is one polygon with its two sides as faces. In 2D (z = 0) a convex
/// polygon, counter-clockwise, as the one face. What has no area (a segment, a point) has vertices only.
struct ConvexBoundary {
  struct Face {
    Vec3 normal{0.0};         ///< outward, length 1 up to rounding; 2D: +z
    std::uint32_t first = 0;  ///< its loop is loops[first .. first + count)
    std::uint32_t count = 0;  ///< at least 3
  };
  std::vector<Vec3> vertices;        ///< metres
  std::vector<std::uint32_t> loops;  ///< vertex numbers, counter-clockwise seen from outside
  std::vector<Face> faces;

  void clear() { vertices.clear(), loops.clear(), faces.clear(); }
  /// Triangles that a renderer would draw: fans of the faces.
  std::size_t triangles() const { return loops.size() - 2 * faces.size(); }
};

/// Newell's normal of a face: twice the area, along the outward normal.
Vec3 area_normal(const ConvexBoundary& boundary, const ConvexBoundary::Face& face);

/// Square metres. 3D: of all faces; a flat one's two sides both count. 2D: of the polygon.
double area_of(const ConvexBoundary& boundary);
/// Cubic metres inside; 0 for what is flat.
double volume_of(const ConvexBoundary& boundary);
/// Metres around the face: a 2D polygon's perimeter.
double length_of(const ConvexBoundary& boundary, const ConvexBoundary::Face& face);

}  // namespace gridcull
