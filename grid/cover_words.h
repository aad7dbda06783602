// Runs of cells into words of bricks.
#pragma once

#include <algorithm>
#include <cstdint>

#include "gridcull/grid/cover_frame.h"
#include "gridcull/grid/cover_scratch.h"

namespace gridcull::covering {

/// Bits low .. high of one row of a brick, 0 <= low <= high < edge.
inline std::uint64_t run(int low, int high) { return (std::uint64_t{2} << high) - (std::uint64_t{1} << low); }

/// Sets the bits of a run of cells in a row of bricks. `bricks[0]` is the brick at brick coordinate `first`,
/// `shift` the bit of the run's row in each word.
template <int edge, std::uint64_t BrickCover::*set>
void fill_run(BrickCover* bricks, std::int64_t first, int shift, const Range& cells) {
  for (std::int64_t b = cells.first / edge; b * edge <= cells.last; ++b) {
    const auto low = static_cast<int>(std::max<std::int64_t>(cells.first - b * edge, 0));
    const auto high = static_cast<int>(std::min<std::int64_t>(cells.last - b * edge, edge - 1));
    bricks[b - first].*set |= run(low, high) << shift;
  }
}

/// Appends empty bricks first .. last of a row; `base` is the index of the brick at x = 0.
inline BrickCover* append_bricks(std::vector<BrickCover>& out, std::size_t base, std::int64_t first,
                                 std::int64_t last) {
  const std::size_t from = out.size();
  out.resize(from + static_cast<std::size_t>(last - first + 1));
  BrickCover* bricks = out.data() + from;
  for (std::int64_t b = first; b <= last; ++b) {
    bricks[b - first] = {static_cast<std::uint32_t>(base + static_cast<std::size_t>(b)), 0, 0};
  }
  return bricks;
}

/// Removes bricks that touch nothing from position `from` on.
inline void drop_empty(std::vector<BrickCover>& bricks, std::size_t from) {
  std::size_t kept = from;
  for (std::size_t i = from; i < bricks.size(); ++i) {
    if (bricks[i].touched != 0) bricks[kept++] = bricks[i];
  }
  bricks.resize(kept);
}

}  // namespace gridcull::covering
