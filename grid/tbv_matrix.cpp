#include "gridcull/grid/tbv_matrix.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace gridcull {

TbvMatrix::TbvMatrix(const Lattice& lattice) : lattice_(lattice), box_(lattice.box()) {
  const Cell b = lattice.bricks();
  blocks_ = {(b.x + 1) / 2, (b.y + 1) / 2, (b.z + 1) / 2};
  counts_.assign(lattice.brick_count(), 0);
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
  link.level = level_for(ball.radius);
  Level& level = levels_[link.level];
  if (level.homes.empty()) level.homes.resize(static_cast<std::size_t>(level.cells.x * level.cells.y * level.cells.z));
  link.cell = home_cell(level, ball);
  Home& home = level.homes[link.cell];
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
      ++home.left;
      return grow_box(home, ball);
    }
    erase(slot);
  }
  insert(slot, ball);
}

namespace {

/// The cells of a brick that `bits` (not 0) touches along each axis, as bits 0 .. edge - 1.
std::array<unsigned, 3> shadows(std::uint64_t bits, bool solid) {
  // Rows folded on one another; then the rows that hold anything, one bit each, folded likewise.
  std::uint64_t x = bits | bits >> 32, rows = bits;
  x |= x >> 16;
  x |= x >> 8;
  if (!solid) {
    for (const int step : {4, 2, 1}) rows |= rows >> step;
    // Bits 0, 8, 16, ... to the top byte: the products land on distinct bits.
    const std::uint64_t y = ((rows & 0x0101'0101'0101'0101ull) * 0x0102'0408'1020'4080ull) >> 56;
    return {static_cast<unsigned>(x & 0xFF), static_cast<unsigned>(y), 1};
  }
  x |= x >> 4;
  rows |= rows >> 2;
  rows = (rows | rows >> 1) & 0x1111'1111'1111'1111ull;
  std::uint64_t y = rows | rows >> 32;
  y |= y >> 16;
  const auto four = [](std::uint64_t v) { return static_cast<unsigned>((v & 0x1111u) * 0x1248u >> 12 & 0xFu); };
  unsigned z = 0;
  for (int layer = 0; layer < 4; ++layer) z |= ((rows >> (16 * layer) & 0xFFFFu) != 0 ? 1u : 0u) << layer;
  return {static_cast<unsigned>(x & 0xF), four(y), z};
}

}  // namespace

TbvMatrix::BrickLines TbvMatrix::lines_of(const Cell& corner, std::uint64_t bits) const {
  BrickLines lines{};
  lines.corner = corner;
  lines.low = Vec3(-std::numeric_limits<double>::infinity());
  lines.high = Vec3(std::numeric_limits<double>::infinity());
  // Twice the margin of the ball test, so that the filter never says no to what that would find.
  const std::array<unsigned, 3> along = shadows(bits, lattice_.dimension() == 3);
  const std::array<std::int64_t, 3> first{corner.x, corner.y, corner.z};
  for (int k = 0; k < lattice_.dimension(); ++k) {
    const auto axis = static_cast<std::size_t>(k);
    lines.low[k] = lattice_.boundary(k, first[axis] + std::countr_zero(along[axis])) - 2.0 * lattice_.margin();
    lines.high[k] = lattice_.boundary(k, first[axis] + std::bit_width(along[axis])) + 2.0 * lattice_.margin();
  }
  return lines;
}

bool TbvMatrix::ball_touches(const Ball& ball, const BrickLines& lines, std::uint64_t bits) const {
  const auto edge = static_cast<std::size_t>(lattice_.brick_edge());
  const double r = ball.radius + lattice_.margin();
  const std::array<std::int64_t, 3> first{lines.corner.x, lines.corner.y, lines.corner.z};
  // Squared distance of the centre to cell i along an axis.
  const auto square = [&](int axis, std::size_t i) {
    const std::int64_t at = first[static_cast<std::size_t>(axis)] + static_cast<std::int64_t>(i);
    const double c = ball.centre[axis];
    const double gap = std::max({lattice_.boundary(axis, at) - c, c - lattice_.boundary(axis, at + 1), 0.0});
    return gap * gap;
  };
  std::array<double, 8> squares_x{}, squares_y{};
  for (std::size_t i = 0; i < edge; ++i) squares_x[i] = square(0, i), squares_y[i] = square(1, i);
  const std::size_t layers = lattice_.dimension() == 3 ? edge : 1;
  const std::uint64_t row_mask = (std::uint64_t{1} << edge) - 1;
  for (std::size_t z = 0; z < layers; ++z) {
    const double rest = r * r - (layers > 1 ? square(2, z) : 0.0);
    for (std::size_t y = 0; y < edge; ++y) {
      const std::uint64_t row = (bits >> ((z * edge + y) * edge)) & row_mask;
      if (row == 0) continue;
      std::uint64_t met = 0;
      for (std::size_t x = 0; x < edge; ++x) met |= std::uint64_t{squares_x[x] <= rest - squares_y[y]} << x;
      if ((met & row) != 0) return true;
    }
  }
  return false;
}

std::uint64_t TbvMatrix::matrix_bytes() const {
  std::uint64_t bytes = counts_.size() * sizeof(std::uint32_t);
  for (const Level& level : levels_) bytes += level.homes.size() * sizeof(Home);
  return bytes;
}

}  // namespace gridcull
