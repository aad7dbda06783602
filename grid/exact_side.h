// On which side of a line or plane a point lies, exactly. A method's own, as core/predicates.h belongs to the
// reference, with which methods share no code; another way to the same signs (tests hold the two against each other).
#pragma once

#include "gridcull/core/vec.h"

namespace gridcull {

/// Sign (-1, 0, 1) of cross2(b - a, p - a): 1 to the left of the line from a to b. Exact for coordinates that are 0 or
/// of magnitude 1e-60 .. 1e60.
int side_of_line(const Vec2& a, const Vec2& b, const Vec2& p);

/// Sign of dot(cross(b - a, c - a), p - a): 1 on the side from which a, b, c turn counter-clockwise. Exact as above.
int side_of_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p);

}  // namespace gridcull
