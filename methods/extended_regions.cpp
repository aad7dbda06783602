#include "gridcull/methods/extended_regions.h"

#include <algorithm>
#include <cmath>

#include "gridcull/methods/extended_pieces.h"

namespace gridcull::extended {

Bounds MotionRegions::box(std::uint32_t region) const {
  const std::array<std::uint32_t, 3> at{region % count[0], region / count[0] % count[1], region / count[0] / count[1]};
  Bounds out;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<double>(at[static_cast<std::size_t>(k)]);
    // Grown by the millionth of any(), and the roundings of these lines.
    out.min[k] = origin[k] + (i - 2e-6) * edge[k];
    out.max[k] = origin[k] + (i + 1.0 + 2e-6) * edge[k];
  }
  out.min.z = std::max(out.min.z, origin.z);  // nothing that any() asks about reaches below
  return out;
}

MotionRegions choose_regions(std::span<const Object> objects, const Bounds& world, double edge, double floor,
                             std::uint32_t most) {
  Bounds heights;
  for (const Object& object : objects) {
    if (object.is_static) continue;
    const Bounds box = make_occludee(object).box;
    heights.add(box.min);
    heights.add(box.max);
  }
  MotionRegions out;
  if (heights.empty() || world.empty()) return out;
  Vec3 low = world.min, size = world.size();
  low.z = heights.min.z;
  size.z = heights.size().z;
  // A tenth more each way: movers bob.
  const double top = heights.max.z + 0.1 * size.z;
  low.z = std::max(low.z - 0.1 * size.z, floor);
  size.z = std::max(top - low.z, 0.0);
  out.origin = low;
  for (;; edge *= 1.25) {
    double boxes = 1.0;
    for (int k = 0; k < 3; ++k) {
      const double n = std::max(1.0, std::ceil(size[k] / edge - 1e-9));
      boxes *= n;
      out.count[static_cast<std::size_t>(k)] = n < 1e9 ? static_cast<std::uint32_t>(n) : 1000000000u;
      out.edge[k] = std::max(size[k] / n, 1e-9);
    }
    if (boxes <= most) return out;
  }
}

}  // namespace gridcull::extended
