// Makes a failing world small: leaves out frames, objects, viewers and vertices and simplifies numbers, as long as
// it still fails (greedy delta debugging after Zeller and Hildebrandt 2002, one part at a time).
#pragma once

#include <functional>
#include <string>

#include "random_world.h"

namespace gridcull::test {

/// `fails` says whether a script still shows the fault; it holds for `script`. Tries at most `budget` scripts.
WorldScript shrink(WorldScript script, const std::function<bool(const WorldScript&)>& fails, int budget = 20000);

/// The script as a C++ initialiser that gives back the same bits, to be kept in tests/kept_misses.cpp.
std::string to_cpp(const WorldScript& script);

}  // namespace gridcull::test
