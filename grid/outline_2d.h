// 2D shapes with edges, made ready to be seen as silhouettes: which of their edges may hide, and the points in the
// world.
//
// Claim (usable edges). Truth hides by interiors (core/culler.h), edges hide by being crossed. For a closed outline
// the two agree along an edge where exactly one of its sides is interior, by the even-odd rule: a ray that crosses it
// there is inside before or after. An outline whose edges keep `clearance` from each other (but where they follow one
// another) has that along all of them: it is *clean*, simple, and what faces away from a viewer outside lies behind
// what faces it. Of all others only those parts of edges are used that no other edge comes near, edges that
// leave the same point at an angle excepted: crossings and spikes lose a hair, walls on top of each other hide nothing.
// Rounding moves world points by a few ulp; where `clearance` is not far above that (solid()), nothing is used.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/shape.h"

namespace gridcull {

/// A rectangle, polygon or polyline in local coordinates.
class Outline2D {
 public:
  /// Edge `edge` runs from point `edge` to the next one; used from t0 to t1, 0 <= t0 < t1 <= 1.
  struct Part {
    std::uint32_t edge;
    double t0, t1;
  };

  /// The shape is 2D, valid and no disc.
  explicit Outline2D(const Shape& shape);

  bool closed() const { return closed_; }
  /// Metres: of a disc about middle() that holds all points, rounded up.
  double radius() const { return radius_; }
  const Vec2& middle() const { return middle_; }
  std::span<const Vec2> points() const { return points_; }
  /// Number of edges.
  std::size_t edges() const { return closed_ ? points_.size() : points_.size() - 1; }
  /// Closed: simple, its edges well apart. All edges are usable then.
  bool clean() const { return clean_; }
  bool counter_clockwise() const { return counter_clockwise_; }
  /// Not clean: what may hide.
  std::span<const Part> parts() const { return parts_; }
  /// Whether rounding leaves the outline's shape alone in coordinates of this magnitude (metres).
  bool solid(double magnitude) const { return clearance_ > 4e-12 * magnitude; }

  /// World points (as world_outline() gives them) into `out`, which has room for points().size().
  void place(const Pose& pose, Vec2* out) const;

  std::uint64_t bytes() const { return points_.capacity() * sizeof(Vec2) + parts_.capacity() * sizeof(Part); }

 private:
  void judge();

  bool closed_ = true;
  bool clean_ = true;
  bool counter_clockwise_ = true;
  double radius_ = 0.0;
  double clearance_ = 0.0;
  Vec2 middle_{0.0};
  std::vector<Vec2> points_;
  std::vector<Part> parts_;
};

}  // namespace gridcull
