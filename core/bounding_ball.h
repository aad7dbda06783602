// A small ball around points.
#pragma once

#include <span>

#include "gridcull/core/vec.h"

namespace gridcull {

struct Ball {
  Vec3 centre{0.0};
  double radius = 0.0;  ///< metres
};

/// Holds every point; O(n). Within a few per cent of the least one: T. Larsson, "Fast and tight fitting bounding
/// spheres" (2008), the points farthest along the 13 directions of a 26-DOP, and M. Badoiu and K. Clarkson's iteration
/// (2003) on those; never larger than the ball about the middle of the box. Not empty. 2D: z = 0.
Ball ball_around(std::span<const Vec3> points);

}  // namespace gridcull
