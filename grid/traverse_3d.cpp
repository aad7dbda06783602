#include "gridcull/grid/traverse_3d.h"

#include <algorithm>
#include <cmath>

#include "gridcull/grid/line_of_sight.h"

namespace gridcull {
namespace {

/// Faces in the order of the sweep: the one that the line of sight leaves through, its neighbours, the
/// opposite one.
std::array<int, 6> sweep_order(const Vec3& axis) {
  const Cell seed = LineOfSight(axis).at(1 << 20);
  const std::array<std::int64_t, 3> s{seed.x, seed.y, seed.z};
  std::array<int, 6> order{0, 1, 2, 3, 4, 5};
  const auto towards = [&](int face) { return (face % 2 == 0 ? 1 : -1) * s[static_cast<std::size_t>(face / 2)]; };
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return towards(a) != towards(b) ? towards(a) > towards(b) : a < b; });
  return order;
}

}  // namespace

void Traverse3D::run(ViewGrid& grid, const ViewCone& cone, const Cell& viewer, const Vec3& axis, RevealSink& sink,
                     WorkCounts& work, Stopwatch& occlusion) {
  used_.clear();
  std::int64_t last = 0, first = std::int64_t{1} << 62;
  for (const int index : sweep_order(axis)) {
    Face3D& face = faces_[static_cast<std::size_t>(index)];
    if (!face.reset(index, grid, cone, viewer)) continue;
    used_.push_back(index);
    first = std::min(first, face.first_depth());
    last = std::max(last, face.last_depth());
  }
  alive_ = used_;
  fresh_.assign(grid.brick_count(), 0);
  const bool inside = grid.lattice().holds(viewer);
  for (std::int64_t k = first; k <= last && !alive_.empty(); ++k) {
    bricks_.clear();
    showing_.clear();
    std::erase_if(alive_, [&](int index) {
      Face3D& face = faces_[static_cast<std::size_t>(index)];
      if (k < face.first_depth()) return false;
      if (k > face.last_depth()) return true;
      if (face.scan(k, fresh_, bricks_, work)) {
        showing_.push_back(index);
        return false;
      }
      // Nothing of this plane shows: everything behind it is hidden. A segment from a viewer outside the
      // lattice may pass the plane outside of it, so then the face goes on.
      return inside;
    });
    for (const std::size_t brick : bricks_) {
      sink.look(brick, fresh_[brick]);
      fresh_[brick] = 0;
    }
    occlusion.start();
    for (const int index : showing_) faces_[static_cast<std::size_t>(index)].occlude(k, work);
    occlusion.stop();
  }
}

std::uint64_t Traverse3D::bytes() const {
  std::uint64_t bytes = fresh_.capacity() * sizeof(std::uint64_t) + bricks_.capacity() * sizeof(std::size_t);
  for (const Face3D& face : faces_) bytes += face.bytes();
  return bytes;
}

}  // namespace gridcull
