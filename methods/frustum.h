// View frustum culling only: what every renderer does first, and the looseness all others are measured by.
#pragma once

#include <memory>
#include <optional>

#include "gridcull/core/bound_kind.h"
#include "gridcull/core/culler.h"

namespace gridcull {

/// Reports every object that may touch the view volume. `dimension` 2 or 3. `bound`: the volume of each object that is
/// tested, in its local axes; none: its own points.
std::unique_ptr<Culler> make_frustum_culler(int dimension, std::optional<BoundKind> bound = {});

const MethodInfo& frustum_culler_info();

}  // namespace gridcull
