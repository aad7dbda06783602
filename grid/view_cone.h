// Which cells of a row may touch the view volume. All in cell units, relative to the viewer's cell.
//
// The near plane is left out on purpose: a cell nearer than it still occludes, and an object that only
// shows there is sorted out at the end, object by object.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "gridcull/core/view_volume.h"
#include "gridcull/grid/lattice.h"

namespace gridcull {

/// Inclusive range of cells; empty when low > high.
struct CellRange {
  std::int64_t low = 0, high = -1;
  bool empty() const { return low > high; }
};

inline CellRange intersect(const CellRange& a, const CellRange& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high)};
}

/// In-view cells of a row: `range` without `gap` (2D fields of view above 180 degrees leave a gap).
struct RowView {
  CellRange range;
  CellRange gap;
};

class ViewCone {
 public:
  ViewCone(const Lattice& lattice, const ViewVolume& volume, const Cell& viewer);

  /// Row along `axis` through the cells with the other coordinates of `at` (relative to the viewer's cell),
  /// limited to `within`. Never leaves out a cell that touches the view volume's cone and range.
  RowView row(int axis, const Cell& at, const CellRange& within) const;

 private:
  struct Side {
    std::array<double, 3> normal;
    double reach;  // greatest dot(normal, offset) within a cell about its centre
  };
  /// Cells t of the row with normal . cell >= 0 possible.
  CellRange inside(const Side& side, int axis, const std::array<double, 3>& centre, const CellRange& within) const;
  CellRange in_range(int axis, const std::array<double, 3>& centre, const CellRange& within) const;

  int dimension_;
  bool convex_;
  int sides_ = 0;
  std::array<Side, 4> side_{};
  std::array<double, 3> offset_{};  // cell centre minus viewpoint for the viewer's own cell
  double range_;                    // cells
  double slack_;                    // cells: see view_cone.cpp
};

}  // namespace gridcull
