// The front-to-back traversal in 3D (Batagelo and Wu 2002, section 5.2): shells of equal chess distance,
// swept plane by plane and row by row, from the face with the line of sight on, until a whole shell is
// hidden.
#pragma once

#include <array>
#include <vector>

#include "gridcull/grid/face_3d.h"
#include "gridcull/grid/stopwatch.h"

namespace gridcull {

class Traverse3D {
 public:
  /// As Traverse2D::run; H stays in the faces.
  void run(ViewGrid& grid, const ViewCone& cone, const Cell& viewer, const Vec3& axis, RevealSink& sink,
           WorkCounts& work, Stopwatch& occlusion);

  /// Runs of hidden cells of the last run(), lattice coordinates, for drawing: f(low cell, high cell).
  template <class F>
  void for_each_hidden(F&& f) const {
    for (const int index : used_) faces_[static_cast<std::size_t>(index)].for_each_hidden(f);
  }

  std::uint64_t bytes() const;

 private:
  std::array<Face3D, 6> faces_;
  std::vector<int> used_;             // faces with cells, seed's face first
  std::vector<int> alive_;            // those that still show something
  std::vector<int> showing_;          // those with visible cells in the shell in hand
  std::vector<std::uint64_t> fresh_;  // newly visible bits per window brick
  std::vector<std::size_t> bricks_;   // bricks with fresh bits
};

}  // namespace gridcull
