// Occluder re-projection and the occlusion sweep (paper section 5).
#pragma once

#include <cstdint>
#include <vector>

#include "gridcull/methods/extended_map.h"
#include "gridcull/methods/extended_plane.h"

namespace gridcull::extended {

/// Carries what one plane's map hides to the next plane of the same facing; storage is reused.
class Sweep {
 public:
  /// Covers, with the depth of the first plane, the pixels of `far` that are hidden from the whole cell by what `map`
  /// holds in front of its plane. far.distance > near.distance, same half and facing.
  void carry(const Plane& near, const DepthMap& map, const Plane& far, DepthMap& out);

 private:
  void count(const Plane& near, const DepthMap& map);

  struct Run {
    int first = 0, last = -1;  ///< pixels of the near map that a far column or row is seen through; empty: it leaves it
  };
  void find_runs(const Plane& near, const Plane& far, int axis, std::vector<Run>& runs) const;

  std::vector<std::uint32_t> sums_{};  ///< summed-area table: pixels that are not covered, below and left of a corner
  std::vector<Run> columns_{}, rows_{};
};

}  // namespace gridcull::extended
