#include "gridcull/grid/tbv_matrix.h"

#include <algorithm>
#include <cmath>

namespace gridcull {

TbvMatrix::TbvMatrix(const Lattice& lattice) : lattice_(lattice), box_(lattice.box()) {
  const Cell b = lattice.bricks();
  blocks_ = {(b.x + 1) / 2, (b.y + 1) / 2, (b.z + 1) / 2};
  counts_ = LazyArray<std::uint32_t>(lattice.brick_count());
  // Level 0 is a brick wide; the last one holds the whole lattice in one cell.
  const Cell n = lattice.cells();
  for (int shift = lattice.brick_shift();; ++shift) {
    Level level;
    level.shift = shift;
    level.side = lattice.cell() * std::ldexp(1.0, shift);
    const auto along = [&](std::int64_t cells) { return ((cells - 1) >> shift) + 1; };
    level.cells = {along(n.x), along(n.y), along(n.z)};
    const bool last = level.cells == Cell{1, 1, 1};
    levels_.push_back(std::move(level));
    if (last) break;
  }
}

bool TbvMatrix::fits(const Ball& ball) const {
  const double r = ball.radius + 2.0 * lattice_.margin();
  for (int k = 0; k < lattice_.dimension(); ++k) {
    if (!(ball.centre[k] - r >= box_.min[k] && ball.centre[k] + r <= box_.max[k])) return false;
  }
  return true;
}

std::uint32_t TbvMatrix::level_for(double radius) const {
  std::uint32_t level = 0;
  // A ball that fits is no wider than the lattice, so the last level always takes it. The margin keeps the
  // reach below a side in spite of rounded cell boundaries.
  while (level + 1 < levels_.size() && levels_[level].side < radius + 4.0 * lattice_.margin()) ++level;
  return level;
}

std::uint32_t TbvMatrix::level_cell(const Level& level, const Cell& c) const {
  return static_cast<std::uint32_t>(((c.z >> level.shift) * level.cells.y + (c.y >> level.shift)) * level.cells.x +
                                    (c.x >> level.shift));
}

std::uint32_t TbvMatrix::home_cell(const Level& level, const Ball& ball) const {
  const auto index = [&](int axis) {
    return axis < lattice_.dimension() ? lattice_.near_index(axis, ball.centre[axis]) : 0;
  };
  return level_cell(level, {index(0), index(1), index(2)});
}

TbvMatrix::BlockSpan TbvMatrix::cells_of(const Vec3& low, const Vec3& high, int shift) const {
  // Two margins: one for the ball tests, one for what near_index() may be off.
  const double margin = 2.0 * lattice_.margin();
  BlockSpan span{};
  for (int k = 0; k < lattice_.dimension(); ++k) {
    const auto axis = static_cast<std::size_t>(k);
    span.low[axis] = lattice_.near_index(k, low[k] - margin) >> shift;
    span.high[axis] = lattice_.near_index(k, high[k] + margin) >> shift;
  }
  return span;
}

TbvMatrix::BlockSpan TbvMatrix::span_of(const Ball& ball) const {
  return cells_of(ball.centre - Vec3(ball.radius), ball.centre + Vec3(ball.radius), lattice_.brick_shift() + 1);
}

TbvMatrix::BlockSpan TbvMatrix::bricks_of(const Bounds& box) const {
  return cells_of(box.min, box.max, lattice_.brick_shift());
}

void TbvMatrix::count(const BlockSpan& span, std::uint32_t step) {
  written_ += span.size();
  for (std::int64_t z = span.low[2]; z <= span.high[2]; ++z) {
    for (std::int64_t y = span.low[1]; y <= span.high[1]; ++y) {
      const std::size_t row = lattice_.brick_index({0, y, z});
      for (std::int64_t x = span.low[0]; x <= span.high[0]; ++x) counts_[row + static_cast<std::size_t>(x)] += step;
    }
  }
}

void TbvMatrix::set_box(Home& home, const Bounds& box) {
  const BlockSpan before = home.box.empty() ? BlockSpan{{0, 0, 0}, {-1, -1, -1}} : bricks_of(home.box);
  const BlockSpan after = box.empty() ? BlockSpan{{0, 0, 0}, {-1, -1, -1}} : bricks_of(box);
  home.box = box;
  if (before == after) return;
  count(before, static_cast<std::uint32_t>(-1));
  count(after, 1);
}

void TbvMatrix::grow_box(Home& home, const Ball& ball) {
  if (home.size > 1 && home.left <= 2 * home.size) {
    const Vec3 low = ball.centre - Vec3(ball.radius), high = ball.centre + Vec3(ball.radius);
    const Bounds& b = home.box;
    if (low.x >= b.min.x && low.y >= b.min.y && low.z >= b.min.z && high.x <= b.max.x && high.y <= b.max.y &&
        high.z <= b.max.z) {
      return;
    }
    Bounds box = b;
    box.add_ball(ball.centre, ball.radius);
    return set_box(home, box);
  }
  home.left = 0;
  Bounds box;
  for (std::uint32_t i = home.head; i != none; i = links_[i].after) box.add_ball(balls_[i].centre, balls_[i].radius);
  set_box(home, box);
}

void TbvMatrix::insert(Slot slot, const Ball& ball) {
  Link& link = links_[slot];
  balls_[slot] = ball;
  ++written_;
  link.level = level_for(ball.radius);
  Level& level = levels_[link.level];
  if (level.homes.empty()) {
    level.homes = LazyArray<Home>(static_cast<std::size_t>(level.cells.x * level.cells.y * level.cells.z));
  }
  link.cell = home_cell(level, ball);
  Home& home = level.homes[link.cell];
  if (home.size == 0) home = Home{};  // untouched memory is all zero, or what it was when the last one left
  link.before = none;
  link.after = home.head;
  if (link.after != none) links_[link.after].before = slot;
  home.head = slot;
  ++home.size;
  ++level.size;
  ++size_;
  grow_box(home, ball);
}

void TbvMatrix::erase(Slot slot) {
  Link& link = links_[slot];
  Level& level = levels_[link.level];
  Home& home = level.homes[link.cell];
  (link.before == none ? home.head : links_[link.before].after) = link.after;
  if (link.after != none) links_[link.after].before = link.before;
  link.level = none;
  ++written_;
  --home.size;
  ++home.left;
  --level.size;
  --size_;
  if (home.size == 0) set_box(home, Bounds{});
}

void TbvMatrix::renew(Slot slot, const Ball& ball) {
  if (holds(slot)) {
    const Link& link = links_[slot];
    Level& level = levels_[link.level];
    if (level_for(ball.radius) == link.level && home_cell(level, ball) == link.cell) {
      Home& home = level.homes[link.cell];
      balls_[slot] = ball;
      ++written_;
      ++home.left;
      return grow_box(home, ball);
    }
    erase(slot);
  }
  insert(slot, ball);
}

std::uint64_t TbvMatrix::matrix_bytes() const {
  std::uint64_t bytes = counts_.bytes();
  for (const Level& level : levels_) bytes += level.homes.bytes();
  return bytes;
}

}  // namespace gridcull
