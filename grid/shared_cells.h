// Static cells by place instead of by object, as a volume file stores them: every touched cell has a number, that of
// the list of objects that share it. A list says of each object whether it fills the cell (the cell lies wholly inside
// it) or only touches it, so that nothing is lost on the way.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gridcull/grid/static_cells.h"

namespace gridcull {

struct SharedCells {
  struct Owner {
    std::uint32_t member;  ///< index into StaticCells::members
    bool fills;
    bool operator==(const Owner&) const = default;
  };
  /// Cells of one brick that share a list.
  struct Part {
    std::uint32_t brick;
    std::uint32_t list;
    std::uint64_t cells;
  };
  std::vector<std::vector<Owner>> lists;  ///< members ascend in each
  std::vector<Part> parts;                ///< bricks ascend

  /// Whether somebody fills the cells of the list.
  bool opaque(std::uint32_t list) const;
};

/// Throws Error(limit) for more than `max_memory` bytes.
SharedCells share_cells(const StaticCells& cells, std::uint64_t max_memory);

/// The parts by object, ascending by member and brick. Parts may come in any order. Throws Error(bad_scene) for numbers
/// that are not there, Error(limit) for more than `max_memory` bytes.
void covers_of(std::span<const SharedCells::Part> parts, std::span<const std::vector<SharedCells::Owner>> lists,
               std::uint64_t max_memory, std::vector<MemberBrick>& out);

/// The other way: sets `bricks` and every member's range of them. Throws as covers_of() does.
void unshare_cells(const SharedCells& shared, std::uint64_t max_memory, StaticCells& cells);

/// Lists as text, a line each: ids, with a * behind those who fill the cell.
std::string lists_text(const SharedCells& shared, const StaticCells& cells);
/// Throws Error(bad_scene) for what lists_text() would not write.
std::vector<std::vector<SharedCells::Owner>> parse_lists(std::string_view text, const StaticCells& cells);

/// A line for each member: id, hash in hexadecimal digits, and a * where it reaches beyond the lattice.
std::string members_text(const StaticCells& cells);
/// Throws Error(bad_scene) for what members_text() would not write.
std::vector<StaticCells::Member> parse_members(std::string_view text);

}  // namespace gridcull
