// Temporal bounding volumes in an octree (Sudarsky and Gotsman 1999, "Dynamic scene occlusion culling", as Batagelo
// and Wu 2002, section 2, tell it): leaves list the volumes that touch them, and a volume that gets a new place is
// moved below the least common ancestor of its old and new place only. Batagelo and Wu's conclusion leaves open how
// this compares with T (tbv_matrix.h): `gridcull bench --figure tbv-upkeep` measures it. The engine does not use it.
//
// A leaf with too many volumes is split into eight, and eight leaves with few are merged. Leaves stay a few cells wide:
// volumes overlap, and halves of a leaf that all of its volumes touch only multiply the entries.
//
// Claim: a volume that touches cells asked about is found. Some point of it lies in one of them, up to the lattice's
// margin. The leaf around that point is reached, since the cells' box is grown by two margins, and lists the volume,
// since volumes are entered as if they were two margins larger.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "gridcull/grid/identifier_matrix.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/grid/tbv_ball.h"

namespace gridcull {

class TbvOctree {
 public:
  struct Limits {
    std::uint32_t split = 16;     ///< volumes a leaf may list before it is split
    std::uint32_t merge = 8;      ///< entries of eight leaves that are merged; less than `split`
    std::int64_t least_side = 8;  ///< cells: no leaf gets smaller
  };

  /// `lattice`: 3D; outlives the octree.
  explicit TbvOctree(const Lattice& lattice) : TbvOctree(lattice, Limits{}) {}
  TbvOctree(const Lattice& lattice, const Limits& limits);

  /// Room for slots 0 .. count - 1.
  void reserve(std::size_t count);

  bool holds(Slot slot) const { return slot < volumes_.size() && volumes_[slot].entries != none; }
  /// The slot must not be there; the ball lies in the lattice.
  void insert(Slot slot, const TbvBall& ball);
  void erase(Slot slot);
  /// Gives a volume that is there another ball, in the lattice too.
  void renew(Slot slot, const TbvBall& ball);
  std::uint64_t size() const { return size_; }

  /// Calls f(slot), once each, for every volume that touches one of the cells `bits` of the brick and for which
  /// wanted(slot). f must not change the octree.
  template <class W, class F>
  TbvLook touching(std::size_t brick, std::uint64_t bits, W&& wanted, F&& f);
  /// Nodes and entries written so far.
  std::uint64_t places_written() const { return written_; }
  std::uint64_t bytes() const;

  /// For tests: f(box, depth, slots) for every leaf.
  template <class F>
  void for_each_leaf(F&& f) const;
  /// For tests: what is broken among links, counts and limits; empty: nothing.
  std::string_view fault() const;

 private:
  struct Node {
    std::uint32_t parent = none;
    std::uint32_t child = none;  // first of eight in a row; none: a leaf
    std::uint32_t head = none;   // leaf: its entries
    std::uint32_t size = 0;      // leaf: its entries; else those of its children that are leaves
    std::uint32_t x = 0, y = 0, z = 0;
    std::uint16_t depth = 0;
    std::uint16_t inner = 0;  // children that are no leaves
  };
  /// A volume in a leaf's list.
  struct Entry {
    Slot slot = none;
    std::uint32_t leaf = none;
    std::uint32_t before = none, after = none;  // in the leaf; free entries hang on `after`
    std::uint32_t last = none, next = none;     // of the volume
  };
  struct Volume {
    TbvBall ball;
    std::uint32_t entries = none;
    std::uint32_t stamp = 0;  // the visit that saw it last
  };

  Bounds box_of(const Node& node) const;
  /// Whether the ball, grown by two margins, touches the node; whether the node holds it, grown by three.
  bool touches(const TbvBall& ball, const Node& node) const;
  bool inside(const TbvBall& ball, const Node& node) const;
  std::uint32_t common_ancestor(std::uint32_t leaf, const TbvBall& old_ball, const TbvBall& new_ball) const;
  /// Enters the volume into the leaves below the node that it touches.
  void enter(std::uint32_t node, Slot slot);
  void take_out(Slot slot);
  void link(std::uint32_t leaf, Slot slot);
  void unlink(std::uint32_t entry);
  void split(std::uint32_t leaf);
  void merge(std::uint32_t node);
  /// Merges what take_out() has left nearly empty.
  void settle();
  std::string_view fault_of(std::uint32_t node) const;
  std::uint32_t begin_visit();
  /// Puts the children of an inner node that the cells' box reaches, which reaches the node, on the stack.
  void open_children(const Node& node, const BrickCells& asked);

  const Lattice& lattice_;
  Limits limits_;
  Vec3 origin_;
  std::array<double, 16> sides_{};  // by depth, metres
  std::uint16_t deepest_ = 0;       // depth of the smallest leaves
  std::vector<Node> nodes_;
  std::vector<Entry> entries_;
  std::vector<Volume> volumes_;
  std::uint32_t free_nodes_ = none, free_entries_ = none;
  std::vector<std::uint32_t> thinned_;  // parents of leaves that lost a volume
  std::vector<std::uint32_t> stack_;
  std::uint32_t stamp_ = 0;
  std::uint64_t size_ = 0;
  std::uint64_t written_ = 0;
};

template <class W, class F>
TbvLook TbvOctree::touching(std::size_t brick, std::uint64_t bits, W&& wanted, F&& f) {
  const BrickCells asked(lattice_, brick, bits);
  TbvLook look;
  const std::uint32_t stamp = begin_visit();
  stack_.assign(1, 0);
  while (!stack_.empty()) {
    const Node& node = nodes_[stack_.back()];
    stack_.pop_back();
    ++look.places;
    if (node.child != none) {
      open_children(node, asked);
      continue;
    }
    for (std::uint32_t e = node.head; e != none; e = entries_[e].after) {
      const Slot slot = entries_[e].slot;
      Volume& volume = volumes_[slot];
      if (volume.stamp == stamp) continue;
      volume.stamp = stamp;
      ++look.volumes;
      if (asked.near(volume.ball) && wanted(slot) && asked.touch(volume.ball)) f(slot);
    }
  }
  return look;
}

template <class F>
void TbvOctree::for_each_leaf(F&& f) const {
  std::vector<std::uint32_t> open{0};
  std::vector<Slot> slots;
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (node.child != none) {
      for (std::uint32_t i = 0; i < 8; ++i) open.push_back(node.child + i);
      continue;
    }
    slots.clear();
    for (std::uint32_t e = node.head; e != none; e = entries_[e].after) slots.push_back(entries_[e].slot);
    f(box_of(node), node.depth, slots);
  }
}

}  // namespace gridcull
