// Where walls of different bodies cross each other, or the range: directions in which the order may change.
#pragma once

#include <vector>

#include "gridcull/core/exact_2d_walls.h"

namespace gridcull::exact {

/// Appends the turns of all crossings inside the range; a few that are none do no harm.
void add_crossings(const Surroundings& around, std::vector<double>& turns);

}  // namespace gridcull::exact
