// Whether every viewer moved from cell to neighbouring cell: the condition under which a hollow temporal
// bounding volume is safe (Batagelo and Wu 2002, section 4.1).
#pragma once

#include <cstdlib>
#include <span>
#include <unordered_map>
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
      const auto last = last_.find(view.viewer);
      if (last == last_.end() || last->second.rides != view.rides || distance(last->second.cell, cell) > 1) {
        jumpers_.push_back(cell);
      }
      next_[view.viewer] = {cell, view.rides};
      cells_.push_back(cell);
    }
    last_.swap(next_);
  }

  /// After a frame that was not answered to its end nobody's path is known.
  void forget() { last_.clear(); }

  std::span<const Cell> jumpers() const { return jumpers_; }
  std::span<const Cell> cells() const { return cells_; }

 private:
  struct Step {
    Cell cell;
    ObjectId rides;
  };
  static std::int64_t distance(const Cell& a, const Cell& b) {
    return std::max({std::llabs(a.x - b.x), std::llabs(a.y - b.y), std::llabs(a.z - b.z)});
  }

  std::unordered_map<ViewerId, Step> last_, next_;  // looked up only, never iterated
  std::vector<Cell> jumpers_, cells_;
};

}  // namespace gridcull
