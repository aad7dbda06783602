// Occluders as convex pieces, and occludees as points: what extended projections are made of.
#pragma once

#include <limits>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/core/object.h"
#include "gridcull/methods/extended_polytope.h"
#include "gridcull/methods/extended_slice.h"

namespace gridcull::extended {

/// A convex part of an occluder, world coordinates.
struct Piece {
  Polytope polytope{};
  std::vector<Vec3> normals{};  ///< outward directions (any length) of planes that may part it from a cell
  /// Least extent along those, metres; infinity for faces, which need none.
  double width = std::numeric_limits<double>::infinity();
};

/// A static occluder. Its pieces lie in the shape, to within `blur`.
struct Occluder {
  ObjectId id = no_id;
  bool thin = false;  ///< holds no viewer
  double blur = 0.0;  ///< metres: roundings on the way from the shape's numbers to these points
  Bounds box{};
  bool upright = false;  ///< a box or prism whose sides are vertical: its lowest points are its base
  std::vector<Piece> pieces{};
  ConcavePrism concave{};  ///< the whole of a prism that is more than one piece
  // Its pieces and these hold all of its interior, and maybe more: where a viewpoint may be inside it.
  double ball = 0.0;  ///< radius about the box's centre; 0: none
  std::vector<Piece> covers{};
};

/// Pieces: the whole of a box and a hull; a polyhedron inscribed to a sphere; a prism over each convex part of an
/// outline (where a self-crossing outline runs through itself nothing is used); each triangle of faces, or two
/// that make up a flat convex quadrilateral.
Occluder make_occluder(const Object& object);

/// The interior of an outline (even-odd rule) in convex parts, disjoint, counter-clockwise: exact for a convex
/// outline, otherwise trapezoids between neighbouring heights, joined where that stays convex. Where edges cross
/// between two heights that band is left out, and a rectangle in `left_out` holds its interior.
struct OutlineParts {
  std::vector<std::vector<Vec2>> parts{};
  std::vector<std::vector<Vec2>> left_out{};
};
OutlineParts convex_parts_of(const std::vector<Vec2>& outline);

/// What is tested: the object's world points, or its ball.
struct Occludee {
  ObjectId id = no_id;
  bool ball = false;
  Vec3 centre{0.0};
  double radius = 0.0;
  std::vector<Vec3> points{};
  Bounds box{};  ///< world
};

Occludee make_occludee(const Object& object);

}  // namespace gridcull::extended
