// Why the end is right: a segment from the viewer to a point beyond ring k that stays in the view volume
// passes a cell of ring k that is in view. If all of these are hidden, so is the point. For a viewer outside
// the lattice the segment may pass ring k outside of it, so then every ring is visited.
#include "gridcull/grid/traverse_2d.h"

#include <algorithm>

#include "gridcull/grid/line_of_sight.h"

namespace gridcull {

void Traverse2D::run(ViewGrid& grid, const ViewCone& cone, const Cell& viewer, const Vec3& axis, RevealSink& sink,
                     WorkCounts& work, Stopwatch& occlusion) {
  grid_ = &grid;
  cone_ = &cone;
  viewer_ = viewer;
  hide_.reset(grid, viewer);
  const LineOfSight line(axis);
  const auto nearest = [](std::int64_t v, const CellRange& r) {
    return std::max({r.low - v, v - r.high, std::int64_t{0}});
  };
  const auto farthest = [](std::int64_t v, const CellRange& r) { return std::max(v - r.low, r.high - v); };
  const CellRange x = grid.cells(0), y = grid.cells(1);
  const std::int64_t first = std::max({nearest(viewer.x, x), nearest(viewer.y, y), std::int64_t{1}});
  const std::int64_t last = std::max(farthest(viewer.x, x), farthest(viewer.y, y));
  const bool inside = grid.lattice().holds(viewer);
  for (std::int64_t ring = first; ring <= last; ++ring) {
    found_.clear();
    walk_ring(line.at(ring), [&](const Stretch& stretch) {
      visit(stretch, work);
      return true;
    });
    if (found_.empty() && inside) break;
    for (const Found& f : found_) sink.look(f.brick, f.bits);
    occlusion.start();
    for (const Found& f : found_) {
      const std::size_t lattice_brick = grid.lattice_brick(f.brick);
      const Cell corner = grid.lattice().brick_corner(lattice_brick);
      for_each_bit(f.bits & grid.opaque[f.brick], [&](int bit) {
        hide_.extend({corner.x + (bit & 7), corner.y + (bit >> 3), 0}, work);
      });
    }
    occlusion.stop();
  }
}

void Traverse2D::visit(const Stretch& stretch, WorkCounts& work) {
  const std::int64_t origin = stretch.axis == 0 ? viewer_.x : viewer_.y;
  const std::int64_t across = stretch.axis == 0 ? viewer_.y : viewer_.x;
  const CellRange limit = grid_->cells(1 - stretch.axis), window = grid_->cells(stretch.axis);
  const std::int64_t fixed = across + stretch.fixed;
  if (fixed < limit.low || fixed > limit.high) return;
  const CellRange cells = intersect({std::min(stretch.from, stretch.to), std::max(stretch.from, stretch.to)},
                                    {window.low - origin, window.high - origin});
  if (cells.empty()) return;
  const Cell at = stretch.axis == 0 ? Cell{0, stretch.fixed, 0} : Cell{stretch.fixed, 0, 0};
  const RowView view = cone_->row(stretch.axis, at, cells);
  const auto shifted = [&](std::int64_t low, std::int64_t high) {
    if (low <= high) visit_cells(stretch.axis, fixed, {origin + low, origin + high}, work);
  };
  if (view.gap.empty()) {
    shifted(view.range.low, view.range.high);
  } else {
    shifted(view.range.low, view.gap.low - 1);
    shifted(view.gap.high + 1, view.range.high);
  }
}

void Traverse2D::visit_cells(int axis, std::int64_t fixed, const CellRange& cells, WorkCounts& work) {
  const std::size_t stride = grid_->stride(axis);
  const std::int64_t first = cells.low >> 3, last = cells.high >> 3;
  std::size_t brick = grid_->brick_of(axis == 0 ? Cell{cells.low, fixed, 0} : Cell{fixed, cells.low, 0});
  for (std::int64_t b = first; b <= last; ++b, brick += stride) {
    const int from = b == first ? static_cast<int>(cells.low & 7) : 0;
    const int to = b == last ? static_cast<int>(cells.high & 7) : 7;
    const std::uint64_t mask = axis == 0 ? bit_range(from, to) << (8 * (fixed & 7))
                                         : (0x0101'0101'0101'0101ull & bit_range(8 * from, 8 * to + 7)) << (fixed & 7);
    const std::uint64_t bits = mask & ~grid_->hidden[brick];
    work.cells_hidden += static_cast<std::uint64_t>(std::popcount(mask & grid_->hidden[brick]));
    if (bits == 0) continue;
    work.cells_visited += static_cast<std::uint64_t>(std::popcount(bits));
    grid_->visible[brick] |= bits;
    found_.push_back({brick, bits});
  }
}

}  // namespace gridcull
