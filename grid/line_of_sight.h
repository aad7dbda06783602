// The line of sight in cells: one seed cell for every chess distance (Batagelo and Wu 2002, section 4.2 and
// 5.2: Bresenham's algorithm, in 2D and 3D).
//
// Changed: the paper starts at the centre of the viewer's cell with integer endpoints. Directions here are
// arbitrary, so the error terms are kept in 32-bit fixed point; the major axis steps one cell a ring.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "gridcull/core/vec.h"
#include "gridcull/grid/lattice.h"

namespace gridcull {

class LineOfSight {
 public:
  /// Along `direction` (not zero) from the viewer's cell.
  explicit LineOfSight(const Vec3& direction) {
    for (int k = 1; k < 3; ++k) {
      if (std::fabs(direction[k]) > std::fabs(direction[major_])) major_ = k;
    }
    const double most = std::fabs(direction[major_]);
    for (int k = 0; k < 3; ++k) {
      sign_[static_cast<std::size_t>(k)] = direction[k] < 0.0 ? -1 : 1;
      step_[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::fabs(direction[k]) / most * one);
    }
  }

  /// The seed cell at chess distance `ring` >= 0, relative to the viewer's cell. Minor coordinates are those
  /// of Bresenham's line, rounded half up; they never exceed the major one.
  Cell at(std::int64_t ring) const {
    const auto along = [&](std::size_t k) { return sign_[k] * ((ring * step_[k] + one / 2) / one); };
    return {along(0), along(1), along(2)};
  }

 private:
  static constexpr std::int64_t one = std::int64_t{1} << 32;  // times 2^30 rings stays inside 63 bits
  int major_ = 0;
  std::array<std::int64_t, 3> step_{};
  std::array<std::int64_t, 3> sign_{};
};

}  // namespace gridcull
