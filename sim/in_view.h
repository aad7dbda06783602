// How many objects touch the viewers' volumes, hidden or not: what a viewer would get without any occlusion.
#pragma once

#include <cstdint>
#include <span>

#include "gridcull/core/view.h"
#include "gridcull/sim/world.h"

namespace gridcull {

/// Sum over the views; a ridden object does not count. Tests every object for every view.
std::uint64_t count_in_view(const World& world, std::span<const View> views);

}  // namespace gridcull
