// Temporal bounding volumes in a binary tree of boxes (a bounding volume tree). Like the octree (tbv_octree.h) it
// is there to be measured against T: `gridcull bench --figure tbv-upkeep`. The engine does not use it.
//
// A new volume goes beside the node where it adds least area (the usual greedy descent by the surface area heuristic,
// as in Catto's b2DynamicTree). A renewed one stays where it is: its leaf's box changes and the ancestors' boxes are
// refitted, up to the first that stays as it was. Refitting alone lets a tree of movers rot: neighbours part, and their
// common box grows. So each node refitted may swap a child for a grandchild where that makes a box smaller (tree
// rotations: Kopta, Ize, Spjut, Brunvand, Davis and Kensler 2012, "Fast, effective BVH updates for animated scenes"),
// and a volume that leaves the box of its fifth ancestor is taken out and put in anew. Never so, the boxes of a city's
// cars grow to twice the area within seconds; always so, upkeep costs three times as much (docs/tbv-upkeep.md).
//
// Claim: a volume that touches cells asked about is found. Its box meets the cells' box, which is grown by two margins
// of the lattice: that covers the margin of the exact test and the rounding of the box, about an ulp. Boxes of
// ancestors hold it without rounding.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "gridcull/grid/identifier_matrix.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/grid/tbv_ball.h"

namespace gridcull {

class TbvVolumeTree {
 public:
  /// Outlived by the lattice.
  explicit TbvVolumeTree(const Lattice& lattice) : lattice_(lattice) {}

  /// Room for slots 0 .. count - 1.
  void reserve(std::size_t count);

  bool holds(Slot slot) const { return slot < volumes_.size() && volumes_[slot].leaf != none; }
  /// The slot must not be there.
  void insert(Slot slot, const TbvBall& ball);
  void erase(Slot slot);
  /// Gives a volume that is there another ball.
  void renew(Slot slot, const TbvBall& ball);
  std::uint64_t size() const { return size_; }

  /// Calls f(slot), once each, for every volume that touches one of the cells `bits` of the brick and for which
  /// wanted(slot). f must not change the tree.
  template <class W, class F>
  TbvLook touching(std::size_t brick, std::uint64_t bits, W&& wanted, F&& f);
  /// Nodes written so far.
  std::uint64_t places_written() const { return written_; }
  std::uint64_t bytes() const;
  /// Sum of the inner nodes' areas over the root's: about how many of them a small question looks at.
  double cost() const;
  /// For tests: what is broken among links and boxes; empty: nothing.
  std::string_view fault() const;

 private:
  struct Node {
    Bounds box;
    std::uint32_t parent = none;  // free nodes hang on it
    std::uint32_t left = none;    // none: a leaf
    std::uint32_t right = none;   // leaf: its slot
    bool leaf() const { return left == none; }
  };
  struct Volume {
    TbvBall ball;
    std::uint32_t leaf = none;
  };

  static constexpr int home_levels = 5;

  std::uint32_t new_node();
  void free_node(std::uint32_t node);
  void hang_in(std::uint32_t leaf);
  /// Takes the leaf out of the tree, but keeps its node.
  void unhang(std::uint32_t leaf);
  std::uint32_t best_sibling(const Bounds& box) const;
  /// Refits the boxes from `node` up to the first that stays.
  void refit(std::uint32_t node);
  void rotate(std::uint32_t node);
  /// Swaps `child`, of `node`, for `grandchild`, which hangs below the other child.
  void swap(std::uint32_t node, std::uint32_t child, std::uint32_t grandchild);
  void replace_child(std::uint32_t parent, std::uint32_t before, std::uint32_t after);
  std::string_view fault_of(std::uint32_t node) const;

  const Lattice& lattice_;
  std::vector<Node> nodes_;
  std::vector<Volume> volumes_;
  std::uint32_t root_ = none, free_ = none;
  std::vector<std::uint32_t> stack_;
  std::uint64_t size_ = 0;
  std::uint64_t written_ = 0;
};

template <class W, class F>
TbvLook TbvVolumeTree::touching(std::size_t brick, std::uint64_t bits, W&& wanted, F&& f) {
  const BrickCells asked(lattice_, brick, bits);
  TbvLook look;
  stack_.clear();
  if (root_ != none) stack_.push_back(root_);
  while (!stack_.empty()) {
    const Node& node = nodes_[stack_.back()];
    stack_.pop_back();
    ++look.places;
    if (!asked.meet(node.box)) continue;
    if (!node.leaf()) {
      stack_.push_back(node.left);
      stack_.push_back(node.right);
      continue;
    }
    ++look.volumes;
    const Slot slot = node.right;
    const TbvBall& ball = volumes_[slot].ball;
    if (asked.near(ball) && wanted(slot) && asked.touch(ball)) f(slot);
  }
  return look;
}

}  // namespace gridcull
