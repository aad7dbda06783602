// Whether every viewer moved from cell to neighbouring cell: the condition under which a hollow temporal
// bounding volume is safe (Batagelo and Wu 2002, section 4.1).
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <span>
#include <vector>

#include "gridcull/core/view.h"
#include "gridcull/grid/lattice.h"

namespace gridcull {

class ViewerPaths {
 public:
  /// Takes the frame's views. A viewer that was not asked for in the last frame, or moved more than one cell
  /// in the chess metric, is a jumper: its path is not 8-connected (26 in 3D). So is one that rides on another
  /// object than before: what it rides on is never revealed to it, so it may have walked into that outline.
  void update(const Lattice& lattice, std::span<const View> views) {
    jumpers_.clear();
    cells_.clear();
    next_.clear();
    for (const View& view : views) {
      const Cell cell = lattice.cell_of(view.pose.position);
      const Step* last = find(view.viewer);
      if (last == nullptr || last->rides != view.rides || distance(last->cell, cell) > 1) jumpers_.push_back(cell);
      next_.push_back({view.viewer, static_cast<std::uint32_t>(next_.size()), view.rides, cell});
      cells_.push_back(cell);
    }
    std::sort(next_.begin(), next_.end(), [](const Step& a, const Step& b) {
      return a.viewer != b.viewer ? a.viewer < b.viewer : a.place < b.place;
    });
    last_.swap(next_);
  }

  /// After a frame that was not answered to its end nobody's path is known.
  void forget() { last_.clear(); }

  std::span<const Cell> jumpers() const { return jumpers_; }
  std::span<const Cell> cells() const { return cells_; }

 private:
  struct Step {
    ViewerId viewer;
    std::uint32_t place;  // among the frame's views
    ObjectId rides;
    Cell cell;
  };
  /// The viewer's last view of the last frame.
  const Step* find(ViewerId viewer) const {
    const auto after = std::upper_bound(last_.begin(), last_.end(), viewer,
                                        [](ViewerId id, const Step& step) { return id < step.viewer; });
    return after != last_.begin() && std::prev(after)->viewer == viewer ? &*std::prev(after) : nullptr;
  }
  static std::int64_t distance(const Cell& a, const Cell& b) {
    return std::max({std::llabs(a.x - b.x), std::llabs(a.y - b.y), std::llabs(a.z - b.z)});
  }

  std::vector<Step> last_, next_;  // by viewer, then place
  std::vector<Cell> jumpers_, cells_;
};

}  // namespace gridcull
