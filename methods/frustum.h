// View frustum culling only: what every renderer does first, and the looseness all others are measured by.
#pragma once

#include <memory>

#include "gridcull/core/culler.h"

namespace gridcull {

/// Reports every object that may touch the view volume. `dimension` 2 or 3.
std::unique_ptr<Culler> make_frustum_culler(int dimension);

const MethodInfo& frustum_culler_info();

}  // namespace gridcull
