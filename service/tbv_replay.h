// A tape of volumes (tbv_tape.h) played to the grid's T, to an octree and to a volume tree: what their upkeep and their
// look-ups cost.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>

#include "gridcull/service/bench_sample.h"
#include "gridcull/service/tbv_tape.h"

namespace gridcull {

/// One index on one tape. Work and volumes are sums over the frames from `TbvCosts::first` on.
struct TbvCost {
  TimeSamples upkeep{};         ///< removing, adding and renewing, all of a frame's
  TimeSamples look_up{};        ///< all of a frame's looks
  std::uint64_t written = 0;    ///< cells, entries or nodes, by upkeep
  std::uint64_t visited = 0;    ///< cells or nodes, by looks
  std::uint64_t looked_at = 0;  ///< volumes, by looks
  std::uint64_t bytes = 0;      ///< at the end
};

inline constexpr std::array<std::string_view, 3> tbv_indexes{"grid", "octree", "volume tree"};

struct TbvCosts {
  std::size_t first = 0;  ///< the first frame that counts
  std::array<TbvCost, tbv_indexes.size()> of{};
  /// The volume tree's cost() at the end, and of a tree of the same volumes that was made at once.
  double tree_cost = 0.0, fresh_tree_cost = 0.0;
};

/// Plays the whole tape to each index in turn, `repeats` times over; one thread. Every index must reveal in every frame
/// what the engine revealed: throws std::logic_error otherwise. Calls `tick` after every frame. Stopped on Ctrl-C.
TbvCosts replay_tbv_tape(const TbvTape& tape, std::size_t first, int repeats, const std::function<void()>& tick);

}  // namespace gridcull
