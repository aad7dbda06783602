#include "gridcull/grid/loose_index.h"

#include <algorithm>

#include "gridcull/grid/object_table.h"

namespace gridcull {
namespace {

constexpr double most_nodes = 1 << 20;

/// Entries a node from which a level is worth having, were they all there; and how many levels may be passed over: few
/// objects in a wide world may stand close together.
constexpr std::size_t dense = 2;
constexpr int highest_floor = 2;
/// Levels that a ball may hang above the one that it needs, for room to move.
constexpr int most_raised = 2;

std::int32_t count_along(double extent, double side) {
  return static_cast<std::int32_t>(std::floor(extent / side)) + 1;
}

}  // namespace

// node_of() subtracts the box's corner, multiplies and truncates: three roundings, each below 2^-52 of the greatest
// coordinate. So a centre lies in its node's box grown by 2^-50 of that; margin_ is 2^6 times as much.
LooseIndex::LooseIndex(int dimension, const Bounds& box, double side) : dimension_(dimension), box_(box) {
  double magnitude = side;
  for (int k = 0; k < 3; ++k) magnitude = std::max({magnitude, std::fabs(box.min[k]), std::fabs(box.max[k])});
  margin_ = 0x1p-44 * magnitude;
  const Vec3 size = box.size();
  const auto make = [&](double s) {
    return Level{count_along(size.x, s), count_along(size.y, s), dimension == 3 ? count_along(size.z, s) : 1, s,
                 1.0 / s};
  };
  const auto nodes = [&](double s) {
    return (size.x / s + 1.0) * (size.y / s + 1.0) * (dimension == 3 ? size.z / s + 1.0 : 1.0);
  };
  while (nodes(side) > most_nodes) side *= 2.0;
  inverse_side_ = 1.0 / side;
  levels_.push_back(make(side));
  while (std::max({levels_.back().nx, levels_.back().ny, levels_.back().nz}) > 2) {
    const Level& fine = levels_.back();
    levels_.push_back(
        {(fine.nx + 1) >> 1, (fine.ny + 1) >> 1, (fine.nz + 1) >> 1, 2.0 * fine.side, 0.5 * fine.inverse_side});
  }
  opened_.resize(levels_.size());
}

void LooseIndex::reserve(std::size_t count) {
  grow(entries_, std::max(count, entries_.size()));
  rows_.reserve(entries_.capacity());
  if (dimension_ == 2) return;
  for (floor_ = 0; floor_ < std::min(top(), highest_floor) && sparse(floor_); ++floor_) {
  }
}

// Any level that is coarse enough for a ball will do (what hangs in finer ones since there were more stays there until
// it leaves its node), so that this is a matter of cost only.
bool LooseIndex::sparse(int level) const {
  return entries_.size() < dense * levels_[static_cast<std::size_t>(level)].node_count(dimension_);
}

int LooseIndex::level_for(double radius) const {
  const double sides = 2.0 * radius * inverse_side_;
  return sides <= 1.0 ? floor_ : std::max(floor_, std::ilogb(sides) + 1);  // 2^level > sides
}

bool LooseIndex::takes(const LooseBall& ball) const {
  const Vec3& c = ball.centre;
  return c.x >= box_.min.x && c.x <= box_.max.x && c.y >= box_.min.y && c.y <= box_.max.y &&
         (dimension_ == 2 || (c.z >= box_.min.z && c.z <= box_.max.z)) && 2.0 * ball.radius <= side(top()) &&
         level_for(ball.radius) <= top();
}

LooseIndex::NodeId LooseIndex::node_of(const Vec3& centre, int level) const {
  const Level& fine = levels_.front();
  const auto along = [&](double x, double low, std::int32_t count) {
    return std::clamp(static_cast<std::int32_t>((x - low) * inverse_side_), 0, count - 1) >> level;
  };
  return {level, along(centre.x, box_.min.x, fine.nx), along(centre.y, box_.min.y, fine.ny),
          dimension_ == 3 ? along(centre.z, box_.min.z, fine.nz) : 0};
}

Bounds LooseIndex::loose_box(const NodeId& id) const {
  const double s = side(id.level);
  const double grown = 0.5 * s + margin_;
  Bounds box;
  box.min = box_.min + s * Vec3(id.x, id.y, id.z) - Vec3(grown);
  box.max = box_.min + s * Vec3(id.x + 1, id.y + 1, id.z + 1) + Vec3(grown);
  if (dimension_ == 2) box.min.z = box.max.z = 0.0;
  return box;
}

// A level counts for the ones above it, so those are in use too. From above, and nodes last: whoever runs out of memory
// here leaves no level in use without what it needs.
void LooseIndex::use_level(int level) {
  for (int l = top(); l >= level; --l) {
    Level& used = levels_[static_cast<std::size_t>(l)];
    if (!used.nodes.empty()) continue;
    opened_[static_cast<std::size_t>(l)].resize(used.node_count(dimension_));
    used.nodes.resize(used.node_count(dimension_));
  }
}

void LooseIndex::link(Slot slot, const LooseBall& ball, std::uint32_t& row) {
  Entry& entry = entries_[slot];
  entry.place = rows_.add(row, {ball, slot, entry.marks, entry.wide, entry.tall});
}

void LooseIndex::unlink(Slot slot, std::uint32_t& row) {
  const Slot moved = rows_.remove(row, entries_[slot].place);
  if (moved != none) entries_[moved].place = entries_[slot].place;
  entries_[slot].place = none;
}

// Adds `step` (1 or -1) to the counts from `id` up to the level below `below`.
void LooseIndex::count(NodeId id, std::uint32_t step, int below) {
  for (; id.level < below; ++id.level, id.x >>= 1, id.y >>= 1, id.z >>= 1) {
    Level& level = levels_[static_cast<std::size_t>(id.level)];
    level.nodes[level.index(id, dimension_)].below += step;
  }
}

// Never finer than the ball needs, whatever is wished for; and a walk through coarse nodes meets everybody in them, so
// that there is a bound to the other side too. (Not a number: no room.)
int LooseIndex::level_with(double radius, double room) const {
  const int least = level_for(radius);
  const double wished = room > 0.0 ? std::min(room, side(top())) : 0.0;
  return std::min({std::max(least, level_for(radius + wished)), least + most_raised, top()});
}

void LooseIndex::place(Slot slot, LooseBall ball, double room) {
  Entry& entry = entries_[slot];
  const int height = static_cast<int>(levels_.size());
  const bool here = entry.level != nowhere;
  const int level = level_with(ball.radius, room);
  Level& home = levels_[static_cast<std::size_t>(level)];
  const NodeId id = node_of(ball.centre, level);
  const auto index = static_cast<std::uint32_t>(home.index(id, dimension_));
  if (entry.level == level && entry.node == index) {
    rows_[entry.place].ball = ball;
    return;
  }
  if (home.nodes.empty()) use_level(level);
  if (here) {
    // Counts change only below the first ancestor that the old node and the new one share.
    NodeId from{entry.level, entry.x, entry.y, entry.z}, to = id;
    unlink(slot, levels_[entry.level].nodes[entry.node].first);
    int shared = std::max(from.level, to.level);
    while (shared < height && ((from.x >> (shared - from.level)) != (to.x >> (shared - to.level)) ||
                               (from.y >> (shared - from.level)) != (to.y >> (shared - to.level)) ||
                               (from.z >> (shared - from.level)) != (to.z >> (shared - to.level)))) {
      ++shared;
    }
    count(from, ~std::uint32_t{0}, shared);
    count(to, 1, shared);
  } else {
    if (entry.place != none) unlink(slot, remembered_);
    count(id, 1, height);
    ++size_;
  }
  entry.level = static_cast<std::uint8_t>(level);
  entry.node = index;
  entry.x = id.x;
  entry.y = id.y;
  entry.z = id.z;
  link(slot, ball, home.nodes[index].first);
}

void LooseIndex::erase(Slot slot) {
  Entry& entry = entries_[slot];
  if (entry.level == nowhere) {
    if (entry.place != none) unlink(slot, remembered_);
    return;
  }
  unlink(slot, levels_[entry.level].nodes[entry.node].first);
  count({entry.level, entry.x, entry.y, entry.z}, ~std::uint32_t{0}, static_cast<int>(levels_.size()));
  entry.level = nowhere;
  entry.node = none;
  --size_;
}

void LooseIndex::remember(Slot slot, LooseBall ball) {
  if (entries_[slot].place != none) {
    rows_[entries_[slot].place].ball = ball;
  } else {
    link(slot, ball, remembered_);
  }
}

std::uint64_t LooseIndex::node_bytes() const {
  std::uint64_t bytes = 0;
  for (const Level& level : levels_) bytes += level.nodes.capacity() * (sizeof(Node) + sizeof(std::uint32_t));
  return bytes;
}

}  // namespace gridcull
