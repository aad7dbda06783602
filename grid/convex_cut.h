// Convex polygons in the plane: cutting, and exact questions about outlines.
#pragma once

#include <vector>

#include "gridcull/grid/convex_parts.h"

namespace gridcull {

/// A segment of an outline.
struct Wall {
  Vec2 a, b;
};

/// Closed outline without repeated points; pairs of walls that run along each other exactly cancel (a bridge to a
/// courtyard walked there and back is no wall: under the even-odd rule both sides are alike).
std::vector<Wall> walls_of(const std::vector<Vec2>& outline);

double area_of(const ConvexPart& part);

/// What lies to the left of the line from a to b; rounded, maybe empty.
ConvexPart cut_left(const ConvexPart& part, const Vec2& a, const Vec2& b);

/// Strictly convex and counter-clockwise, exactly: repeated, straight and rounded-in corners dropped. Empty when less
/// than a triangle is left.
ConvexPart strictly_convex(const ConvexPart& part);

/// Whether the wall meets the open interior; exact. The part: strictly convex, counter-clockwise.
bool intrudes(const Wall& wall, const ConvexPart& part);

/// Even-odd; exact for points on no wall.
bool is_inside(const std::vector<Wall>& walls, const Vec2& point);

/// Whether the open interior of the part lies in the outline's interior; exact.
bool lies_inside(const ConvexPart& part, const std::vector<Wall>& walls);

}  // namespace gridcull
