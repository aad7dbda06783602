// Claim. Each point within the piece's slack of the shape lies in the piece: convex_piece.h asks for vertices whose
// hull contains the shape; those of a bounding volume do (core/bounding_volume.h), and prism_piece() and hull_piece()
// take the shape's own points.
#include "gridcull/grid/bound_piece.h"

#include <algorithm>
#include <vector>

#include "gridcull/core/world_points.h"
#include "gridcull/grid/outline_hull.h"

namespace gridcull {
namespace {

/// A piece less thick than this times its size has too little slack to be used from far away.
constexpr double thin = 0x1p-17;

/// The box as the piece's own kind: its silhouettes come from a table. As thick as it has to be.
ConvexPiece box_of(const BoundingVolume& bound) {
  Vec3 centre, half;
  for (int k = 0; k < 3; ++k) {
    const double low = bound.slabs.low[static_cast<std::size_t>(k)],
                 high = bound.slabs.high[static_cast<std::size_t>(k)];
    centre[k] = 0.5 * (low + high);
    half[k] = 0.5 * (high - low) + bound.grown;  // which covers both sums' rounding, 2^-51 of the size
  }
  const double least = thin * std::max({half.x, half.y, half.z});
  return box_piece(centre, glm::max(half, Vec3(least)), Rounding::outward);
}

ConvexPiece polyhedron_of(const BoundingVolume& bound) {
  ConvexPiece piece = boundary_piece(bound.boundary);
  if (!piece.empty() && piece.inradius >= thin * piece.radius) return piece;
  Vec3 most(0.0);
  for (const Vec3& v : bound.boundary.vertices) most = glm::max(most, glm::abs(v - bound.boundary.vertices[0]));
  return boundary_piece(grown_boundary(bound, 2.0 * thin * std::max({most.x, most.y, most.z})));
}

ConvexPiece hull_of(const Shape& shape) {
  if (const auto* prism = std::get_if<Prism>(&shape)) {
    ConvexPiece piece = prism_piece(hull_of_outline(prism->vertices), 0.0, prism->height, Rounding::outward);
    if (!piece.empty()) return piece;
  }
  std::vector<Vec3> points;
  for_each_local_point(shape, [&](const Vec3& p) { points.push_back(p); });
  ConvexPiece piece = hull_piece(points, Rounding::outward);
  if (!piece.empty() && piece.inradius >= thin * piece.radius) return piece;
  return polyhedron_of(bound_of(shape, BoundKind::dop26));
}

}  // namespace

ConvexPiece bound_piece(const Shape& shape, BoundKind kind) {
  const bool ball = std::holds_alternative<Sphere>(shape);
  if (kind == BoundKind::sphere || (ball && kind == BoundKind::hull)) return {};
  if (std::holds_alternative<Cuboid>(shape) && kind == BoundKind::hull) kind = BoundKind::box;
  if (kind == BoundKind::hull) return hull_of(shape);
  const BoundingVolume bound = bound_of(shape, kind);
  return kind == BoundKind::box ? box_of(bound) : polyhedron_of(bound);
}

}  // namespace gridcull
