// What stands still in a flat world, for the walk of method `silhouette` in 2D (silhouette_walk_2d.h): boxes that fit
// tightly, eight in a row side by side, above them a tree of rows of boxes of rows. After the packed trees of
// S. Leutenegger, M. Lopez and J. Edgington, "STR: a simple and efficient algorithm for R-tree packing" (1997), split
// by the longer side instead of into tiles.
//
// Most of a town stands still, and most of it is behind something. In the loose index each building would be a ball
// of its own in a node that reaches far beyond it; here a row of eight is asked about as one box, which is tight, and
// then all eight at once. What is moved by hand or added later hangs in the loose index until that is worth another
// building.
//
// Claim: every member lies in its box, and every box in those of the rows above it. Boxes never shrink but by a
// rebuild: a member that leaves only empties its lane. Which members share a row changes no answer, but for ties.
//
// Cost: building n log^2 n once; 46 bytes a member with the rows above it, 4 a slot. Long members spoil the boxes of
// their rows: 200 lines of 1,000 m among 19,600 buildings cost 2 % of a view's instructions, 2,500 of them a fifth of
// its time.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/grid/box_lanes_2d.h"
#include "gridcull/grid/identifier_matrix.h"

namespace gridcull {

class StaticRows2D {
 public:
  static constexpr std::size_t lanes = BoxLanes::count;
  using Box = Box2D;

  /// World boxes, metres, and whose they are: slots in the lowest level, else rows of the level below.
  struct alignas(64) Row {
    BoxLanes boxes{};
    std::array<std::uint32_t, lanes> what{};
    std::uint8_t there = 0;      ///< lanes that are not empty
    std::uint8_t occluders = 0;  ///< lowest level: those of them that hide
  };
  struct Member {
    Slot slot = none;
    bool occluder = true;
    Box box{};
  };
  /// A row by its level (0: of members) and its number there.
  struct RowId {
    std::uint32_t level, number;
  };

  /// Holds these members and no others.
  void build(std::vector<Member>& members);
  /// Nothing when it is not there.
  void remove(Slot slot);
  bool holds(Slot slot) const { return slot < places_.size() && places_[slot] != none; }

  std::size_t size() const { return size_; }
  /// Members that have left since build().
  std::size_t holes() const { return holes_; }

  bool empty() const { return size_ == 0; }
  std::uint32_t top() const { return static_cast<std::uint32_t>(levels_.size()) - 1; }
  const Row& row(RowId id) const { return levels_[id.level][id.number]; }
  /// Of everything that was built.
  const Box& box() const { return box_; }
  static Box box_of(const Row& row, std::size_t lane) { return row.boxes.box(lane); }
  /// Hints that a row is needed soon.
  void prefetch(RowId id) const {
    const auto* row = reinterpret_cast<const char*>(&levels_[id.level][id.number]);
    for (std::size_t at = 0; at < sizeof(Row); at += 64) __builtin_prefetch(row + at);
  }

  /// Calls use(slot, occluder, box) for all members, for the next build().
  template <class Use>
  void for_each(Use&& use) const {
    if (levels_.empty()) return;
    for (const Row& row : levels_[0]) {
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        if ((row.there >> lane & 1) != 0) use(row.what[lane], (row.occluders >> lane & 1) != 0, box_of(row, lane));
      }
    }
  }

  std::uint64_t bytes() const;

 private:
  void add_level();

  std::vector<std::vector<Row>> levels_;
  std::vector<std::uint32_t> places_;  // by slot: lanes * its row + its lane
  std::size_t size_ = 0, holes_ = 0;
  Box box_{};
};

}  // namespace gridcull
