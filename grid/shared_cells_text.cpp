// The texts beside a volume file's grids.
#include <algorithm>
#include <charconv>
#include <string>

#include "gridcull/core/error.h"
#include "gridcull/grid/shared_cells.h"
#include "gridcull/grid/static_tiles.h"

namespace gridcull {
namespace {

[[noreturn]] void refuse(std::string_view what) { throw Error(ErrorCode::bad_scene, "expected " + std::string(what)); }

/// Takes a number off the front; false when there is none.
template <class T>
bool take_number(std::string_view& text, T& value, int base = 10) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (fault != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

bool take(std::string_view& text, char c) {
  if (text.empty() || text.front() != c) return false;
  text.remove_prefix(1);
  return true;
}

std::uint32_t member_of(ObjectId id, const StaticCells& cells) {
  const auto at =
      std::lower_bound(cells.members.begin(), cells.members.end(), id,
                       [](const StaticCells::Member& member, ObjectId wanted) { return member.id < wanted; });
  if (at == cells.members.end() || at->id != id)
    refuse("lists of objects that the file names, found " + std::to_string(id));
  return static_cast<std::uint32_t>(at - cells.members.begin());
}

std::string hexadecimal(std::uint64_t value) {
  char digits[16];
  const auto end = std::to_chars(digits, digits + 16, value, 16).ptr;
  return {digits, end};
}

}  // namespace

std::string lists_text(const SharedCells& shared, const StaticCells& cells) {
  std::string text;
  for (const auto& list : shared.lists) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (i > 0) text += ' ';
      text += std::to_string(cells.members[list[i].member].id);
      if (list[i].fills) text += '*';
    }
    text += '\n';
  }
  return text;
}

std::vector<std::vector<SharedCells::Owner>> parse_lists(std::string_view text, const StaticCells& cells) {
  std::vector<std::vector<SharedCells::Owner>> lists;
  while (!text.empty()) {
    auto& list = lists.emplace_back();
    do {
      ObjectId id = no_id;
      if (!take_number(text, id)) refuse("a list of ids in each line");
      const std::uint32_t member = member_of(id, cells);
      if (!list.empty() && list.back().member >= member) refuse("lists whose ids ascend");
      list.push_back({member, take(text, '*')});
    } while (take(text, ' '));
    if (!take(text, '\n')) refuse("a list of ids in each line");
  }
  return lists;
}

std::string members_text(const StaticCells& cells) {
  std::string text;
  for (const StaticCells::Member& member : cells.members) {
    text += std::to_string(member.id) + ' ' + hexadecimal(member.hash) + (member.outside ? "*\n" : "\n");
  }
  return text;
}

std::vector<StaticCells::Member> parse_members(std::string_view text) {
  std::vector<StaticCells::Member> members;
  while (!text.empty()) {
    StaticCells::Member member;
    if (!take_number(text, member.id) || !take(text, ' ') || !take_number(text, member.hash, 16)) {
      refuse("an id and a hash in each line of objects");
    }
    member.outside = take(text, '*');
    if (!take(text, '\n')) refuse("an id and a hash in each line of objects");
    if (!members.empty() && members.back().id >= member.id) refuse("objects whose ids ascend");
    members.push_back(member);
  }
  return members;
}

std::string tiles_text(std::span<const StaticTile> tiles, const StaticCells& cells) {
  std::string text;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (tiles[i].members.empty()) continue;
    text += std::to_string(i) + ' ' + std::to_string(tiles[i].covers) + ' ' + std::to_string(tiles[i].blocks) + ' ' +
            hexadecimal(tiles[i].hash);
    for (const std::uint32_t member : tiles[i].members) text += ' ' + std::to_string(cells.members[member].id);
    text += '\n';
  }
  return text;
}

std::vector<StaticTile> parse_tiles(std::string_view text, const StaticCells& cells, const TileLayout& layout) {
  std::vector<StaticTile> tiles(layout.count());
  for (std::uint64_t next = 0; !text.empty();) {
    std::uint64_t number = 0;
    if (!take_number(text, number) || number < next || number >= tiles.size()) refuse("numbers of tiles that ascend");
    next = number + 1;
    StaticTile& tile = tiles[number];
    if (!take(text, ' ') || !take_number(text, tile.covers) || !take(text, ' ') || !take_number(text, tile.blocks) ||
        !take(text, ' ') || !take_number(text, tile.hash, 16)) {
      refuse("two counts and a hash for each tile");
    }
    while (take(text, ' ')) {
      ObjectId id = no_id;
      if (!take_number(text, id)) refuse("ids of a tile's objects");
      const std::uint32_t member = member_of(id, cells);
      if (!tile.members.empty() && tile.members.back() >= member) refuse("tiles whose ids ascend");
      tile.members.push_back(member);
    }
    if (!take(text, '\n') || tile.members.empty()) refuse("ids of a tile's objects");
  }
  return tiles;
}

}  // namespace gridcull
