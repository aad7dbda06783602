#include "gridcull/sim/in_view.h"

#include <algorithm>

#include "gridcull/core/view_volume.h"

namespace gridcull {

std::uint64_t count_in_view(const World& world, std::span<const View> views) {
  std::uint64_t count = 0;
  for (const View& view : views) {
    const ViewVolume volume(view, world.dimension());
    const auto in_view = [&](const Object& o) { return o.id != view.rides && volume.may_touch(o.shape, o.pose); };
    count += static_cast<std::uint64_t>(std::count_if(world.objects().begin(), world.objects().end(), in_view));
  }
  return count;
}

}  // namespace gridcull
