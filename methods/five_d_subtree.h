// One part of the five-dimensional tree, by one thread, depth first (Gotsman, Sudarsky, Fayman 1999, section 4).
#pragma once

#include <atomic>

#include "gridcull/methods/five_d_code.h"
#include "gridcull/methods/five_d_leaf.h"
#include "gridcull/methods/five_d_split.h"

namespace gridcull {

/// A tree in the making, or a part of one.
struct Subtree {
  FiveDTree tree{};
  std::uint64_t cells = 0, rays = 0;
};

/// Appends `part` behind the nodes of `whole`.
void append(FiveDTree& whole, const FiveDTree& part, const FiveDSpace& space);
/// Makes one leaf of the inner node `node`, the last but its children, when these are leaves with equal sets.
void merge_equal_leaves(FiveDTree& tree, std::size_t node, const FiveDSpace& space);

class SubtreeBuilder {
 public:
  /// `done` grows by the share of the world that is done, in units of 2^-50; `stop` ends the work early.
  SubtreeBuilder(const FiveDScene& scene, const FiveDOptions& options, const SequentialTest& test,
                 std::atomic<std::uint64_t>& done, const std::atomic<bool>& stop)
      : scene_(scene), options_(options), test_(test), done_(done), stop_(stop) {}

  /// Of no use when `stop` was set meanwhile.
  Subtree build(CellWork work);

 private:
  std::uint32_t grow(CellWork work);
  void add_leaf(const CellWork& work);
  void add_eighths(const LeafSets& sets, int first, int count);

  const FiveDScene& scene_;
  const FiveDOptions& options_;
  const SequentialTest& test_;
  std::atomic<std::uint64_t>& done_;
  const std::atomic<bool>& stop_;
  FiveDScene::Scratch scratch_{};
  Subtree out_{};
};

}  // namespace gridcull
