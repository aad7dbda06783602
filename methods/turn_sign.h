// The sign of a turn in the plane, exactly, for methods: the exact reference has predicates of its own.
#pragma once

#include "gridcull/core/vec.h"

namespace gridcull {

/// 1 when c lies to the left of the line from a to b, -1 to the right, 0 on it. Exact for coordinates that are 0 or of
/// magnitude 1e-120 .. 1e120.
int turn_sign(const Vec2& a, const Vec2& b, const Vec2& c);

}  // namespace gridcull
