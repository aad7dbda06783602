// Convex cones that do not lie wholly before a face are clipped here, one plane after the other.
#pragma once

#include "gridcull/core/vec.h"
#include "gridcull/grid/mask_kernels.h"

namespace gridcull::masking {

/// To the nearest multiple of 2^-32; magnitudes below 2^19.
inline double snapped(double x) {
  constexpr double snap = 1.5 * 0x1p20;
  return (x + snap) - snap;
}

/// Repeats the last corner up to a multiple of eight.
void pad(Polygon& polygon);

enum class Clipped {
  empty,    ///< nothing within the guards
  polygon,  ///< the part within the guards
  unsure    ///< rays so nearly opposite that the margins would exceed 2^-22 of the face's scale
};

/// The cone spanned by 3 .. 64 rays in cyclic order, within the face's guards.
Clipped clip_cone(const Window& window, const Vec3* rays, int count, Polygon& out);

}  // namespace gridcull::masking
