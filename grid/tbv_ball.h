// A temporal bounding volume's ball, and the question that every index of such volumes is asked by the traversal:
// who touches one of these cells of a brick? T (tbv_matrix.h), the octree and the volume tree that it is measured
// against share the last, exact test, so that they differ only in how they get there.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "gridcull/core/bounds.h"
#include "gridcull/grid/lattice.h"

namespace gridcull {

struct TbvBall {
  Vec3 centre{0.0};
  double radius = 0.0;  ///< metres

  Bounds box() const {
    Bounds b;
    b.add_ball(centre, radius);
    return b;
  }
};

/// Work of one question.
struct TbvLook {
  std::uint64_t volumes = 0;  ///< volumes looked at
  std::uint64_t places = 0;   ///< cells or nodes of the index looked at
};

/// Some cells of a brick. Outlived by the lattice.
class BrickCells {
 public:
  /// `bits`: not 0.
  BrickCells(const Lattice& lattice, std::size_t brick, std::uint64_t bits);

  /// The brick's lowest cell.
  const Cell& corner() const { return corner_; }

  /// Cheap filters, which say yes to everything that touches: the box around the cells, grown by twice the lattice's
  /// margin (the test below grows by one), against a ball and against a box around balls.
  bool near(const TbvBall& ball) const {
    const auto gap = [&](int k) { return std::max({low_[k] - ball.centre[k], ball.centre[k] - high_[k], 0.0}); };
    const double x = gap(0), y = gap(1), z = gap(2);
    return x * x + y * y + z * z <= ball.radius * ball.radius;
  }
  const Vec3& low() const { return low_; }
  const Vec3& high() const { return high_; }
  bool meet(const Bounds& box) const {
    return box.min.x <= high_.x && box.max.x >= low_.x && box.min.y <= high_.y && box.max.y >= low_.y &&
           box.min.z <= high_.z && box.max.z >= low_.z;
  }
  /// Whether the ball, grown by the lattice's margin, touches one of the cells.
  bool touch(const TbvBall& ball) const;

 private:
  const Lattice& lattice_;
  std::uint64_t bits_;
  Cell corner_;
  Vec3 low_, high_;  // metres
};

}  // namespace gridcull
