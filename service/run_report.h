// The short table that `run` prints.
#pragma once

#include <string>

#include "gridcull/core/culler.h"
#include "gridcull/service/world_options.h"
#include "gridcull/sim/stats.h"

namespace gridcull {

/// `seconds`: wall clock of the whole replay, reading included.
std::string run_table(const WorldOptions& options, const PreparedWorld& world, const MethodInfo& method,
                      const Stats& stats, double seconds);

/// "conservative" or "sampled".
std::string guarantee_text(Guarantee guarantee);

}  // namespace gridcull
