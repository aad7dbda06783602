// Signs of determinants, exact for the doubles given.
#pragma once

#include "gridcull/core/vec.h"

namespace gridcull {

/// Sign (-1, 0, 1) of cross2(b - a, c - a): 1 when c lies to the left of the line from a to b.
/// Exact for coordinates whose differences are 0 or of magnitude 1e-60 .. 1e60.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// Sign (-1, 0, 1) of dot(cross(b - a, c - a), d - a): 1 when d lies on the side from which a, b, c turn
/// counter-clockwise. Exact as above.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace gridcull
