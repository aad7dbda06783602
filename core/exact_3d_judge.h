// One ray in 3D, judged in doubles by the definition of core/culler.h.
#pragma once

#include <span>
#include <vector>

#include "gridcull/core/exact_3d_solids.h"
#include "gridcull/core/view.h"

namespace gridcull::exact {

/// A view's limits, ready for single directions.
class ViewLimits {
 public:
  /// Throws Error(bad_frame) when the view's numbers are out of their ranges.
  explicit ViewLimits(const View& view);

  const Vec3& eye() const { return eye_; }
  const Rotation& axes() const { return axes_; }
  bool all_round() const { return all_round_; }
  double tangent_x() const { return tangent_x_; }
  double tangent_y() const { return tangent_y_; }
  bool has_near() const { return near_ > 0.0; }
  double range() const { return range_; }

  /// Whether the direction (unit) lies in the pyramid.
  bool holds(const Vec3& ray) const;
  /// The part of a ray inside the view volume; meaningful where holds().
  Stretch part(const Vec3& ray) const;
  /// Metres below which distances at `distance` count as equal.
  double tie_at(double distance) const { return 1e-12 * (magnitude_ + distance); }

 private:
  Vec3 eye_;
  Rotation axes_;
  bool all_round_;
  double tangent_x_ = 0.0, tangent_y_ = 0.0, near_ = 0.0, far_;
  double range_;
  double magnitude_;
};

/// Where one solid begins to be seen and to hide along a ray; infinity for never.
struct Along {
  double touch;  ///< its first point inside the view volume
  double entry;  ///< where it starts to hide (before the volume too)
};
/// `scratch` is overwritten.
Along look_along(const ViewLimits& view, const Solid& solid, const Vec3& ray, std::vector<Stretch>& scratch);

/// Whether `target` is seen along the ray with only `others` (the target among them or not) in the way.
bool seen_past(const ViewLimits& view, const Solid& target, std::span<const Solid* const> others, const Vec3& ray,
               std::vector<Stretch>& scratch);

}  // namespace gridcull::exact
