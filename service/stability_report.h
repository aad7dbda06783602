// What the stability suite says: a table a method for people, CSV for machines.
#pragma once

#include <span>
#include <string>

#include "gridcull/service/stability_run.h"

namespace gridcull {

/// Markdown: for each limit where the method misses, where it goes loose and where it goes slow.
std::string stability_table(const StabilityResult& result);

/// One line of names, one line a method, limit and value.
std::string stability_csv(std::span<const StabilityResult> results);

}  // namespace gridcull
