// The index of method `silhouette`: a hierarchy of regular grids with loose cells (DESIGN section 5.6; the
// hierarchy of Batagelo and Wu 2002, section 3, with one entry an object instead of one a cell).
//
// Every object, or the temporal bounding volume of a hidden one, is a single entry with a ball around it. It hangs
// in the node that holds the ball's centre, at the level whose side is at least the ball's diameter; so whatever
// hangs in a node lies within the node's box grown by half a side. Nodes count what hangs in them and below, so that
// empty space is skipped, and the eight (2D: four) children of a node share a cache line.
//
// Cost: placing an object is a division by the side and a compare when it stayed in its node; a few stores when it
// did not. Memory: 8 bytes a node of the levels in use, 64 an object.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/grid/identifier_matrix.h"

namespace gridcull {

/// A ball (2D: disc), metres.
struct LooseBall {
  Vec3 centre{0.0};
  double radius = 0.0;
};

class LooseIndex {
 public:
  /// A node by its level (0: the finest) and its coordinates there.
  struct NodeId {
    int level;
    std::int32_t x, y, z;  ///< z = 0 in 2D
  };
  struct Node {
    std::uint32_t first = none;  ///< slot of the first entry that hangs here
    std::uint32_t below = 0;     ///< entries here and below
  };

  /// `side`: metres of the finest level wished for, > 0; doubled until a level has at most 2^20 nodes.
  LooseIndex(int dimension, const Bounds& box, double side);

  /// Room for slots 0 .. count - 1.
  void reserve(std::size_t count);

  /// Whether place() takes the ball: its centre lies in the box and its radius is at most half the box's greatest
  /// extent. What it does not take the caller keeps elsewhere.
  bool takes(const LooseBall& ball) const;
  /// Enters the slot's ball or moves it. takes(ball).
  void place(Slot slot, const LooseBall& ball);
  /// Nothing when it is not there.
  void erase(Slot slot);
  /// Moves a ball that stays in its node and keeps its radius: false, and nothing done, when it does not or is not
  /// here.
  bool follow(Slot slot, const LooseBall& ball) {
    Entry& entry = entries_[slot];
    if (entry.level == nowhere || ball.radius != entry.ball.radius) return false;
    const double inverse = inverse_side(entry.level);
    const auto stays = [&](double x, double low, std::int32_t i) {
      const double t = (x - low) * inverse - static_cast<double>(i);
      return t >= 0.0 && t < 1.0;
    };
    const Vec3& c = ball.centre;
    if (!stays(c.x, box_.min.x, entry.x) || !stays(c.y, box_.min.y, entry.y)) return false;
    if (dimension_ == 3 && !stays(c.z, box_.min.z, entry.z)) return false;
    entry.ball.centre = c;
    return true;
  }
  /// Keeps the ball of a slot that is not here, for ball().
  void remember(Slot slot, const LooseBall& ball) { entries_[slot].ball = ball; }
  bool holds(Slot slot) const { return entries_[slot].level != nowhere; }
  const LooseBall& ball(Slot slot) const { return entries_[slot].ball; }
  std::uint64_t size() const { return size_; }
  /// Eight bits beside the ball for the caller's own use, 0 at first; nothing here reads or changes them.
  std::uint8_t& marks(Slot slot) { return entries_[slot].marks; }
  std::uint8_t marks(Slot slot) const { return entries_[slot].marks; }

  int dimension() const { return dimension_; }
  /// Nodes of the coarsest level: at most two along each axis.
  int top() const { return static_cast<int>(levels_.size()) - 1; }
  double side(int level) const { return levels_[static_cast<std::size_t>(level)].side; }
  /// Whether the node lies in the grid (children of a node at the upper edge may not).
  bool exists(const NodeId& id) const {
    const Level& level = levels_[static_cast<std::size_t>(id.level)];
    return id.x < level.nx && id.y < level.ny && id.z < level.nz;
  }
  /// The node's content; an empty node where its level is not in use.
  const Node& node(const NodeId& id) const {
    const Level& level = levels_[static_cast<std::size_t>(id.level)];
    return level.nodes.empty() ? empty_ : level.nodes[level.index(id, dimension_)];
  }
  /// The 8 (2D: 4) children of a node above the finest level, x fastest: child c is at 2 x + (c & 1) and so on. Those
  /// that lie beyond the grid are empty. nullptr where their level is not in use.
  const Node* children(const NodeId& id) const {
    const Level& level = levels_[static_cast<std::size_t>(id.level - 1)];
    if (level.nodes.empty()) return nullptr;
    return &level.nodes[level.index({id.level - 1, 2 * id.x, 2 * id.y, 2 * id.z}, dimension_)];
  }
  /// A node's loose box is its corner + side * [x - 1/2, x + 3/2] and so on, grown by the margin.
  const Vec3& corner() const { return box_.min; }
  double margin() const { return margin_; }
  Slot next(Slot slot) const { return entries_[slot].after; }
  /// Hints that a walk will come to the entry soon; `none` is fine.
  void prefetch(Slot slot) const {
    if (slot != none) __builtin_prefetch(&entries_[slot]);
  }
  /// Box that holds the balls of everything in the node and below (grown by half a side and the rounding).
  Bounds loose_box(const NodeId& id) const;

  std::uint64_t node_bytes() const;
  std::uint64_t entry_bytes() const { return entries_.capacity() * sizeof(Entry); }

 private:
  static constexpr std::uint8_t nowhere = 255;
  /// One cache line, all that a walk wants to know of most objects.
  struct alignas(64) Entry {
    LooseBall ball{};
    std::uint32_t before = none, after = none;
    std::uint32_t node = none;         // index in its level
    std::int32_t x = 0, y = 0, z = 0;  // the node's coordinates
    std::uint8_t level = nowhere;
    std::uint8_t marks = 0;
  };
  static_assert(sizeof(Entry) == 64);
  struct Level {
    std::int32_t nx, ny, nz;
    double side;
    double inverse_side;
    std::vector<Node> nodes{};  ///< made when first used; in blocks of siblings
    std::size_t index(const NodeId& id, int dimension) const {
      const auto bx = static_cast<std::size_t>((nx + 1) >> 1), by = static_cast<std::size_t>((ny + 1) >> 1);
      const std::size_t block = (static_cast<std::size_t>(id.z >> 1) * by + static_cast<std::size_t>(id.y >> 1)) * bx +
                                static_cast<std::size_t>(id.x >> 1);
      return block << dimension | static_cast<std::size_t>((id.x & 1) | (id.y & 1) << 1 | (id.z & 1) << 2);
    }
    std::size_t node_count(int dimension) const {
      return (static_cast<std::size_t>((nx + 1) >> 1) * static_cast<std::size_t>((ny + 1) >> 1) *
              static_cast<std::size_t>((nz + 1) >> 1))
             << dimension;
    }
  };

  double inverse_side(int level) const { return levels_[static_cast<std::size_t>(level)].inverse_side; }
  int level_for(double radius) const;
  NodeId node_of(const Vec3& centre, int level) const;
  void use_level(int level);
  void link(Slot slot, Node& node);
  void unlink(Slot slot, Node& node);
  void count(NodeId id, std::uint32_t step, int below);

  int dimension_;
  Bounds box_;
  double margin_;  // metres: covers the rounding of node_of()
  double inverse_side_;
  std::vector<Level> levels_;
  std::vector<Entry> entries_;
  std::uint64_t size_ = 0;
  Node empty_{};
};

}  // namespace gridcull
