// Conservative tests against a view volume: may_touch() never says no to something that touches it.
#pragma once

#include <array>

#include "gridcull/core/half_space.h"
#include "gridcull/core/object.h"
#include "gridcull/core/view.h"

namespace gridcull {

/// The set of points a view can report, ready for tests.
class ViewVolume {
 public:
  /// Throws Error(bad_frame) when the view's numbers are out of their ranges (see core/view.h).
  ViewVolume(const View& view, int dimension);

  const Vec3& apex() const { return apex_; }
  double range() const { return range_; }
  /// The local +x axis in the world: the line of sight.
  const Vec3& axis() const { return axis_; }

  /// All directions: only the range limits.
  bool all_round() const { return sides_ == 0; }
  /// The side half-spaces through the apex. Their intersection is the view cone when convex(),
  /// their union otherwise (2D, field of view above pi).
  const HalfSpace* begin() const { return side_.data(); }
  const HalfSpace* end() const { return side_.data() + sides_; }
  bool convex() const { return convex_; }

  /// Ball (2D: disc).
  bool may_touch_ball(const Vec3& centre, double radius) const;
  /// The object's shape: bounding ball first, then its vertices or centre, then the range to its outline.
  bool may_touch(const Shape& shape, const Pose& pose) const;

 private:
  template <class Support>
  bool may_touch_support(const Support& support) const;

  int dimension_;
  Vec3 apex_;
  Vec3 axis_;
  double range_;
  std::array<HalfSpace, 4> side_{};
  int sides_ = 0;
  bool convex_ = true;
  double near_ = 0.0;
  double far_;
};

/// Smallest distance (metres) from a point to the closed 2D shape; 0 inside.
double distance_2d(const Vec2& point, const Shape& shape, const Pose& pose);

/// Whether the point lies in the open interior of the shape. False for thin shapes. Judged on the rounded
/// world points in 2D; in 3D in local coordinates, so a point within about 1e-12 of the surface (relative
/// to the coordinates' size) may be answered either way.
bool interior_holds(const Shape& shape, const Pose& pose, const Vec3& point);

}  // namespace gridcull
