// One viewer's matrices over the part of the lattice that it can report: its copy of O, its H (2D) and the
// cells found visible. Owned by a thread and reused from view to view.
#pragma once

#include <cstdint>
#include <vector>

#include "gridcull/grid/bits.h"
#include "gridcull/grid/identifier_matrix.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/grid/view_cone.h"

namespace gridcull {

/// Told about cells that just turned out visible, so that temporal bounding volumes there are revealed while
/// the traversal is still at that ring or shell. It may add opaque cells to the grid's O.
class RevealSink {
 public:
  virtual ~RevealSink() = default;
  /// `brick`: index in the ViewGrid; `bits`: its newly visible cells.
  virtual void look(std::size_t brick, std::uint64_t bits) = 0;
};

class ViewGrid {
 public:
  /// Covers the lattice's cells within `range` metres of `apex`, at whole bricks; copies O (with O_s), clears
  /// the rest. Returns false when no cell of the lattice is that near. Throws Error(limit) when that
  /// needs more than `max_memory` bytes.
  bool reset(const Lattice& lattice, const IdentifierMatrix& matrix, const Vec3& apex, double range,
             std::uint64_t max_memory);

  const Lattice& lattice() const { return *lattice_; }

  /// Cells of the window along an axis (0, 1, 2), lattice coordinates, whole bricks cut to the lattice.
  CellRange cells(int axis) const { return cells_[static_cast<std::size_t>(axis)]; }
  /// First cell of the window's first brick along an axis.
  std::int64_t base(int axis) const { return base_[static_cast<std::size_t>(axis)]; }
  /// Bricks between neighbours along an axis.
  std::size_t stride(int axis) const { return stride_[static_cast<std::size_t>(axis)]; }

  std::size_t brick_count() const { return count_; }
  /// Index of the brick that holds a cell of the window.
  std::size_t brick_of(const Cell& c) const {
    const int s = lattice_->brick_shift();
    return static_cast<std::size_t>((c.x - base_[0]) >> s) +
           stride_[1] * static_cast<std::size_t>((c.y - base_[1]) >> s) +
           stride_[2] * static_cast<std::size_t>((c.z - base_[2]) >> s);
  }
  bool holds(const Cell& c) const {
    return c.x >= cells_[0].low && c.x <= cells_[0].high && c.y >= cells_[1].low && c.y <= cells_[1].high &&
           c.z >= cells_[2].low && c.z <= cells_[2].high;
  }
  /// The lattice's index of a window brick.
  std::size_t lattice_brick(std::size_t brick) const;
  /// Calls f(brick, lattice brick) for every brick of the window.
  template <class F>
  void for_each_brick(F&& f) const {
    for (std::size_t brick = 0; brick < count_;) {
      const std::size_t row = lattice_brick(brick);
      for (std::size_t x = 0; x < bricks_[0]; ++x) f(brick++, row + x);
    }
  }
  /// The window's index of a lattice brick; false when it lies outside the window.
  bool window_brick(std::size_t lattice_brick, std::size_t& brick) const;

  std::vector<std::uint64_t> opaque;   // O of this viewer
  std::vector<std::uint64_t> hidden;   // H, 2D
  std::vector<std::uint64_t> visible;  // in view, not hidden when visited

  std::uint64_t bytes() const {
    return (opaque.capacity() + hidden.capacity() + visible.capacity()) * sizeof(std::uint64_t);
  }

 private:
  void check_size(std::uint64_t max_memory) const;

  const Lattice* lattice_ = nullptr;
  std::array<CellRange, 3> cells_{};
  std::array<std::int64_t, 3> base_{};
  std::array<std::size_t, 3> stride_{};
  std::array<std::size_t, 3> bricks_{};
  std::array<std::size_t, 3> first_{};  // lattice brick coordinates of the window's first brick
  std::size_t count_ = 0;
};

}  // namespace gridcull
