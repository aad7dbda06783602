// Convex parts of an outline: few, large and overlapping.
#pragma once

#include <vector>

#include "gridcull/core/vec.h"

namespace gridcull {

/// Counter-clockwise, strictly convex, 3 to 32 vertices.
using ConvexPart = std::vector<Vec2>;

/// Convex polygons inside the closed outline (even-odd rule; concave, self-crossing, repeated and collinear points):
/// the interior of each lies in the outline's interior, exactly. Together they cover the outline up to slivers and
/// up to a bound on their number; the largest come first.
std::vector<ConvexPart> convex_parts(const std::vector<Vec2>& outline);

}  // namespace gridcull
