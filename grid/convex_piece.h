// A convex solid or flat polygon in local coordinates, held with its faces and edges, as the object side of the
// method `silhouette` uses it: pulled in for occluders, pushed out for what is tested.
//
// Claim (slack). An occluder's piece is its true shape scaled about `centre` by 1 - shrink, so that each of its points
// lies farther than `slack` inside the true shape; a tested hull is scaled by 1 + shrink, so that each point within
// `slack` of the true shape lies inside it. All that rounding does on the way to the viewer (to_world's rounding, a
// rotation whose columns are unit only to the last bits, this code's own sums; see SightFrame) moves points by
// less: sight_blur() <= slack is checked for each piece and viewer, else the piece is not used and the tested object
// counts as visible. So everything after this file may treat the computed points as points of the shape.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/convex_boundary.h"
#include "gridcull/grid/box_topology.h"

namespace gridcull {

struct ConvexPiece {
  static constexpr std::size_t max_vertices = 64, max_faces = 64;

  enum class Kind : std::uint8_t {
    box,    ///< axes are the local ones; told by `centre` and `half` alone
    solid,  ///< any polyhedron
    flat    ///< one polygon: face 0 seen from its normal's side, face 1 from the other
  };
  /// dot(normal, p) = offset, |normal| = 1 up to rounding, outward.
  struct Plane {
    Vec3 normal{0.0};
    double offset = 0.0;
  };
  /// Its loop is loops[first .. first + count).
  struct Face {
    Plane plane{};
    std::uint16_t first = 0, count = 0;
  };
  using Edge = box_topology::Edge;

  Kind kind = Kind::solid;
  Vec3 centre{0.0};       ///< a point well inside
  Vec3 half{0.0};         ///< box: half its sizes
  double inradius = 0.0;  ///< no face plane (flat: edge) is nearer to `centre`; metres
  double slack = 0.0;     ///< see the claim; metres
  double radius = 0.0;    ///< greatest distance of a vertex from `centre`, rounded up
  double reach = 0.0;     ///< greatest distance of a vertex from the local origin, rounded up
  // Empty for boxes, which are met most often: what a view asks of a box lies in two cache lines.
  std::vector<Vec3> vertices;       ///< metres; at most max_vertices
  std::vector<Face> faces;          ///< at most max_faces
  std::vector<std::uint8_t> loops;  ///< vertex numbers, counter-clockwise seen from outside
  std::vector<Edge> edges;

  /// There is no piece.
  bool empty() const { return kind != Kind::box && vertices.empty(); }
  std::size_t vertex_count() const { return kind == Kind::box ? 8 : vertices.size(); }
  /// Of a box by bits: 1 = +x, 2 = +y, 4 = +z.
  Vec3 vertex(std::size_t i) const {
    if (kind != Kind::box) return vertices[i];
    return {(i & 1) != 0 ? centre.x + half.x : centre.x - half.x, (i & 2) != 0 ? centre.y + half.y : centre.y - half.y,
            (i & 4) != 0 ? centre.z + half.z : centre.z - half.z};
  }
  std::size_t face_count() const { return kind == Kind::box ? 6 : faces.size(); }
  Plane plane(std::size_t face) const {
    if (kind != Kind::box) return faces[face].plane;
    const auto axis = static_cast<int>(face / 2);
    Plane plane{Vec3(0.0), half[axis] + (face % 2 == 0 ? -centre[axis] : centre[axis])};
    plane.normal[axis] = face % 2 == 0 ? -1.0 : 1.0;
    return plane;
  }
  /// Vertex numbers of a face.
  std::span<const std::uint8_t> loop(std::size_t face) const {
    if (kind == Kind::box) return box_topology::faces[face];
    return {loops.data() + faces[face].first, faces[face].count};
  }
  std::span<const Edge> all_edges() const {
    return kind == Kind::box ? std::span<const Edge>(box_topology::edges) : std::span<const Edge>(edges);
  }

  std::uint64_t bytes() const;
};

/// By how much a piece is scaled. The greater flat value pays for grazing views: there an error across the plane
/// moves the crossing along the plane by up to 1 / max_grazing times as much (piece_silhouette.cpp).
inline constexpr double solid_shrink = 0x1p-20, flat_shrink = 0x1p-15;

/// Which way a piece may err.
enum class Rounding : std::uint8_t { inward, outward };

/// Box about `centre`; half sizes > 0.
ConvexPiece box_piece(const Vec3& centre, const Vec3& half, Rounding rounding);

/// Convex outline, counter-clockwise, strictly convex, at most 32 vertices, swept from z = low to high.
ConvexPiece prism_piece(std::span<const Vec2> outline, double low, double high, Rounding rounding);

/// Hull of the points. Inward with too many vertices or faces: the hull of some of them. An empty piece (no
/// vertices) where there is no hull to speak of (flat), or, outward, where it has too many vertices.
ConvexPiece hull_piece(std::span<const Vec3> points, Rounding rounding);

/// A bounding volume's surface, outward. Empty where it has too many vertices or faces, or is too flat.
ConvexPiece boundary_piece(const ConvexBoundary& boundary);

/// Flat convex polygon, inward only: vertices in order about the normal, at most 32. Empty when degenerate.
ConvexPiece flat_piece(std::span<const Vec3> polygon);

}  // namespace gridcull
