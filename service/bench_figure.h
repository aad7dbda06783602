// Figures of the papers, made again: `gridcull bench --figure NAME`.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gridcull/service/bench_charts.h"

namespace gridcull {

/// What a figure runs.
struct FigurePlan {
  std::vector<std::string> scenes{}, methods{};
  std::vector<double> cells{};  ///< metres
  std::uint64_t frames = 0, judged = 0;
  bool bake = false;         ///< methods that bake do it first
  bool more_scenes = false;  ///< may be asked for besides
};

/// "batagelo-5": Batagelo and Wu 2002, figure 5: time against hidden movers, time of a walkthrough with 200 moving and
/// 4,800 static objects frame by frame, and objects reported in it. "speed-accuracy": every method with every setting
/// on every kind of made scene. Throws Error(usage) for another name.
FigurePlan figure_plan(const std::string& name);

/// The charts of the figure that bench_charts() does not make by itself.
std::vector<Chart> figure_charts(const std::string& name, std::span<const BenchSceneResult> results);

}  // namespace gridcull
