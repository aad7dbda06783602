#include "gridcull/grid/hide_2d.h"

#include "gridcull/grid/division.h"

namespace gridcull {
namespace {

int sign_of(std::int64_t v) { return (v > 0) - (v < 0); }

}  // namespace

void Hide2D::reset(ViewGrid& grid, const Cell& viewer) {
  grid_ = &grid;
  viewer_ = viewer;
  for (auto& done : done_) done.assign(grid.brick_count(), 0);
}

bool Hide2D::solid(const Cell& c) const {
  if (!grid_->holds(c)) return false;
  const std::size_t brick = grid_->brick_of(c);
  return ((grid_->opaque[brick] | grid_->hidden[brick]) >> grid_->lattice().bit_of(c)) & 1u;
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
  Cell end = start;
  for (;;) {
    Cell next = end;
    (axis == 0 ? next.x : next.y) += sign;
    if (!solid(next)) break;
    end = next;
  }
  const std::size_t brick = grid_->brick_of(start);
  const std::uint64_t bit = std::uint64_t{1} << grid_->lattice().bit_of(start);
  if (done_[axis][brick] & bit) {
    // A leg along this line holds the start already. Two legs that share a cell hide what one would, so this
    // one adds nothing unless it went on beyond the cells marked so far.
    const std::size_t end_brick = grid_->brick_of(end);
    if (done_[axis][end_brick] & (std::uint64_t{1} << grid_->lattice().bit_of(end))) return end;
  }
  for (Cell c = start;; (axis == 0 ? c.x : c.y) += sign) {
    done_[axis][grid_->brick_of(c)] |= std::uint64_t{1} << grid_->lattice().bit_of(c);
    if (c == end) break;
  }
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
  const CellRange along = grid_->cells(axis), depth = grid_->cells(across);
  const std::int64_t last = sign > 0 ? depth.high - origin_across : origin_across - depth.low;
  for (std::int64_t n = k + 1; n <= last; ++n) {
    const std::int64_t low = origin_along + ceil_div(a * n, k), high = origin_along + floor_div(b * n, k);
    if ((a > 0 && low > along.high) || (b < 0 && high < along.low)) break;
    const CellRange cut = intersect({low, high}, along);
    if (cut.empty()) continue;
    set_line(axis, origin_across + sign * n, cut.low, cut.high);
    ++work.rasters;
  }
}

void Hide2D::set_line(int axis, std::int64_t fixed, std::int64_t low, std::int64_t high) {
  const std::size_t stride = grid_->stride(axis);
  const std::int64_t first = low >> 3, last = high >> 3;
  std::size_t brick = grid_->brick_of(axis == 0 ? Cell{low, fixed, 0} : Cell{fixed, low, 0});
  for (std::int64_t b = first; b <= last; ++b, brick += stride) {
    const int from = b == first ? static_cast<int>(low & 7) : 0;
    const int to = b == last ? static_cast<int>(high & 7) : 7;
    grid_->hidden[brick] |= axis == 0 ? bit_range(from, to) << (8 * (fixed & 7))
                                      : (0x0101'0101'0101'0101ull & bit_range(8 * from, 8 * to + 7)) << (fixed & 7);
  }
}

}  // namespace gridcull
