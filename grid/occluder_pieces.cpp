#include "gridcull/grid/occluder_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gridcull/core/bounds.h"
#include "gridcull/core/error.h"
#include "gridcull/core/hull.h"
#include "gridcull/core/volume.h"
#include "gridcull/grid/convex_parts.h"
#include "gridcull/grid/flat_polygons.h"
#include "gridcull/grid/outline_hull.h"

namespace gridcull {
namespace {

/// Dropped where it could not be built (too thin for its coordinates): an under-estimate.
void add(OccluderPieces& out, ConvexPiece piece) {
  if (!piece.empty()) out.pieces.push_back(std::move(piece));
}

double area_of(const FlatPolygon& polygon) {
  Vec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  }
  return glm::length(sum);
}

void add_faces(OccluderPieces& out, const Faces& faces) {
  std::vector<FlatPolygon> polygons = join_triangles(faces.vertices, faces.triangles);
  std::stable_sort(polygons.begin(), polygons.end(),
                   [](const FlatPolygon& a, const FlatPolygon& b) { return area_of(a) > area_of(b); });
  for (const FlatPolygon& polygon : polygons) add(out, flat_piece(polygon));
}

/// A volume's box of cells: its corners by bits.
ConvexPiece piece_of(const std::array<Vec3, 8>& corners) {
  const Vec3 &low = corners[0], &high = corners[7], half = 0.5 * (high - low);
  const bool along_axes = corners[1] == Vec3(high.x, low.y, low.z) && corners[2] == Vec3(low.x, high.y, low.z) &&
                          corners[4] == Vec3(low.x, low.y, high.z);
  // Both sums' rounding is far less than what inner_corners() has pulled in.
  if (along_axes && half.x > 0.0 && half.y > 0.0 && half.z > 0.0) {
    return box_piece(0.5 * (low + high), half, Rounding::inward);
  }
  return hull_piece(corners, Rounding::inward);
}

/// A box about all points along the given axes, a little thick where they are flat.
ConvexPiece box_about(const std::vector<Vec3>& points) {
  Bounds box;
  for (const Vec3& p : points) box.add(p);
  const Vec3 size = box.size();
  const double thin = 0x1p-16 * std::max({size.x, size.y, size.z});
  const Vec3 half = 0.5 * Vec3(std::max(size.x, thin), std::max(size.y, thin), std::max(size.z, thin));
  return box_piece(box.centre(), half * (1.0 + 0x1p-40), Rounding::outward);
}

/// The hull where it is small, else the box: never less than all points.
ConvexPiece hull_about(const std::vector<Vec3>& points) {
  ConvexPiece hull = hull_piece(points, Rounding::outward);
  return hull.empty() ? box_about(points) : hull;
}

ConvexPiece outer_prism(const Prism& prism) {
  const std::vector<Vec2> outline = hull_of_outline(prism.vertices);
  if (outline.size() <= 16) {
    ConvexPiece piece = prism_piece(outline, 0.0, prism.height, Rounding::outward);
    if (!piece.empty()) return piece;
  }
  std::vector<Vec3> points;
  for (const Vec2& p : prism.vertices) points.insert(points.end(), {{p, 0.0}, {p, prism.height}});
  return box_about(points);
}

}  // namespace

std::uint64_t OccluderPieces::bytes() const {
  std::uint64_t sum = sizeof(OccluderPieces);
  for (const ConvexPiece& piece : pieces) sum += piece.bytes();
  return sum;
}

OccluderPieces make_occluder_pieces(const Shape& shape) {
  OccluderPieces out;
  if (const auto* box = std::get_if<Cuboid>(&shape)) {
    add(out, box_piece(Vec3(0.0), 0.5 * box->size, Rounding::inward));
  } else if (const auto* prism = std::get_if<Prism>(&shape)) {
    for (const ConvexPart& part : convex_parts(prism->vertices)) {
      add(out, prism_piece(part, 0.0, prism->height, Rounding::inward));
    }
  } else if (const auto* convex = std::get_if<Convex>(&shape)) {
    add(out, hull_piece(convex->vertices, Rounding::inward));
  } else if (const auto* faces = std::get_if<Faces>(&shape)) {
    add_faces(out, *faces);
  } else if (const auto* volume = std::get_if<Volume>(&shape)) {
    for (const LatticeBox& cells : volume->body->inner) add(out, piece_of(inner_corners(*volume, cells)));
  }
  return out;
}

ConvexPiece make_outer_hull(const Shape& shape) {
  if (const auto* box = std::get_if<Cuboid>(&shape)) return box_piece(Vec3(0.0), 0.5 * box->size, Rounding::outward);
  if (const auto* prism = std::get_if<Prism>(&shape)) return outer_prism(*prism);
  if (const auto* convex = std::get_if<Convex>(&shape)) return hull_about(convex->vertices);
  if (const auto* faces = std::get_if<Faces>(&shape)) return hull_about(faces->vertices);
  if (const auto* volume = std::get_if<Volume>(&shape)) return hull_about(volume->body->outer);
  return {};
}

}  // namespace gridcull
