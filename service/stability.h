// `gridcull bench --stability`: every method, limit by limit (DESIGN section 1: "test stability where methods fail").
#pragma once

#include <string>
#include <vector>

#include "gridcull/service/stability_run.h"

namespace gridcull {

/// Runs the methods of these names (none: all) in 2D and 3D, prints a table for each, and writes stability.csv and
/// stability.md into the folder `out` unless that is empty. Throws Error(usage, io), Stopped on Ctrl-C.
int run_stability_bench(const std::vector<std::string>& methods, const StabilitySettings& settings,
                        const std::string& out);

}  // namespace gridcull
