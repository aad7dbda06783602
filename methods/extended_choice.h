// Which occluders are worth it from where (paper section 6.1, occluder selection; after H. Zhang et al. 1997 and
// T. Hudson et al. 1997).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/bounds.h"

namespace gridcull::extended {

/// About the solid angle (steradians, at most 2 pi) of a box seen from a point: its area across the line of sight by
/// the distance's square.
double solid_angle(const Bounds& box, const Vec3& from);

/// A kd-tree over viewpoints. Each node names the occluders that are worth it everywhere in its box; the leaves also
/// those that are somewhere in it.
class ChoiceTree {
 public:
  /// `boxes`: the occluders'. An occluder is worth it in the box around all points where its solid angle can reach
  /// `least_angle`.
  void build(std::span<const Bounds> boxes, double least_angle);
  /// Appends those that may be worth it somewhere in `cell`, ascending, each once.
  void find(const Bounds& cell, std::vector<std::uint32_t>& out) const;

 private:
  struct Node {
    Bounds box{};
    std::vector<std::uint32_t> worth{};
    std::uint32_t left = 0;  ///< children are left and left + 1; 0: a leaf
  };
  void split(std::uint32_t node, std::vector<std::uint32_t> candidates, int depth);
  std::vector<Bounds> regions_{};
  std::vector<Node> nodes_{};
};

}  // namespace gridcull::extended
