// The front-to-back traversal in 2D (Batagelo and Wu 2002, section 4.2): rings of equal chess distance from
// the seeds on the line of sight outwards, until a whole ring is hidden.
#pragma once

#include <vector>

#include "gridcull/grid/hide_2d.h"
#include "gridcull/grid/ring_walk.h"
#include "gridcull/grid/stopwatch.h"
#include "gridcull/grid/view_cone.h"
#include "gridcull/grid/view_grid.h"

namespace gridcull {

class Traverse2D {
 public:
  /// Fills grid.visible and grid.hidden for a viewer in cell `viewer` (at most 2^30 cells away) that looks
  /// along `axis`. The viewer's own cell is the caller's business.
  void run(ViewGrid& grid, const ViewCone& cone, const Cell& viewer, const Vec3& axis, RevealSink& sink,
           WorkCounts& work, Stopwatch& occlusion);

  std::uint64_t bytes() const { return hide_.bytes() + found_.capacity() * sizeof(Found); }

 private:
  struct Found {
    std::size_t brick;
    std::uint64_t bits;
  };
  void visit(const Stretch& stretch, WorkCounts& work);
  void visit_cells(int axis, std::int64_t fixed, const CellRange& cells, WorkCounts& work);

  ViewGrid* grid_ = nullptr;
  const ViewCone* cone_ = nullptr;
  Cell viewer_;
  Hide2D hide_;
  std::vector<Found> found_;  // visible cells of the ring in hand
};

}  // namespace gridcull
