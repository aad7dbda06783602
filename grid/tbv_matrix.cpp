#include "gridcull/grid/tbv_matrix.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace gridcull {

TbvMatrix::TbvMatrix(const Lattice& lattice) : lattice_(lattice), box_(lattice.box()) {
  const Cell b = lattice.bricks();
  blocks_ = {(b.x + 1) / 2, (b.y + 1) / 2, (b.z + 1) / 2};
  counts_.assign(static_cast<std::size_t>(blocks_.x * blocks_.y * blocks_.z), 0);
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

TbvMatrix::BlockSpan TbvMatrix::span_of(const Ball& ball) const {
  // The second margin covers what near_index() may be off.
  const double r = ball.radius + 2.0 * lattice_.margin();
  BlockSpan span{};
  const int shift = lattice_.brick_shift() + 1;
  for (int k = 0; k < lattice_.dimension(); ++k) {
    const auto axis = static_cast<std::size_t>(k);
    span.low[axis] = lattice_.near_index(k, ball.centre[k] - r) >> shift;
    span.high[axis] = lattice_.near_index(k, ball.centre[k] + r) >> shift;
  }
  return span;
}

void TbvMatrix::count(const Ball& ball, std::uint32_t step) {
  const BlockSpan span = span_of(ball);
  for (std::int64_t z = span.low[2]; z <= span.high[2]; ++z) {
    for (std::int64_t y = span.low[1]; y <= span.high[1]; ++y) {
      const std::size_t row = block_index(0, y, z);
      for (std::int64_t x = span.low[0]; x <= span.high[0]; ++x) counts_[row + static_cast<std::size_t>(x)] += step;
    }
  }
}

void TbvMatrix::insert(Slot slot, const Ball& ball) {
  Link& link = links_[slot];
  balls_[slot] = ball;
  link.level = level_for(ball.radius);
  Level& level = levels_[link.level];
  if (level.homes.empty()) level.homes.resize(static_cast<std::size_t>(level.cells.x * level.cells.y * level.cells.z));
  const auto index = [&](int axis) {
    return axis < lattice_.dimension() ? lattice_.near_index(axis, ball.centre[axis]) : 0;
  };
  link.cell = level_cell(level, {index(0), index(1), index(2)});
  Home& home = level.homes[link.cell];
  link.before = none;
  link.after = home.head;
  if (link.after != none) links_[link.after].before = slot;
  home.head = slot;
  ++home.size;
  if (home.size == 1 || home.left > home.size) {
    home.left = 0;
    home.box = Bounds{};
    for (std::uint32_t i = home.head; i != none; i = links_[i].after)
      home.box.add_ball(balls_[i].centre, balls_[i].radius);
  } else {
    home.box.add_ball(ball.centre, ball.radius);
  }
  ++level.size;
  ++size_;
  count(ball, 1);
}

void TbvMatrix::erase(Slot slot) {
  Link& link = links_[slot];
  Level& level = levels_[link.level];
  Home& home = level.homes[link.cell];
  (link.before == none ? home.head : links_[link.before].after) = link.after;
  --home.size;
  ++home.left;
  if (link.after != none) links_[link.after].before = link.before;
  link.level = none;
  --level.size;
  --size_;
  count(balls_[slot], static_cast<std::uint32_t>(-1));
}

namespace {

/// The cells of a brick that `bits` touches along each axis, as bits 0 .. edge - 1.
std::array<unsigned, 3> shadows(std::uint64_t bits, bool solid) {
  std::array<unsigned, 3> along{};
  const int edge = solid ? 4 : 8;
  const std::uint64_t row_mask = solid ? 0xF : 0xFF;
  for (int row = 0; row < 64 / edge; ++row) {
    const auto cells = static_cast<unsigned>((bits >> (edge * row)) & row_mask);
    if (cells == 0) continue;
    along[0] |= cells;
    along[1] |= 1u << (row % edge);
    along[2] |= 1u << (row / edge);
  }
  return along;
}

}  // namespace

TbvMatrix::BrickLines TbvMatrix::lines_of(const Cell& corner, std::uint64_t bits) const {
  BrickLines lines{};
  const std::array<std::int64_t, 3> first{corner.x, corner.y, corner.z};
  for (int k = 0; k < lattice_.dimension(); ++k) {
    const auto axis = static_cast<std::size_t>(k);
    for (int i = 0; i <= lattice_.brick_edge(); ++i)
      lines.at[axis][static_cast<std::size_t>(i)] = lattice_.boundary(k, first[axis] + i);
  }
  lines.low = Vec3(-std::numeric_limits<double>::infinity());
  lines.high = Vec3(std::numeric_limits<double>::infinity());
  // Twice the margin of the ball test, so that the filter never says no to what that would find.
  const std::array<unsigned, 3> along = shadows(bits, lattice_.dimension() == 3);
  for (int k = 0; k < lattice_.dimension(); ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const auto& at = lines.at[axis];
    lines.low[k] = at[static_cast<std::size_t>(std::countr_zero(along[axis]))] - 2.0 * lattice_.margin();
    lines.high[k] = at[static_cast<std::size_t>(std::bit_width(along[axis]))] + 2.0 * lattice_.margin();
  }
  return lines;
}

bool TbvMatrix::ball_touches(const Ball& ball, const BrickLines& lines, std::uint64_t bits) const {
  const auto edge = static_cast<std::size_t>(lattice_.brick_edge());
  const double r = ball.radius + lattice_.margin();
  // Squared distance of the centre to cell i along an axis.
  const auto square = [&](int axis, std::size_t i) {
    const auto& at = lines.at[static_cast<std::size_t>(axis)];
    const double c = ball.centre[axis];
    const double gap = std::max({at[i] - c, c - at[i + 1], 0.0});
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
