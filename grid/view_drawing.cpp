// Hands one view's matrices to a drawing sink (the paper's Figure 1).
#include "gridcull/grid/draw_volumes.h"
#include "gridcull/grid/line_of_sight.h"
#include "gridcull/grid/view_task.h"

namespace gridcull {
namespace {

/// Draws the set bits of a brick as runs along x.
void draw_bits(const Lattice& lattice, std::size_t brick, std::uint64_t bits, CellLayer layer, DrawSink& sink) {
  const Cell corner = lattice.brick_corner(brick);
  const int edge = lattice.brick_edge();
  const bool solid = lattice.dimension() == 3;
  for_each_run({&bits, 1}, [&](int first, int last) {
    while (first <= last) {
      const int end = std::min(last, first | (edge - 1));  // a run may go on in the next row
      const int row = first / edge;
      const std::int64_t y = corner.y + row % edge, z = corner.z + row / edge;
      const Vec3 low(lattice.boundary(0, corner.x + first % edge), lattice.boundary(1, y),
                     solid ? lattice.boundary(2, z) : 0.0);
      const Vec3 high(lattice.boundary(0, corner.x + end % edge + 1), lattice.boundary(1, y + 1),
                      solid ? lattice.boundary(2, z + 1) : 0.0);
      sink.cells(layer, low, high);
      first = end + 1;
    }
  });
}

}  // namespace

void ViewTask::draw_all(DrawSink& sink) const {
  const GridWorld& world = *world_;
  const Lattice& lattice = world.lattice;
  if (has_window_) {
    for (std::size_t b = 0; b < grid_.brick_count(); ++b) {
      const std::size_t brick = grid_.lattice_brick(b);
      std::uint64_t touched = 0;
      world.matrix.each_in_brick(brick, [&](const IdentifierMatrix::Entry& entry) { touched |= entry.touched; });
      draw_bits(lattice, brick, touched, CellLayer::touched, sink);
      draw_bits(lattice, brick, grid_.opaque[b], CellLayer::opaque, sink);
      draw_bits(lattice, brick, grid_.visible[b], CellLayer::visited, sink);
      if (lattice.dimension() == 2) draw_bits(lattice, brick, grid_.hidden[b], CellLayer::hidden, sink);
    }
  }
  if (lattice.dimension() == 3 && has_window_ && !far_away_) {
    traverse_3d_.for_each_hidden([&](const Cell& a, const Cell& b) {
      const auto corner = [&](const Cell& c, int more) {
        return Vec3(lattice.boundary(0, c.x + more), lattice.boundary(1, c.y + more), lattice.boundary(2, c.z + more));
      };
      sink.cells(CellLayer::hidden, corner(a, 0), corner(b, 1));
    });
  }
  draw_line_of_sight(sink);
  draw_volumes(
      world, *result_, [&](Slot slot) { return world.tbv.ball(slot); }, sink);
}

void ViewTask::draw_line_of_sight(DrawSink& sink) const {
  const Lattice& lattice = world_->lattice;
  const LineOfSight line(volume_->axis());
  for (std::int64_t k = 1; k < greatest_distance; ++k) {
    const Cell at = line.at(k);
    const Cell c{viewer_.x + at.x, viewer_.y + at.y, viewer_.z + (lattice.dimension() == 3 ? at.z : 0)};
    if (!has_window_ || !grid_.holds(c)) break;
    const std::size_t brick = lattice.brick_of(c);
    draw_bits(lattice, brick, std::uint64_t{1} << lattice.bit_of(c), CellLayer::line_of_sight, sink);
  }
}

}  // namespace gridcull
