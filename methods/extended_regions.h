// Motion regions: where moving occludees may be (paper section 6.2; the paper's are a city's roads).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/core/object.h"

namespace gridcull::extended {

/// A lattice of boxes over the world's ground plan, as high as the moving objects stand. Each is an occludee of the
/// bake; at run time a moving object is hidden when all boxes that it touches are. One that sticks out is always told.
struct MotionRegions {
  Vec3 origin{0.0};
  Vec3 edge{1.0};                        ///< of a box, metres
  std::array<std::uint32_t, 3> count{};  ///< of boxes; 0: none

  std::uint32_t size() const { return count[0] * count[1] * count[2]; }
  Bounds box(std::uint32_t region) const;
  /// Calls see(region) for the boxes that `box` may touch until one says true; true also when `box` sticks out.
  template <class See>
  bool any(const Bounds& box, const See& see) const;
};

/// Boxes of about `edge` metres over `world` (x and y) and the heights of the moving objects, but not below `floor`. No
/// more than `most` boxes: they grow instead.
MotionRegions choose_regions(std::span<const Object> objects, const Bounds& world, double edge, double floor,
                             std::uint32_t most);

template <class See>
bool MotionRegions::any(const Bounds& box, const See& see) const {
  std::array<std::uint32_t, 3> low{}, high{};
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    // A millionth of a box more than rounding could take away.
    const double a = (box.min[k] - origin[k]) / edge[k] - 1e-6, b = (box.max[k] - origin[k]) / edge[k] + 1e-6;
    // The lowest boxes end exactly where they begin, as what stands on the floor does.
    if (!(a >= (k == 2 && box.min.z >= origin.z ? -1.0 : 0.0) && b < count[axis])) return true;
    low[axis] = static_cast<std::uint32_t>(std::max(a, 0.0));
    high[axis] = static_cast<std::uint32_t>(b);
  }
  for (std::uint32_t z = low[2]; z <= high[2]; ++z) {
    for (std::uint32_t y = low[1]; y <= high[1]; ++y) {
      for (std::uint32_t x = low[0]; x <= high[0]; ++x) {
        if (see(x + count[0] * (y + count[1] * z))) return true;
      }
    }
  }
  return false;
}

}  // namespace gridcull::extended
