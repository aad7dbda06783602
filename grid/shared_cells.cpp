#include "gridcull/grid/shared_cells.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <unordered_map>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

constexpr std::uint32_t root = 0;

/// Lists as paths of a tree: a list is the one before its last owner, and that owner. Numbers come in the order of
/// first use, which is that of the bricks.
class ListTree {
 public:
  std::uint32_t child(std::uint32_t parent, const SharedCells::Owner& owner) {
    const std::uint64_t key = std::uint64_t{parent} << 32 | std::uint64_t{owner.member} << 1 | (owner.fills ? 1u : 0u);
    const auto [at, is_new] = children_.try_emplace(key, static_cast<std::uint32_t>(nodes_.size()));
    if (is_new) nodes_.push_back({parent, owner});
    return at->second;
  }
  /// The number of the list that ends at a node.
  std::uint32_t number(std::uint32_t node, std::vector<std::vector<SharedCells::Owner>>& lists) {
    numbers_.resize(nodes_.size(), none);
    if (numbers_[node] != none) return numbers_[node];
    numbers_[node] = static_cast<std::uint32_t>(lists.size());
    std::vector<SharedCells::Owner>& list = lists.emplace_back();
    for (std::uint32_t at = node; at != root; at = nodes_[at].parent) list.push_back(nodes_[at].owner);
    std::reverse(list.begin(), list.end());
    owners_ += list.size() + 4;
    return numbers_[node];
  }

  /// About what nodes and lists take.
  std::uint64_t bytes() const { return nodes_.size() * (sizeof(Node) + 64) + owners_ * sizeof(SharedCells::Owner); }

 private:
  static constexpr std::uint32_t none = 0xFFFF'FFFFu;
  struct Node {
    std::uint32_t parent;
    SharedCells::Owner owner;
  };
  std::vector<Node> nodes_{{root, {0, false}}};
  std::vector<std::uint32_t> numbers_;
  std::uint64_t owners_ = 0;
  std::unordered_map<std::uint64_t, std::uint32_t> children_;  // looked up, never walked
};

struct Place {
  std::uint32_t brick;
  std::uint32_t member;
  std::uint64_t at;  ///< in StaticCells::bricks
};

std::vector<Place> by_brick(const StaticCells& cells) {
  std::vector<Place> places;
  places.reserve(cells.bricks.size());
  for (std::uint32_t m = 0; m < cells.members.size(); ++m) {
    const StaticCells::Member& member = cells.members[m];
    for (std::uint64_t i = member.first; i < member.first + member.count; ++i) {
      places.push_back({cells.bricks[i].brick, m, i});
    }
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return a.brick != b.brick ? a.brick < b.brick : a.member < b.member;
  });
  return places;
}

/// Divides the cells of a brick by one more owner.
void divide(std::vector<SharedCells::Part>& parts, const BrickCover& cover, std::uint32_t member, ListTree& tree) {
  const std::size_t count = parts.size();
  for (std::size_t i = 0; i < count; ++i) {
    const SharedCells::Part part = parts[i];
    const auto keep = [&](std::uint64_t bits, bool fills) {
      if (bits != 0) parts.push_back({part.brick, tree.child(part.list, {member, fills}), bits});
    };
    keep(part.cells & cover.opaque, true);
    keep(part.cells & cover.touched & ~cover.opaque, false);
    parts[i].cells = part.cells & ~cover.touched;
  }
  std::erase_if(parts, [](const SharedCells::Part& part) { return part.cells == 0; });
}

}  // namespace

bool SharedCells::opaque(std::uint32_t list) const {
  return std::any_of(lists[list].begin(), lists[list].end(), [](const Owner& owner) { return owner.fills; });
}

SharedCells share_cells(const StaticCells& cells, std::uint64_t max_memory) {
  SharedCells out;
  ListTree tree;
  const std::vector<Place> places = by_brick(cells);
  std::vector<SharedCells::Part> parts;
  for (std::size_t i = 0; i < places.size();) {
    const std::uint32_t brick = places[i].brick;
    parts.assign(1, {brick, root, ~std::uint64_t{0}});
    for (; i < places.size() && places[i].brick == brick; ++i) {
      divide(parts, cells.bricks[places[i].at], places[i].member, tree);
    }
    for (SharedCells::Part& part : parts) {
      if (part.list == root) continue;
      part.list = tree.number(part.list, out.lists);
      out.parts.push_back(part);
    }
    const std::uint64_t bytes = out.parts.size() * sizeof(SharedCells::Part) + tree.bytes();
    if (bytes > max_memory) refuse_memory(max_memory);
  }
  return out;
}

void covers_of(std::span<const SharedCells::Part> parts, std::span<const std::vector<SharedCells::Owner>> lists,
               std::uint64_t max_memory, std::vector<MemberBrick>& out) {
  out.clear();
  for (const SharedCells::Part& part : parts) {
    if (part.list >= lists.size()) {
      throw Error(ErrorCode::bad_scene, "object: expected the number of a list, found " + std::to_string(part.list));
    }
    for (const SharedCells::Owner& owner : lists[part.list]) {
      out.push_back({owner.member, {part.brick, part.cells, owner.fills ? part.cells : 0}});
    }
    check_brick_memory(out.size(), max_memory);
  }
  std::sort(out.begin(), out.end(), [](const MemberBrick& a, const MemberBrick& b) {
    return a.member != b.member ? a.member < b.member : a.cover.brick < b.cover.brick;
  });
  // An object's cells of one brick may be of several parts.
  std::size_t kept = 0;
  for (const MemberBrick& next : out) {
    if (kept > 0 && out[kept - 1].member == next.member && out[kept - 1].cover.brick == next.cover.brick) {
      out[kept - 1].cover.touched |= next.cover.touched;
      out[kept - 1].cover.opaque |= next.cover.opaque;
    } else {
      out[kept++] = next;
    }
  }
  out.resize(kept);
}

void unshare_cells(const SharedCells& shared, std::uint64_t max_memory, StaticCells& cells) {
  std::vector<MemberBrick> covers;
  covers_of(shared.parts, shared.lists, max_memory, covers);
  cells.bricks.clear();
  cells.bricks.reserve(covers.size());
  for (StaticCells::Member& member : cells.members) member.count = 0;
  for (const MemberBrick& at : covers) {
    StaticCells::Member& member = cells.members.at(at.member);
    if (member.count++ == 0) member.first = cells.bricks.size();
    cells.bricks.push_back(at.cover);
  }
}

}  // namespace gridcull
