// Occluders as shadow frusta take them: convex parts in local coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gridcull/core/pose.h"
#include "gridcull/core/shape.h"

namespace gridcull {

/// A convex set inside the shape: the hull of its vertices, or a ball. Vertices are points of the shape as given, so a
/// part lies in its shape exactly (thin shapes: in one of its faces or walls).
struct OccluderPart {
  static constexpr std::size_t most_faces = 64;

  enum class Kind : std::uint8_t {
    ball,     ///< Disc, Sphere: about the local origin
    solid,    ///< 3D, with faces and edges
    face,     ///< 3D, one triangle
    outline,  ///< 2D, counter-clockwise
    wall      ///< 2D, two points
  };
  /// Three of its vertices, counter-clockwise seen from outside, that span its plane well.
  using Face = std::array<std::uint16_t, 3>;
  /// Runs counter-clockwise about face `left`, clockwise about face `right`, both seen from outside.
  struct Edge {
    std::uint16_t from, to, left, right;
  };

  Kind kind = Kind::ball;
  std::vector<Vec3> vertices{};
  std::vector<Face> faces{};  ///< solid: all of them, at most most_faces
  std::vector<Edge> edges{};  ///< solid
  Vec3 centre{0.0};           ///< of the vertices
  double radius = 0.0;        ///< a ball's own; else about `centre`, to rank parts by
  double reach = 0.0;         ///< greatest distance from the local origin, rounded up
  /// solid, outline: about its least width, metres (over its faces: at most a few times too much).
  double width = 0.0;
  /// What it covers, to rank parts by. Square metres (2D: metres). Ball: x is its great circle (diameter); face, wall:
  /// area times normal; else the areas (widths) seen along each local axis.
  Vec3 area{0.0};
  bool flat = false;  ///< 2D
};

/// The convex parts of a shape that can be shown to lie inside it: of Polygon and Prism those of
/// methods/convex_partition.h; of Convex at most 34 corners; of Faces each triangle, of Polyline each wall, as they are
/// ("polygon soup").
std::vector<OccluderPart> make_occluder_parts(const Shape& shape);

/// The solid angle (2D: angle) that a part covers, roughly: area times the cosine towards the viewer over the distance
/// squared ("area-angle", Hudson et al. 1997, section 6.1, after Coorg and Teller). `sight`: from the viewer to the
/// part's centre, in local axes.
double area_angle(const OccluderPart& part, const Vec3& sight);

}  // namespace gridcull
