// The index of method `silhouette`: a hierarchy of regular grids with loose cells (DESIGN section 5.6; the
// hierarchy of Batagelo and Wu 2002, section 3, with one entry an object instead of one a cell).
//
// Every object but those of static_rows_2d.h, or the temporal bounding volume of a hidden one, is a single entry with a
// ball around it. It hangs
// in the node that holds the ball's centre, at the level whose side is at least the ball's diameter; so whatever
// hangs in a node lies within the node's box grown by half a side. Nodes count what hangs in them and below, so that
// empty space is skipped, and the eight (2D: four) children of a node share a cache line.
//
// Cost: placing an object is a division by the side and a compare when it stayed in its node; a few stores when it
// did not. Memory: 12 bytes a node of the levels in use, 28 an object and 43 to 128 for its ball.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/grid/ball_rows.h"

namespace gridcull {

class LooseIndex {
 public:
  /// A node by its level (0: the finest) and its coordinates there.
  struct NodeId {
    int level;
    std::int32_t x, y, z;  ///< z = 0 in 2D
  };
  struct Node {
    std::uint32_t first = none;  ///< chunk of the first entries that hang here (rows())
    std::uint32_t below = 0;     ///< entries here and below
  };

  /// `side`: metres of the finest level wished for, > 0; doubled until a level has at most 2^20 nodes.
  LooseIndex(int dimension, const Bounds& box, double side);

  /// Room for slots 0 .. count - 1.
  void reserve(std::size_t count);

  /// Whether place() takes the ball: its centre lies in the box and its radius is at most half the box's greatest
  /// extent. What it does not take the caller keeps elsewhere.
  bool takes(const LooseBall& ball) const;
  /// Enters the slot's ball or moves it. takes(ball). (By value: it may be a ball of this index, which moves.) `room`:
  /// metres, at least so much of it is wished for in slack(); there may be less, as levels are bounded.
  void place(Slot slot, LooseBall ball, double room = 0.0);
  /// Metres that the ball of a slot that is here may go in any direction and still lie in its node's loose box.
  double slack(Slot slot) const {
    const Entry& entry = entries_[slot];
    return 0.5 * side(entry.level) - rows_[entry.place].ball.radius;
  }
  /// Nothing when it is not there.
  void erase(Slot slot);
  /// Moves a ball that stays in its node and keeps its radius: false, and nothing done, when it does not or is not
  /// here.
  bool follow(Slot slot, const LooseBall& ball) {
    const Entry& entry = entries_[slot];
    if (entry.level == nowhere) return false;
    LooseBall& old = rows_[entry.place].ball;
    if (ball.radius != old.radius || !stays(entry, ball.centre)) return false;
    old.centre = ball.centre;
    return true;
  }
  /// The same for a ball that keeps its radius for sure.
  bool follow(Slot slot, const Vec3& centre) {
    const Entry& entry = entries_[slot];
    if (entry.level == nowhere || !stays(entry, centre)) return false;
    rows_[entry.place].ball.centre = centre;
    return true;
  }
  /// Keeps the ball of a slot that is not here, for ball().
  void remember(Slot slot, LooseBall ball);
  bool holds(Slot slot) const { return entries_[slot].level != nowhere; }
  /// Of a slot that is here or remembered.
  const LooseBall& ball(Slot slot) const { return rows_[entries_[slot].place].ball; }
  /// Of a slot that is here or remembered: where its ball is now, for item().
  BallRows::Place place_of(Slot slot) const { return entries_[slot].place; }
  /// Places and items are good until something is placed, erased or remembered.
  const BallRows::Item& item(BallRows::Place place) const { return rows_[place]; }
  const BallRows& rows() const { return rows_; }
  std::uint64_t size() const { return size_; }
  /// Eight bits beside the ball for the caller's own use, 0 at first; nothing here reads or changes them.
  std::uint8_t marks(Slot slot) const { return entries_[slot].marks; }
  void set_marks(Slot slot, std::uint8_t marks) {
    Entry& entry = entries_[slot];
    entry.marks = marks;
    if (entry.place != none) rows_[entry.place].marks = marks;
  }
  /// Likewise two numbers that say how much of the ball's breadth and height is filled, 255 at first.
  void set_filling(Slot slot, std::uint8_t wide, std::uint8_t tall) {
    Entry& entry = entries_[slot];
    entry.wide = wide, entry.tall = tall;
    if (entry.place != none) rows_[entry.place].wide = wide, rows_[entry.place].tall = tall;
  }

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
  /// Calls use(item, place) for what hangs in a row (Node::first).
  template <class Use>
  void each(std::uint32_t first, Use&& use) const {
    while (first != none) {
      const BallRows::Chunk& chunk = rows_.chunk(first);
      rows_.prefetch(chunk.next);
      for (std::uint32_t i = 0; i < chunk.count; ++i) use(chunk.items[i], first * BallRows::chunk_items + i);
      first = chunk.next;
    }
  }
  /// Walks say which nodes' rows they looked at, for whoever chooses where to hang a ball: a note beside the content,
  /// which any thread may make at any time; all write the same value. `begin_frame`: from now on notes are of a new
  /// frame.
  void begin_frame() { ++frame_; }
  void note_opened(const NodeId& id) const {
    const auto level = static_cast<std::size_t>(id.level);
    std::atomic_ref(opened_[level][levels_[level].index(id, dimension_)]).store(frame_, std::memory_order_relaxed);
  }
  /// The same of the node that the slot's ball hangs in, if it hangs in one.
  void note_opened(Slot slot) const {
    const Entry& entry = entries_[slot];
    if (entry.level == nowhere) return;
    std::atomic_ref(opened_[entry.level][entry.node]).store(frame_, std::memory_order_relaxed);
  }
  /// Whether the node that a ball (takes(ball)) would hang in was opened in this frame or one of the last few.
  bool lately_opened(const LooseBall& ball) const {
    const NodeId id = node_of(ball.centre, level_for(ball.radius));
    const auto level = static_cast<std::size_t>(id.level);
    return !opened_[level].empty() && frame_ - opened_[level][levels_[level].index(id, dimension_)] <= lately;
  }

  /// Hints that the slot will be asked for soon.
  void prefetch(Slot slot) const { __builtin_prefetch(&entries_[slot]); }
  void prefetch_ball(Slot slot) const {
    if (entries_[slot].place != none) rows_.prefetch_item(entries_[slot].place);
  }
  /// Hints that the slot will leave its node soon, in the order in which memory is needed: what prefetch() asked for,
  /// its node and ball, the row's first chunk.
  void prefetch_node(Slot slot) const {
    const Entry& entry = entries_[slot];
    if (entry.level == nowhere) return;
    __builtin_prefetch(&levels_[entry.level].nodes[entry.node]);
    rows_.prefetch_item(entry.place);
  }
  void prefetch_row(Slot slot) const {
    const Entry& entry = entries_[slot];
    if (entry.level != nowhere) rows_.prefetch(levels_[entry.level].nodes[entry.node].first);
  }
  /// Box that holds the balls of everything in the node and below (grown by half a side and the rounding).
  Bounds loose_box(const NodeId& id) const;

  std::uint64_t node_bytes() const;
  std::uint64_t entry_bytes() const { return entries_.capacity() * sizeof(Entry) + rows_.bytes(); }

 private:
  static constexpr std::uint8_t nowhere = 255;
  static constexpr std::uint32_t lately = 8;  // frames
  struct Entry {
    BallRows::Place place = none;
    std::uint32_t node = none;         // index in its level
    std::int32_t x = 0, y = 0, z = 0;  // the node's coordinates
    std::uint8_t level = nowhere;
    std::uint8_t marks = 0;
    std::uint8_t wide = 255, tall = 255;
  };
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

  int level_for(double radius) const;
  int level_with(double radius, double room) const;
  double inverse_side(int level) const { return levels_[static_cast<std::size_t>(level)].inverse_side; }
  bool sparse(int level) const;
  NodeId node_of(const Vec3& centre, int level) const;
  void use_level(int level);
  bool stays(const Entry& entry, const Vec3& c) const {
    const double inverse = inverse_side(entry.level);
    const auto within = [&](double x, double low, std::int32_t i) {
      const double t = (x - low) * inverse - static_cast<double>(i);
      return t >= 0.0 && t < 1.0;
    };
    return within(c.x, box_.min.x, entry.x) && within(c.y, box_.min.y, entry.y) &&
           (dimension_ == 2 || within(c.z, box_.min.z, entry.z));
  }
  /// Adds the slot to the row, or takes it out.
  void link(Slot slot, const LooseBall& ball, std::uint32_t& row);
  void unlink(Slot slot, std::uint32_t& row);
  void count(NodeId id, std::uint32_t step, int below);

  int dimension_;
  Bounds box_;
  double margin_;  // metres: covers the rounding of node_of()
  double inverse_side_;
  std::vector<Level> levels_;
  mutable std::vector<std::vector<std::uint32_t>> opened_;  // by level and node: the last frame in which it was opened
  std::uint32_t frame_ = lately + 1;                        // so that at first no node was opened lately
  std::vector<Entry> entries_;
  BallRows rows_;
  std::uint32_t remembered_ = none;  // the row of those that are remembered
  std::uint64_t size_ = 0;
  int floor_ = 0;  // 3D: nothing new hangs in a finer level, where nodes would hold one entry or none
  Node empty_{};
};

}  // namespace gridcull
