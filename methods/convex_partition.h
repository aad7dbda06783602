// Convex parts of a simple outline that do not overlap, for methods that need convex occluders.
#pragma once

#include <vector>

#include "gridcull/core/vec.h"

namespace gridcull {

/// Counter-clockwise convex polygons (no angle above 180 degrees, no collinear corners) whose corners are points of
/// the outline and whose interiors lie in the outline's interior, exactly for the doubles given. A convex outline is
/// one part. Empty where the outline touches or crosses itself, or has more than 256 points: nothing is claimed then.
std::vector<std::vector<Vec2>> convex_partition(const std::vector<Vec2>& outline);

}  // namespace gridcull
