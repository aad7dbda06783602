// `gridcull bench --figure tbv-upkeep`: what Batagelo and Wu 2002 leave for future work in their last sentence, the
// upkeep of temporal bounding volumes in the grid against that in hierarchies, over the number of hidden objects.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "gridcull/service/bench_charts.h"
#include "gridcull/service/tbv_replay.h"

namespace gridcull {

inline constexpr const char* tbv_figure = "tbv-upkeep";

struct TbvSettings {
  /// A city whose camera sees about the same street whatever its number of cars, and the paper's own kind of scene.
  std::vector<std::string> scenes{"city:50:1000",         "city:50:3000",         "city:50:10000",
                                  "city:50:30000",        "city:50:100000",       "city:50:200000",
                                  "spheres:1000:cell=1",  "spheres:3000:cell=1",  "spheres:10000:cell=1",
                                  "spheres:30000:cell=1", "spheres:100000:cell=1"};
  std::uint64_t frames = 120;
  std::uint64_t first = 60;  ///< the first that counts: terms have grown to their lengths
  int repeats = 3;
};

/// One scene. Means are over the frames that count.
struct TbvResult {
  std::string scene{};
  std::string family{};  ///< scenes that differ in their numbers of objects only
  std::size_t objects = 0;
  std::size_t frames = 0;  ///< that count
  double hidden = 0.0, looks = 0.0, born = 0.0, renewed = 0.0, removed = 0.0, revealed = 0.0;
  TbvCosts costs{};
};

/// Records the scene's tape and plays it. Throws what record_tbv_tape() and replay_tbv_tape() throw.
TbvResult run_tbv_scene(const std::string& scene, const TbvSettings& settings, const std::function<void()>& tick);

/// Calls of `tick` for all scenes together, at most.
std::uint64_t tbv_ticks(const TbvSettings& settings);

/// What the figures were measured with and how, as lines that begin with "#".
std::string tbv_head(const TbvSettings& settings);
/// A header line and a line an index and scene.
std::string tbv_csv(std::span<const TbvResult> results);
std::string tbv_table(const TbvResult& result);
/// Times over hidden volumes: "tbv-upkeep" of the first family, "tbv-upkeep-KIND" of others.
std::vector<Chart> tbv_charts(std::span<const TbvResult> results);

}  // namespace gridcull
