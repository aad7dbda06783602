// Occluder extension and occlusion in 2D (Batagelo and Wu 2002, sections 4.3 and 4.4).
//
// Claim. Let a leg be cells (k, a) .. (k, b), each opaque or hidden, k >= 1 columns from the viewer's cell.
// Cell (n, y) with n > k is hidden from every point of the viewer's cell when a <= y k / n <= b.
// Proof. Let v be a point of the viewer's cell, x one of cell (n, y), both within half a cell of the centres.
// With t = k / n < 1 the point q = (1 - t) v + t x lies within half a cell of (k, y k / n) in each axis,
// because (1 - t) / 2 + t / 2 = 1 / 2. So q lies in the cells floor and ceil of y k / n of column k, which
// belong to the leg: the segment v-x passes an opaque or a hidden cell nearer to v, and by induction over
// the distance an occluder. This is the paper's rule (cell centres as vertices, viewpoint at its cell's
// centre, sampling at cell centres) and thus its from-cell shrink by (|nx| + |ny|) d / 2.
// An L-shape is the union of its legs: a ray inside its angle crosses one of them, so its corner vertex is
// kept and no chord hides cells in front of it.
#pragma once

#include <cstdint>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/grid/view_grid.h"

namespace gridcull {

class Hide2D {
 public:
  /// For one view; `viewer` is the viewer's cell (lattice coordinates, may lie outside).
  void reset(ViewGrid& grid, const Cell& viewer);

  /// Extends the opaque visible cell `initial` (lattice coordinates) to an L-shape in four steps and marks
  /// what it hides in H.
  void extend(const Cell& initial, WorkCounts& work);

  std::uint64_t bytes() const { return (done_[0].capacity() + done_[1].capacity()) * sizeof(std::uint64_t); }

 private:
  /// The eight cells of a brick on the line through `c` along `axis`, as bits: opaque or hidden.
  std::uint64_t solid_on_line(std::size_t brick, int axis, const Cell& c) const;
  /// The last cell from `start` along `axis` in sense `sign` such that all between are opaque or hidden.
  Cell run_end(const Cell& start, int axis, int sign) const;
  /// From `start` along `axis` while cells are opaque or hidden; hides what lies behind; returns the end.
  Cell leg(const Cell& start, int axis, int sign, WorkCounts& work);
  void shadow(int axis, std::int64_t plane, std::int64_t a, std::int64_t b, WorkCounts& work);
  /// Sets the cells low .. high on the line along `axis` with the other coordinate `fixed`.
  void set_line(std::vector<std::uint64_t>& bits, int axis, std::int64_t fixed, std::int64_t low, std::int64_t high);

  ViewGrid* grid_ = nullptr;
  Cell viewer_;
  std::vector<std::uint64_t> done_[2];  // cells that a leg along the axis holds already
};

}  // namespace gridcull
