#pragma once

#include "gridcull/core/vec.h"

namespace gridcull {

/// The closed half-space dot(normal, p) >= offset; |normal| = 1 up to rounding.
struct HalfSpace {
  Vec3 normal{0.0};
  double offset = 0.0;
};

}  // namespace gridcull
