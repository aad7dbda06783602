#include "gridcull/grid/view_grid.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gridcull/core/error.h"

namespace gridcull {

bool ViewGrid::reset(const Lattice& lattice, const IdentifierMatrix& matrix, const Vec3& apex, double range,
                     std::uint64_t max_memory) {
  lattice_ = &lattice;
  const Cell n = lattice.cells();
  const std::array<std::int64_t, 3> count{n.x, n.y, n.z};
  const int shift = lattice.brick_shift();
  for (std::size_t k = 0; k < 3; ++k) {
    CellRange all{0, count[k] - 1};
    const int axis = static_cast<int>(k);
    if (std::isfinite(range) && axis < lattice.dimension()) {
      // One cell more than the range asks for covers every rounding.
      all = intersect(all, {lattice.index(axis, apex[axis] - range) - 1, lattice.index(axis, apex[axis] + range) + 1});
      if (all.empty()) return false;
    }
    const int s = lattice.dimension() == 2 && k == 2 ? 0 : shift;
    first_[k] = static_cast<std::size_t>(all.low >> s);
    bricks_[k] = static_cast<std::size_t>((all.high >> s) - (all.low >> s) + 1);
    base_[k] = (all.low >> s) << s;
    cells_[k] = {base_[k], std::min(count[k] - 1, (((all.high >> s) + 1) << s) - 1)};
  }
  check_size(max_memory);
  stride_ = {1, bricks_[0], bricks_[0] * bricks_[1]};
  count_ = stride_[2] * bricks_[2];
  visible.assign(count_, 0);
  hidden.assign(lattice.dimension() == 2 ? count_ : 0, 0);
  opaque.resize(count_);
  std::size_t to = 0;
  for (std::size_t z = 0; z < bricks_[2]; ++z) {
    for (std::size_t y = 0; y < bricks_[1]; ++y) {
      const std::size_t from = lattice_brick(to);
      matrix.opaque_row(from, {opaque.data() + to, bricks_[0]});
      to += bricks_[0];
    }
  }
  return true;
}

void ViewGrid::check_size(std::uint64_t max_memory) const {
  const auto along = [&](std::size_t k) { return cells_[k].high - cells_[k].low + 1; };
  const std::uint64_t bytes = Lattice::window_bytes_for(lattice_->dimension(), {along(0), along(1), along(2)});
  if (bytes <= max_memory) return;
  throw Error(ErrorCode::limit, "what a viewer may see needs " + std::to_string(bytes) +
                                    " bytes of cells, more than the " + std::to_string(max_memory) +
                                    " allowed; give it a smaller range, or larger cells");
}

std::size_t ViewGrid::lattice_brick(std::size_t brick) const {
  const std::size_t z = brick / stride_[2], rest = brick % stride_[2];
  return lattice_->brick_index({static_cast<std::int64_t>(first_[0] + rest % stride_[1]),
                                static_cast<std::int64_t>(first_[1] + rest / stride_[1]),
                                static_cast<std::int64_t>(first_[2] + z)});
}

bool ViewGrid::window_brick(std::size_t lattice_brick, std::size_t& brick) const {
  const Cell b = lattice_->bricks();
  const auto nx = static_cast<std::size_t>(b.x), nxy = static_cast<std::size_t>(b.x * b.y);
  // Below the first brick the unsigned difference wraps and fails the comparison.
  const std::size_t z = lattice_brick / nxy - first_[2], rest = lattice_brick % nxy;
  const std::size_t y = rest / nx - first_[1], x = rest % nx - first_[0];
  if (x >= bricks_[0] || y >= bricks_[1] || z >= bricks_[2]) return false;
  brick = x + stride_[1] * y + stride_[2] * z;
  return true;
}

}  // namespace gridcull
