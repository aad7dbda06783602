#include "gridcull/grid/hide_2d.h"

#include <algorithm>
#include <bit>

#include "gridcull/grid/scaled.h"

namespace gridcull {
namespace {

int sign_of(std::int64_t v) { return (v > 0) - (v < 0); }

}  // namespace

void Hide2D::reset(ViewGrid& grid, const Cell& viewer) {
  grid_ = &grid;
  viewer_ = viewer;
  for (auto& done : done_) done.assign(grid.brick_count(), 0);
}

std::uint64_t Hide2D::solid_on_line(std::size_t brick, int axis, const Cell& c) const {
  const std::uint64_t word = grid_->opaque[brick] | grid_->hidden[brick];
  if (axis == 0) return (word >> (8 * (c.y & 7))) & 0xFFu;
  // A column's bits 0, 8, 16, ... to the top byte: the products land on distinct bits.
  return (((word >> (c.x & 7)) & 0x0101'0101'0101'0101ull) * 0x0102'0408'1020'4080ull) >> 56;
}

Cell Hide2D::run_end(const Cell& start, int axis, int sign) const {
  const CellRange limit = grid_->cells(axis);
  std::int64_t at = axis == 0 ? start.x : start.y;
  std::size_t brick = grid_->brick_of(start);
  const std::size_t stride = grid_->stride(axis);
  for (;;) {
    const auto line = static_cast<std::uint8_t>(solid_on_line(brick, axis, start));
    const int from = static_cast<int>(at & 7);  // a cell known to be solid
    if (sign > 0) {
      const int more = std::countr_one(static_cast<std::uint8_t>(line >> from)) - 1;
      at = std::min(at + more, limit.high);
      if (from + more < 7 || at == limit.high) break;
      brick += stride;
    } else {
      const int more = std::countl_one(static_cast<std::uint8_t>(line << (7 - from))) - 1;
      at = std::max(at - more, limit.low);
      if (from - more > 0 || at == limit.low) break;
      brick -= stride;
    }
    // On to the next brick, if its first cell goes on.
    const int next = sign > 0 ? 0 : 7;
    if (((solid_on_line(brick, axis, start) >> next) & 1u) == 0) break;
    at += sign;
  }
  return axis == 0 ? Cell{at, start.y, 0} : Cell{start.x, at, 0};
}

// The four steps of the paper: along x, then along y from the end of it; along y, then along x from the end
// of that. The senses turn counter-clockwise about the viewer in steps 1 and 2 and clockwise in 3 and 4, so
// that every step widens the angle (the paper's Figure 4 by side of the viewer; Figure 3 is a viewer to the
// lower right). On an axis one of the senses is 0 and its step stays where it is.
void Hide2D::extend(const Cell& initial, WorkCounts& work) {
  const std::uint64_t bit = std::uint64_t{1} << grid_->lattice().bit_of(initial);
  const std::size_t brick = grid_->brick_of(initial);
  const auto side_x = [&](const Cell& c) { return sign_of(c.x - viewer_.x); };
  const auto side_y = [&](const Cell& c) { return sign_of(c.y - viewer_.y); };
  if ((done_[0][brick] & bit) == 0) {
    const Cell end = leg(initial, 0, -side_y(initial), work);
    leg(end, 1, side_x(end), work);
  }
  if ((done_[1][brick] & bit) == 0) {
    const Cell end = leg(initial, 1, -side_x(initial), work);
    leg(end, 0, side_y(end), work);
  }
}

Cell Hide2D::leg(const Cell& start, int axis, int sign, WorkCounts& work) {
  // Without a side the leg would point at the viewer: no plane to extrude from.
  if (sign == 0) return start;
  const Cell end = run_end(start, axis, sign);
  const std::size_t brick = grid_->brick_of(start);
  const std::uint64_t bit = std::uint64_t{1} << grid_->lattice().bit_of(start);
  if (done_[axis][brick] & bit) {
    // A leg along this line holds the start already. Two legs that share a cell hide what one would, so this
    // one adds nothing unless it went on beyond the cells marked so far.
    const std::size_t end_brick = grid_->brick_of(end);
    if (done_[axis][end_brick] & (std::uint64_t{1} << grid_->lattice().bit_of(end))) return end;
  }
  const std::int64_t s = axis == 0 ? start.x : start.y, e = axis == 0 ? end.x : end.y;
  set_line(done_[axis], axis, axis == 0 ? start.y : start.x, std::min(s, e), std::max(s, e));
  const std::int64_t plane = axis == 0 ? start.y - viewer_.y : start.x - viewer_.x;
  const std::int64_t from = axis == 0 ? start.x - viewer_.x : start.y - viewer_.y;
  const std::int64_t to = axis == 0 ? end.x - viewer_.x : end.y - viewer_.y;
  shadow(axis, plane, std::min(from, to), std::max(from, to), work);
  return end;
}

void Hide2D::shadow(int axis, std::int64_t plane, std::int64_t a, std::int64_t b, WorkCounts& work) {
  // A single cell off the axis hides no whole cell but at isolated multiples of its distance.
  if (plane == 0 || (a == b && a != 0)) return;
  ++work.occluders;
  const std::int64_t k = plane > 0 ? plane : -plane;
  const int sign = plane > 0 ? 1 : -1;
  const int across = 1 - axis;
  const std::int64_t origin_along = axis == 0 ? viewer_.x : viewer_.y;
  const std::int64_t origin_across = axis == 0 ? viewer_.y : viewer_.x;
  const CellRange along{grid_->cells(axis).low - origin_along, grid_->cells(axis).high - origin_along};
  const CellRange depth = grid_->cells(across);
  const std::int64_t last = sign > 0 ? depth.high - origin_across : origin_across - depth.low;
  ScaledUp low(a, k);
  ScaledDown high(b, k);
  for (std::int64_t n = k + 1; n <= last; ++n) {
    const CellRange line{low.next(), high.next()};
    if ((a > 0 && line.low > along.high) || (b < 0 && line.high < along.low)) break;
    const CellRange cut = intersect(line, along);
    if (cut.empty()) continue;
    set_line(grid_->hidden, axis, origin_across + sign * n, origin_along + cut.low, origin_along + cut.high);
    ++work.rasters;
  }
}

void Hide2D::set_line(std::vector<std::uint64_t>& bits, int axis, std::int64_t fixed, std::int64_t low,
                      std::int64_t high) {
  const std::int64_t first = low >> 3, last = high >> 3;
  const std::size_t stride = grid_->stride(axis);
  std::uint64_t* brick = bits.data() +
                         static_cast<std::size_t>((fixed - grid_->base(1 - axis)) >> 3) * grid_->stride(1 - axis) +
                         static_cast<std::size_t>((low - grid_->base(axis)) >> 3) * stride;
  const std::uint64_t line =
      axis == 0 ? std::uint64_t{0xFF} << (8 * (fixed & 7)) : 0x0101'0101'0101'0101ull << (fixed & 7);
  // Cells below `low` in the first brick and above `high` in the last.
  const int step = axis == 0 ? 1 : 8;
  const auto from = [&](std::int64_t i) {
    return axis == 0 ? line & (0x0101'0101'0101'0101ull * ((0xFFu << (i & 7)) & 0xFFu))
                     : line & (~std::uint64_t{0} << (step * (i & 7)));
  };
  const std::uint64_t head = from(low);
  const std::uint64_t tail = (high & 7) == 7 ? line : line & ~from(high + 1);
  if (first == last) {
    *brick |= head & tail;
    return;
  }
  *brick |= head;
  for (std::int64_t b = first + 1; b < last; ++b) *(brick += stride) |= line;
  *(brick + stride) |= tail;
}

}  // namespace gridcull
