// What `gridcull info --advise` prints.
#pragma once

#include <string>

#include "gridcull/service/advice_run.h"

namespace gridcull {

/// What is measured, a table of the settings, the occluders that no cell catches, and the advice.
std::string advice_text(const AdvicePlan& plan, const PreparedWorld& world, const Advice& advice);

}  // namespace gridcull
