// Plays the worlds of the stability suite to one method each and holds every answer against the exact reference.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "gridcull/methods/catalog.h"
#include "gridcull/service/stability_limit.h"

namespace gridcull {

/// How a method fares at one value of a limit.
struct LimitResult {
  double value = 0.0;
  std::string refused{};  ///< why it did not run; "" when it did
  std::uint64_t queries = 0, exact = 0, reported = 0, misses = 0;
  double frame_us = 0.0;  ///< median over frames (the first apart) of the least over repeats; all viewers
  /// Objects that came or went between one frame's answer and the next, mean: reported, and really.
  double changes = 0.0, exact_changes = 0.0;

  double over_estimation() const;  ///< NaN where nothing is visible
};

/// One limit with one method.
struct LimitRow {
  const Limit* limit = nullptr;
  std::vector<LimitResult> results{};  ///< in the order of the limit's values
};

struct StabilityResult {
  const MethodEntry* method = nullptr;
  int dimension = 2;
  std::vector<LimitRow> rows{};
};

struct StabilitySettings {
  int repeats = 3;
  int rays = 128;  ///< 3D: along a cube face's edge
};

/// Calls `tick` after each world. All methods see the same worlds, one after the other at each value, so that what else
/// the machine does hits all alike. Throws Stopped on Ctrl-C.
std::vector<StabilityResult> run_stability(const std::vector<const MethodEntry*>& methods, int dimension,
                                           const StabilitySettings& settings, const std::function<void()>& tick,
                                           std::span<const Limit> limits = stability_limits());

}  // namespace gridcull
